// formats/models/tga_check.h, on files of two by two pixels that are written byte by byte as the format's description has them.
#include "formats/models/tga_check.h"
#include <catch2/catch.hpp>
#include <vector>

using namespace bough;

namespace {

// colors: of a palette of three bytes each, none: no palette.
std::string tga(unsigned char type, unsigned char colors, unsigned char bits,
                const std::vector<unsigned char>& pixels) {
    std::vector<unsigned char> bytes{0, colors > 0, type, 0, 0, colors, 0, 24, 0, 0, 0, 0, 2, 0, 2, 0, bits, 0};
    bytes.insert(bytes.end(), std::size_t(3 * colors), 7);
    bytes.insert(bytes.end(), pixels.begin(), pixels.end());
    return {bytes.begin(), bytes.end()};
}

std::vector<unsigned char> some(std::size_t count) {
    return std::vector<unsigned char>(count, 9);
}

} // namespace

TEST_CASE("a TGA has all its pixels, or it is said what is missing") {
    const std::string colored = tga(2, 0, 24, some(12));
    CHECK(tga_defect(colored).empty());
    CHECK(tga_defect(colored.substr(0, colored.size() - 1)) == "it ends early: of 4 pixels not all are there");
    CHECK(tga_defect(tga(3, 0, 8, some(4))).empty());
    CHECK_FALSE(tga_defect(tga(3, 0, 8, some(3))).empty());
    // A run of three, then one that is written out.
    const std::string runs = tga(10, 0, 24, {0x82, 1, 2, 3, 0x00, 4, 5, 6});
    CHECK(tga_defect(runs).empty());
    CHECK(tga_defect(runs.substr(0, runs.size() - 1)) == "it ends early: of 4 pixels only 3 are there");
    CHECK(tga_defect(tga(10, 0, 24, {})) == "it ends early: of 4 pixels only 0 are there");
    CHECK(tga_defect(tga(1, 3, 8, {0, 1, 2, 0})).empty());
    CHECK(tga_defect(tga(1, 3, 8, {0, 1, 3, 0})) == "a pixel names colour 3 of a palette of 3");
    CHECK(tga_defect(tga(9, 3, 8, {0x83, 5})) == "a pixel names colour 5 of a palette of 3");
}

TEST_CASE("what is no TGA is none of its matters") {
    for (const char* other :
         {"", "BM", "\x89PNG\r\n\x1a\n of more than eighteen bytes", "GIF89a of more than eighteen bytes"})
        CHECK(tga_defect(other).empty());
    CHECK(tga_defect(tga(2, 0, 0, {})).empty());
}
