// png_file.h: a PNG as it is written row by row, by libpng.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace bough {

struct PngForm {
    std::uint32_t width = 0, height = 0;
    int depth = 8;    // bits a channel
    int channels = 3; // 3 RGB, 4 RGBA
    // Of a palette, `channels` bytes each, 256 at most; rows are then numbers of them
    std::vector<std::uint8_t> colors{};
    // Rows as they are, at zlib's best level: for pictures of even colours; else libpng chooses each row's filter
    bool unfiltered = false;
};

class PngFile {
public:
    // `text` gets the bytes, as libpng gives them out, and may be emptied between rows.
    PngFile(std::string& text, const PngForm&);
    ~PngFile();
    PngFile(const PngFile&) = delete;
    PngFile& operator=(const PngFile&) = delete;

    // These return false where libpng fails. As far as we know it fails only for want of memory.
    bool begin();
    bool add_row(const std::uint8_t* row); // channels of 16 bits: the high byte first
    bool end();

private:
    struct Writer;
    std::unique_ptr<Writer> writer_;
};

} // namespace bough
