#include "png_check.h"
#include "formats/plain_text.h"

namespace bough {

std::string png_defect(std::string_view file) {
    constexpr std::string_view mark = "\x89PNG\r\n\x1a\n";
    if (!file.starts_with(mark)) return "";
    // A chunk: the length of what it holds, big-endian; its type; what it holds; a checksum of four bytes, which is not asked for.
    for (std::size_t at = mark.size(); file.size() - at >= 8;) {
        std::size_t length = 0;
        for (std::size_t k = 0; k < 4; ++k) length = 256 * length + static_cast<unsigned char>(file[at + k]);
        const std::string_view type = file.substr(at + 4, 4);
        const std::size_t left = file.size() - (at + 8);
        if (length > left)
            return "chunk " + in_ascii_quotes(type) + " declares " + std::to_string(length) + " bytes, of which " +
                   std::to_string(left) + " are there";
        if (type == "IEND") return "";
        if (left - length < 4) break;
        at += 8 + length + 4;
    }
    return "it ends early: it has no end chunk";
}

} // namespace bough
