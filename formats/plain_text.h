// plain_text.h: strict numbers and places in plain text, for the readers of foreign formats. No locale takes part.
#pragma once
#include "lib/base/shortest_text.h"
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace bough {

inline bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

std::string_view trimmed(std::string_view);

// A to Z as small letters, all other bytes as they are.
inline char lower_case(char c) {
    return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
}
std::string lower_case(std::string_view);

// UTF-8's byte order mark, which many a program writes in front: its length, 0 without; the text behind it; and the first byte
// that is neither it nor blank, size() if there is none.
inline std::size_t bom_size(std::string_view text) {
    return text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
}
inline std::string_view without_bom(std::string_view text) {
    return text.substr(bom_size(text));
}
std::size_t text_start(std::string_view);

// The next run of non-blank characters at or after `from`, which moves behind it; empty at the end.
inline std::string_view next_token(std::string_view text, std::size_t& from) {
    while (from < text.size() && is_blank(text[from])) ++from;
    const std::size_t start = from;
    while (from < text.size() && !is_blank(text[from])) ++from;
    return text.substr(start, from - start);
}

// The whole token as a finite number ("1", "0.", "1e-002", "+3"), else nothing. With `decimal_comma`, one comma in
// place of the point is read too ("0,3048"). Values too small for a double are 0, too large ones are refused.
std::optional<double> parse_number(std::string_view token, bool decimal_comma = false);
std::optional<std::int64_t> parse_integer(std::string_view token);

// File name without folders and ending.
std::string stem_of(const std::string& path);

// 1-based line of an offset. O(offset).
std::size_t line_of(std::string_view content, std::size_t offset);
// The same for offsets that never fall, O(content) in all.
class LineCounter {
public:
    explicit LineCounter(std::string_view content) : content_(content) {}
    std::size_t line_of(std::size_t offset);

private:
    std::string_view content_;
    std::size_t at_ = 0, line_ = 1;
};
// "FILE:LINE", how InputError names a place.
std::string file_line(const std::string& name, std::size_t line);

// A piece of input in quotes, fit for a one-line message: unprintable bytes as '?', cut after 40 characters.
std::string in_ascii_quotes(std::string_view);
// The text with every byte that is not part of valid UTF-8, and every control character, replaced by '?'.
std::string valid_utf8(std::string text);
// What the standard library and nlohmann-json say of an error, as a user may read it: without `[json.exception.type_error.302] `, and of
// sizes and memory that cannot be had in words.
std::string in_words(std::string text);
// A number for a message.
inline std::string shown(double value) {
    return four_digits(value);
}

} // namespace bough
