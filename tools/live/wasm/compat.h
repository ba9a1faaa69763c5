// compat.h: what Emscripten 3.1.6's libc++ lacks of C++20 and lib and formats use: std::bit_cast, std::to_chars and std::from_chars of
// floating point. Included before every source of the page's build, and by nothing else; where a newer libc++ has one, this has not.
#pragma once
#ifdef __cplusplus
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <strings.h>
#include <type_traits>
#include <version>

#ifndef __cpp_lib_bit_cast
namespace std {
template <class To, class From>
requires(sizeof(To) == sizeof(From)) constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}
} // namespace std
#endif

#ifndef __cpp_lib_to_chars
namespace std {
namespace bough_compat {
inline to_chars_result put(char* first, char* last, const char* text, int length) {
    if (length > last - first) return {last, errc::value_too_large};
    memcpy(first, text, size_t(length));
    return {first + length, errc()};
}
} // namespace bough_compat

// The shortest decimals that give the same number: of at most as many as always do.
template <class Real>
requires is_floating_point_v<Real> to_chars_result to_chars(char* first, char* last, Real value) {
    constexpr bool single = sizeof(Real) == sizeof(float);
    char text[40];
    int length = 0;
    for (int digits = single ? 6 : 15; digits <= (single ? 9 : 17); ++digits) {
        length = snprintf(text, sizeof text, "%.*g", digits, double(value));
        const bool same = single ? strtof(text, nullptr) == float(value) : strtod(text, nullptr) == double(value);
        if (same || value != value) break;
    }
    return bough_compat::put(first, last, text, length);
}
inline to_chars_result to_chars(char* first, char* last, double value, chars_format format, int precision) {
    char text[400];
    const char* const as = format == chars_format::general ? "%.*g" : format == chars_format::fixed ? "%.*f" : "%.*e";
    return bough_compat::put(first, last, text, snprintf(text, sizeof text, as, precision, value));
}
// Decimal: no white space or plus before it, no hexadecimal, as from_chars has it.
template <class Real>
requires is_floating_point_v<Real> from_chars_result from_chars(const char* first, const char* last, Real& value,
                                                                chars_format = chars_format::general) {
    const char* end = first;
    const auto more = [&](auto&& is) {
        const char* const from = end;
        while (end != last && is(*end)) ++end;
        return end - from;
    };
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    if (end != last && *end == '-') ++end;
    if (last - end >= 3 && (!strncasecmp(end, "inf", 3) || !strncasecmp(end, "nan", 3))) {
        value = Real(strtod(string(first, end + 3).c_str(), nullptr));
        return {end + 3, errc()};
    }
    auto digits = more(digit);
    if (end != last && *end == '.') ++end, digits += more(digit);
    if (digits == 0) return {first, errc::invalid_argument};
    if (end != last && (*end == 'e' || *end == 'E')) {
        const char* const mantissa = end++;
        if (end != last && (*end == '-' || *end == '+')) ++end;
        if (more(digit) == 0) end = mantissa;
    }
    const string text(first, end);
    errno = 0;
    const Real read =
        sizeof(Real) == sizeof(float) ? Real(strtof(text.c_str(), nullptr)) : Real(strtod(text.c_str(), nullptr));
    if (errno == ERANGE) return {end, errc::result_out_of_range};
    value = read;
    return {end, errc()};
}
} // namespace std
#endif
#endif
