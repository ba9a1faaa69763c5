#include "jpeg_check.h"
#include <algorithm>
#include <cstddef>

namespace bough {
namespace {

constexpr int tables = 0xC4, scan = 0xDA, end_of_image = 0xD9;

int byte(std::string_view text, std::size_t at) {
    return at < text.size() ? static_cast<unsigned char>(text[at]) : 0;
}

// `segment`: what follows its length.
bool fit(std::string_view segment) {
    constexpr std::size_t head = 17; // which table, and how many codes there are of each length
    for (std::size_t at = 0; at < segment.size();) {
        int codes = 0;
        for (std::size_t k = 1; k < head; ++k) codes += byte(segment, at + k);
        if (codes > 256) return false;
        at += head + std::size_t(codes);
    }
    return true;
}

bool has_length(int marker) {
    return marker > 1 && !(marker >= 0xD0 && marker <= 0xD8) && marker < 0xFF;
}

} // namespace

bool huffman_tables_fit(std::string_view jpeg) {
    bool before_scan = true;
    for (std::size_t at = 0; at + 1 < jpeg.size();) {
        const int marker = byte(jpeg, at + 1);
        if (byte(jpeg, at) != 0xFF || marker == 0xFF || marker == 0) {
            ++at;
            continue;
        }
        const std::size_t length =
            has_length(marker) ? std::size_t(byte(jpeg, at + 2)) << 8 | std::size_t(byte(jpeg, at + 3)) : 0;
        if (marker == tables && length > 2 && !fit(jpeg.substr(std::min(at + 4, jpeg.size()), length - 2)))
            return false;
        before_scan = before_scan && marker != scan && marker != end_of_image;
        at += before_scan ? 2 + length : 2;
    }
    return true;
}

} // namespace bough
