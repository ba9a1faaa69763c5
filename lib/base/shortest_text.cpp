#include "shortest_text.h"
#include <array>
#include <charconv>

namespace bough {

std::string shortest_text(double value) {
    std::array<char, 32> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    return std::string(buffer.data(), end);
}

std::string rounded_text(double value, int digits) {
    std::array<char, 32> buffer;
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits).ptr;
    return std::string(buffer.data(), end);
}

std::string four_digits(double value) {
    return rounded_text(value, 4);
}

} // namespace bough
