// Text of numbers: every number reads back as itself, by another reader (strtod, strtof), in no more digits than needed.
#include "formats/text.h"
#include "tests/support/random_documents.h"
#include <cstdio>
#include <limits>
#include <random>

using namespace bough;
using namespace bough::test;

namespace {

template <class Number> Number of_bits(std::uint64_t bits) {
    Number value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

// Zeros, powers of two and ten and their neighbours, the ends of the range, subnormals, and numbers of random bits.
template <class Number> std::vector<Number> numbers() {
    using Limits = std::numeric_limits<Number>;
    std::vector<Number> list{0, Number(-0.0), 1, -1, Number(0.1), Limits::max(), Limits::min(), Limits::denorm_min()};
    for (int e = Limits::min_exponent - 20; e < Limits::max_exponent; ++e) list.push_back(std::ldexp(Number(1), e));
    for (int e = Limits::min_exponent10; e <= Limits::max_exponent10; ++e)
        list.push_back(Number(std::strtod(("1e" + std::to_string(e)).c_str(), nullptr)));
    for (std::size_t i = 0, count = list.size(); i < count; ++i) {
        list.push_back(std::nextafter(list[i], Limits::max()));
        list.push_back(std::nextafter(list[i], -Limits::max()));
        list.push_back(-list[i]);
    }
    std::mt19937_64 random(1);
    while (list.size() < 200000)
        if (const Number value = of_bits<Number>(random()); std::isfinite(value)) list.push_back(value);
    return list;
}

template <class Add> std::string text_of(const Add& add) {
    const Folder folder;
    Output output(folder / "text");
    Text text(output);
    add(text);
    text.hand_on();
    output.finish();
    return read_input(folder / "text");
}

template <class Number> Number parsed(const char* from, char** end) {
    if constexpr (std::is_same_v<Number, float>)
        return std::strtof(from, end);
    else
        return std::strtod(from, end);
}

template <class Number> bool same_bits(Number a, Number b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

template <class Number> void check_round_trip(bool json) {
    const std::vector<Number> list = numbers<Number>();
    const std::string text = text_of([&](Text& to) {
        for (const Number value : list) {
            if (json)
                to.add_json(value);
            else
                to.add_number(value);
            to.end_line();
        }
    });
    char* at = const_cast<char*>(text.c_str());
    std::size_t wrong = 0, long_ones = 0;
    char digits[40];
    for (const Number value : list) {
        char* const begin = at;
        wrong += !same_bits(parsed<Number>(begin, &at), value) || *at != '\n';
        // One significant digit fewer is another number, or the text is not longer than printf's is.
        const int needed = [&] {
            for (int precision = 1;; ++precision) {
                std::snprintf(digits, sizeof digits, "%.*e", precision - 1, double(value));
                if (same_bits(parsed<Number>(digits, nullptr), value)) return precision;
            }
        }();
        std::size_t significant = 0;
        bool leading = true, mantissa = true;
        std::size_t zeros = 0; // behind the last digit that is none
        for (const char* c = begin; c < at && mantissa; ++c) {
            mantissa = *c != 'e';
            if (*c < '0' || *c > '9') continue;
            leading = leading && *c == '0';
            if (leading) continue;
            ++significant;
            zeros = *c == '0' ? zeros + 1 : 0;
        }
        // A large whole number may have all its digits, where that is no longer than an exponent.
        const bool plain = std::abs(double(value)) >= (std::is_same_v<Number, float> ? 1e7 : 1e15);
        long_ones += !plain && significant - zeros > std::size_t(needed);
        ++at;
    }
    CHECK(wrong == 0);
    CHECK(long_ones == 0);
    CHECK(at == text.c_str() + text.size());
}

} // namespace

TEST_CASE("numbers read back as themselves from the fewest digits") {
    check_round_trip<double>(false);
    check_round_trip<double>(true);
    check_round_trip<float>(false);
}

TEST_CASE("JSON has no negative zero among its integers") {
    CHECK(text_of([](Text& text) { text.add_json(-0.0); }) == "-0.0");
    CHECK(text_of([](Text& text) { text.add_json(0.0); }) == "0");
    CHECK(text_of([](Text& text) { text.add_json(std::int64_t(-7)); }) == "-7");
    CHECK(text_of([](Text& text) { text.add_json(std::numeric_limits<std::int64_t>::min()); }) ==
          "-9223372036854775808");
}

TEST_CASE("texts longer than the block keep their place among numbers") {
    const std::string longer(200000, 'x'), shorter(255, 'y');
    const std::string text = text_of([&](Text& to) {
        to.add_number(1);
        to.add(longer);
        to.add_number(2);
        for (int i = 0; i < 1000; ++i) to.add(shorter);
        to.put('z');
    });
    std::string expected = "1" + longer + "2";
    for (int i = 0; i < 1000; ++i) expected += shorter;
    CHECK(text == expected + "z");
}

TEST_CASE("normals have four decimals") {
    const std::string text = text_of([](Text& to) {
        for (const double value : {0.0, 1.0, -1.0, 0.70710678, -0.00005, 0.00004, 0.99996}) {
            to.add_unit(value);
            to.put(' ');
        }
    });
    CHECK(text == "0.0000 1.0000 -1.0000 0.7071 -0.0001 0.0000 1.0000 ");
}
