// hash_text.h: a hash as it is printed and saved.
#pragma once
#include <cstdint>
#include <string>

namespace bough {

// Returns 16 hexadecimal digits.
inline std::string hash_text(std::uint64_t hash) {
    std::string text(16, '0');
    for (std::size_t k = 16; k-- > 0; hash >>= 4) text[k] = "0123456789abcdef"[hash & 15];
    return text;
}

} // namespace bough
