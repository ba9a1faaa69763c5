// png_file.h: a PNG as it is written row by row, by libpng.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace bough {

struct PngForm {
    std::uint32_t width = 0, height = 0;
    int depth = 8;    // bits a channel
    int channels = 3; // 3 RGB, 4 RGBA
    std::vector<std::uint8_t>
        colors{}; // of a palette, `channels` bytes each, 256 at most; rows are then numbers of them
    bool unfiltered =
        false; // rows as they are, at zlib's best level: for pictures of even colours; else libpng chooses each row's filter
};

class PngFile {
public:
    // `text` gets the bytes, as libpng gives them out, and may be emptied between rows.
    PngFile(std::string& text, const PngForm&);
    ~PngFile();
    PngFile(const PngFile&) = delete;
    PngFile& operator=(const PngFile&) = delete;

    // False where libpng fails, of which nothing but want of memory is known.
    bool begin();
    bool add_row(const std::uint8_t* row); // channels of 16 bits: the high byte first
    bool end();

private:
    struct Writer;
    Writer* writer_;
};

} // namespace bough
