// png_size.h: what a PNG's head says, read by itself.
#pragma once
#include <string>
#include <utility>

// Width and height; -1 for what is no PNG.
inline std::pair<int, int> png_size(const std::string& bytes) {
    if (bytes.size() < 24 || bytes.compare(0, 8, "\x89PNG\r\n\x1a\n") != 0 || bytes.compare(12, 4, "IHDR") != 0)
        return {-1, -1};
    const auto number = [&](std::size_t at) {
        int n = 0;
        for (std::size_t k = 0; k < 4; ++k) n = n << 8 | static_cast<unsigned char>(bytes[at + k]);
        return n;
    };
    return {number(16), number(20)};
}
