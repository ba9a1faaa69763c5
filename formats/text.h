// text.h: text of many numbers on its way to an output, gathered in one block that is handed on when it is full, so that
// a number costs its digits (std::to_chars, no locale) and nothing else: no string, no call of the output, no check of a
// length. Cost about 50 ns a double of 17 digits.
#pragma once
#include "open.h"
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace bough {

// How many digits a real number is written with.
struct Digits {
    bool single = false; // as few as read back as the same float, which the number is
    int most = 0;        // rounded to so many; 0: as few as read back as the same number
};

// Whoever adds to it without add() and end_line() calls room() after at most `margin` bytes, and hand_on() at the end.
// add(), end_line(), room() and hand_on() throw OutputError.
class Text {
public:
    explicit Text(Output& output) : output_(output), buffer_(new char[size + margin]) {}

    void add(std::string_view text) {
        if (text.size() >= margin) {
            hand_on();
            output_.write(text);
            return;
        }
        std::memcpy(buffer_.get() + used_, text.data(), text.size());
        used_ += text.size();
        room();
    }
    // Shortest digits that read back as the same number, at most 25 bytes.
    template <class Number> void add_number(Number value) {
        char* const begin = buffer_.get() + used_;
        used_ += std::size_t(std::to_chars(begin, buffer_.get() + size + margin, value).ptr - begin);
    }
    // The same as JSON, where "-0" would be read as an integer, which has no such zero.
    void add_json(double value, Digits digits = {}) {
        if (value == 0) {
            if (std::signbit(value)) put('-');
            put('0');
            if (std::signbit(value)) put('.'), put('0');
            return;
        }
        if (digits.most > 0)
            add_rounded(value, digits.most);
        else if (digits.single)
            add_number(float(value));
        else
            add_number(value);
    }
    void add_json(std::int64_t value, Digits = {}) { add_number(value); }
    // A number of magnitude up to 1 with 4 decimals: normals need no more.
    void add_unit(double value) {
        const int scaled = int(std::lround(value * 10000));
        char* p = buffer_.get() + used_;
        if (scaled < 0) *p++ = '-';
        const unsigned digits = unsigned(std::abs(scaled));
        *p++ = char('0' + digits / 10000);
        *p++ = '.';
        for (const unsigned unit : {1000u, 100u, 10u, 1u}) *p++ = char('0' + digits / unit % 10);
        used_ = std::size_t(p - buffer_.get());
    }
    void put(char c) { buffer_[used_++] = c; }
    void end_line() {
        put('\n');
        room();
    }
    void room() {
        if (used_ >= size) hand_on();
    }
    void hand_on() {
        output_.write({buffer_.get(), used_});
        used_ = 0;
    }

private:
    void add_rounded(double value, int digits) {
        char* const begin = buffer_.get() + used_;
        used_ += std::size_t(
            std::to_chars(begin, buffer_.get() + size + margin, value, std::chars_format::general, digits).ptr - begin);
    }

    static constexpr std::size_t size = std::size_t(1) << 16, margin = 256;
    Output& output_;
    std::unique_ptr<char[]> buffer_;
    std::size_t used_ = 0;
};

} // namespace bough
