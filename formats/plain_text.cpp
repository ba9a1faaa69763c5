#include "plain_text.h"
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace bough {

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string lower_case(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](char c) { return lower_case(c); });
    return out;
}

std::size_t text_start(std::string_view text) {
    std::size_t at = bom_size(text);
    while (at < text.size() && is_blank(text[at])) ++at;
    return at;
}

namespace {

// from_chars reports "too small" and "too large" alike; the sign of the exponent tells them apart.
bool underflows(std::string_view token) {
    const std::size_t e = token.find_first_of("eE");
    return e != std::string_view::npos && e + 1 < token.size() && token[e + 1] == '-';
}

constexpr std::array<double, 19> power_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8, 1e9,
                                              1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};

// A number as most files print them, "-0.014217": where its digits are a whole number that a double holds, one division
// by a power of ten, which is exact too, gives the nearest double (Clinger, How to Read Floating Point Numbers
// Accurately). Nothing for any other text, a number or not.
std::optional<double> parse_few_digits(std::string_view token) {
    constexpr std::uint64_t most = std::uint64_t(1) << 53;
    const bool negative = token.front() == '-';
    std::uint64_t digits = 0;
    std::size_t at = negative, point = token.size();
    if (token.size() > power_of_ten.size()) return {};
    for (; at < token.size(); ++at) {
        const char c = token[at];
        if (c >= '0' && c <= '9')
            digits = 10 * digits + std::uint64_t(c - '0');
        else if (c == '.' && point == token.size())
            point = at;
        else
            return {};
    }
    const std::size_t places = point == token.size() ? 0 : token.size() - 1 - point;
    if (digits > most || token.size() - negative - (point != token.size()) == 0) return {};
    const double value = double(digits) / power_of_ten[places];
    return negative ? -value : value;
}

std::optional<double> parse_point_number(std::string_view token) {
    if (!token.empty() && token.front() == '+') token.remove_prefix(1);
    if (token.empty() || token.front() == '+') return {};
    if (const auto few = parse_few_digits(token)) return few;
    double value = 0;
    const char* end = token.data() + token.size();
    const auto [stop, error] = std::from_chars(token.data(), end, value);
    if (stop != end || error == std::errc::invalid_argument) return {};
    if (error == std::errc::result_out_of_range) return underflows(token) ? std::optional<double>(0.0) : std::nullopt;
    if (!std::isfinite(value)) return {};
    return value;
}

} // namespace

std::optional<double> parse_number(std::string_view token, bool decimal_comma) {
    const std::size_t comma = decimal_comma ? token.find(',') : std::string_view::npos;
    if (comma == std::string_view::npos) return parse_point_number(token);
    std::array<char, 64> copy;
    if (token.size() > copy.size() || token.find('.') != std::string_view::npos) return {};
    std::copy(token.begin(), token.end(), copy.begin());
    copy[comma] = '.';
    return parse_point_number({copy.data(), token.size()});
}

std::optional<std::int64_t> parse_integer(std::string_view token) {
    if (!token.empty() && token.front() == '+') token.remove_prefix(1);
    std::int64_t value = 0;
    const char* end = token.data() + token.size();
    const auto [stop, error] = std::from_chars(token.data(), end, value);
    if (token.empty() || token.front() == '+' || stop != end || error != std::errc()) return {};
    return value;
}

std::string stem_of(const std::string& path) {
    const std::size_t slash = path.find_last_of('/');
    const std::string file = slash == std::string::npos ? path : path.substr(slash + 1);
    const std::size_t dot = file.find_last_of('.');
    return dot == std::string::npos || dot == 0 ? file : file.substr(0, dot);
}

std::size_t line_of(std::string_view content, std::size_t offset) {
    const auto end = content.begin() + std::ptrdiff_t(std::min(offset, content.size()));
    return 1 + std::size_t(std::count(content.begin(), end, '\n'));
}

std::size_t LineCounter::line_of(std::size_t offset) {
    offset = std::min(offset, content_.size());
    if (offset <= at_) return line_;
    line_ += bough::line_of(content_.substr(at_, offset - at_), offset - at_) - 1;
    at_ = offset;
    return line_;
}

std::string file_line(const std::string& name, std::size_t line) {
    return name + ":" + std::to_string(line);
}

std::string in_ascii_quotes(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string out = "\"";
    for (const char c : text.substr(0, longest)) out += c >= ' ' && c <= '~' ? c : '?';
    return out + (text.size() > longest ? "...\"" : "\"");
}

namespace {

// Length of the valid UTF-8 sequence that begins at text[at], 0 if there is none.
std::size_t utf8_length(const std::string& text, std::size_t at) {
    const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
    const unsigned first = byte(at);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4) return 0;
    for (std::size_t k = 1; k < length; ++k)
        if ((byte(at + k) & 0xC0) != 0x80) return 0;
    const unsigned second = byte(at + 1);
    const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
    const bool outside = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
    return overlong || outside ? 0 : length;
}

} // namespace

std::string valid_utf8(std::string text) {
    std::string valid;
    valid.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = utf8_length(text, at);
        const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[at + k]); };
        // Control characters, U+0080 to U+009F too; U+2028 to U+202E and U+2066 to U+2069, which break lines and turn their direction.
        const bool control = (length == 1 && (byte(0) < 0x20 || byte(0) == 0x7F)) ||
                             (length == 2 && byte(0) == 0xC2 && byte(1) < 0xA0) ||
                             (length == 3 && byte(0) == 0xE2 &&
                              ((byte(1) == 0x80 && byte(2) >= 0xA8 && byte(2) <= 0xAE) ||
                               (byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9)));
        if (length == 0 || control)
            valid += '?';
        else
            valid.append(text, at, length);
        at += std::max<std::size_t>(1, length);
    }
    return valid;
}

std::string in_words(std::string text) {
    constexpr std::string_view tag = "[json.exception.";
    for (std::size_t at; (at = text.find(tag)) != std::string::npos;) {
        const std::size_t end = text.find(']', at);
        if (end == std::string::npos) break;
        text.erase(at, std::min(end + 2, text.size()) - at);
    }
    constexpr std::string_view sizes[] = {"cannot create std::vector larger than max_size()",
                                          "vector::_M_default_append",
                                          "vector::_M_realloc_insert",
                                          "vector::_M_fill_insert",
                                          "vector::reserve",
                                          "basic_string::_M_create",
                                          "basic_string::_M_replace_aux",
                                          "basic_string::append",
                                          "basic_string::reserve",
                                          "std::bad_array_new_length",
                                          "std::bad_alloc"};
    for (const std::string_view size : sizes)
        for (std::size_t at; (at = text.find(size)) != std::string::npos;)
            text.replace(at, size.size(), "it needs more memory than there is");
    return text;
}

} // namespace bough
