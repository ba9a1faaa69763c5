// json_numbers.h: numbers of JSON arrays, which are nearly all of a large document, read by std::from_chars: a fifth of the time that nlohmann takes,
// whose lexer copies each number and gives it to strtod. What is no plain number followed by a comma is left to nlohmann.
#pragma once
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <type_traits>

namespace bough {

// An iterator over text for nlohmann's parser; its copies share one place in the text.
struct TextCursor {
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    const char** at;
    reference operator*() const { return **at; }
    TextCursor& operator++() {
        ++*at;
        return *this;
    }
    TextCursor operator++(int) {
        ++*at;
        return *this;
    }
    bool operator==(const TextCursor& other) const { return *at == *other.at; }
    bool operator!=(const TextCursor& other) const { return *at != *other.at; }
};

inline const char* skip_space(const char* at, const char* end) {
    while (at != end && (*at == ' ' || *at == '\n' || *at == '\r' || *at == '\t')) ++at;
    return at;
}

// Where JSON's grammar ends the number at `at`, which is `at` where there is none; `integral`: without fraction and exponent.
inline const char* number_end(const char* at, const char* end, bool& integral) {
    const char* const start = at;
    const auto digits = [&] {
        const char* const first = at;
        while (at != end && *at >= '0' && *at <= '9') ++at;
        return at != first;
    };
    integral = true;
    if (at != end && *at == '-') ++at;
    if (at != end && *at == '0')
        ++at;
    else if (!digits())
        return start;
    if (at != end && *at == '.') {
        integral = false;
        ++at;
        if (!digits()) return start;
    }
    if (at != end && (*at == 'e' || *at == 'E')) {
        integral = false;
        ++at;
        if (at != end && (*at == '+' || *at == '-')) ++at;
        if (!digits()) return start;
    }
    return at;
}

// take(value) for each number that stands from `at` on with a comma and more behind it. Returns where the rest begins. Numbers are as nlohmann
// gives them: what is written without a fraction is an integer, so "-0" is 0; what a T does not hold ends the row.
template <class T, class Take> const char* each_number(const char* at, const char* end, Take&& take) {
#ifdef __cpp_lib_to_chars // else no std::from_chars for double: nlohmann reads them all
    while (true) {
        const char* const start = skip_space(at, end);
        bool integral = false;
        const char* const stop = number_end(start, end, integral);
        const char* const comma = skip_space(stop, end);
        if (stop == start || comma == end || *comma != ',') return at;
        const char* const next = skip_space(comma + 1, end);
        if (next == end || *next == ']') return at; // a comma too many: nlohmann says so
        if (std::is_integral_v<T> && !integral) return at;
        T value{};
        const auto [rest, error] = std::from_chars(start, stop, value);
        if (error != std::errc() || rest != stop) return at;
        take(integral && value == 0 ? T(0) : value);
        at = next;
    }
#else
    (void)end, (void)take;
    return at;
#endif
}

} // namespace bough
