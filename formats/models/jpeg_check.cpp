#include "jpeg_check.h"
#include <algorithm>
#include <cstddef>

namespace bough {
namespace {

constexpr int tables = 0xC4, quantization = 0xDB, scan = 0xDA, end_of_image = 0xD9;

int byte(std::string_view text, std::size_t at) {
    return at < text.size() ? static_cast<unsigned char>(text[at]) : 0;
}

// Of the tables of a segment of `length` bytes that begins here: whether none has too many codes, and all end where it ends.
bool fit(std::string_view text, std::size_t length) {
    constexpr std::size_t head = 17; // which table, and how many codes there are of each length
    std::size_t at = 0;
    while (at < length) {
        int codes = 0;
        for (std::size_t k = 1; k < head; ++k) codes += byte(text, at + k);
        if (codes > 256) return false;
        at += head + std::size_t(codes);
    }
    return at == length;
}

// Likewise of quantization tables, of bytes or words: a decoder that reads past the segment's end would go on elsewhere than we do.
bool end_where_it_ends(std::string_view text, std::size_t length) {
    std::size_t at = 0;
    while (at < length) at += byte(text, at) >> 4 ? 129 : 65;
    return at == length;
}

bool has_length(int marker) {
    return marker > 1 && !(marker >= 0xD0 && marker <= 0xD8) && marker < 0xFF;
}

} // namespace

bool jpeg_tables_fit(std::string_view jpeg) {
    bool before_scan = true;
    for (std::size_t at = 0; at + 1 < jpeg.size();) {
        const int marker = byte(jpeg, at + 1);
        if (byte(jpeg, at) != 0xFF || marker == 0xFF || marker == 0) {
            ++at;
            continue;
        }
        const std::size_t length =
            has_length(marker) ? std::size_t(byte(jpeg, at + 2)) << 8 | std::size_t(byte(jpeg, at + 3)) : 0;
        const std::string_view rest = jpeg.substr(std::min(at + 4, jpeg.size()));
        if (marker == tables && length > 2 && !fit(rest, length - 2)) return false;
        if (marker == quantization && length > 2 && !end_where_it_ends(rest, length - 2)) return false;
        before_scan = before_scan && marker != scan && marker != end_of_image;
        at += before_scan ? 2 + length : 2;
    }
    return true;
}

} // namespace bough
