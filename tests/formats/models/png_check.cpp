// formats/models/png_check.h, on chunks that are written byte by byte as the format's description has them.
#include "formats/models/png_check.h"
#include "formats/models/texture_file.h"
#include <catch2/catch.hpp>
#include <cstdint>
#include <string>

using namespace bough;

namespace {

const std::string mark("\x89PNG\r\n\x1a\n");

std::string chunk(const std::string& type, std::uint32_t length, const std::string& held) {
    std::string bytes;
    for (int k = 24; k >= 0; k -= 8) bytes += char(length >> k & 255);
    return bytes + type + held + "sums";
}

} // namespace

TEST_CASE("a PNG's chunks lie within it, or it is said which does not") {
    const std::string end = chunk("IEND", 0, ""), start = mark + chunk("IHDR", 13, std::string(13, '\1'));
    const std::string data = chunk("IDAT", 5, "12345");
    CHECK(png_defect(start + data + end).empty());
    CHECK(png_defect(start + data + end.substr(0, 8)).empty()); // no checksum: read all the same
    CHECK(png_defect(start + data + end + "more").empty());
    CHECK(png_defect(start + chunk("IDAT", 0x65000000, "12345") + end) ==
          "chunk \"IDAT\" declares 1694498816 bytes, of which 21 are there");
    CHECK(png_defect(start + chunk("ID\nT", 22, "12345") + end) ==
          "chunk \"ID?T\" declares 22 bytes, of which 21 are there");
    CHECK(png_defect(start + data) == "it ends early: it has no end chunk");
    CHECK(png_defect(start + data.substr(0, data.size() - 1)) == "it ends early: it has no end chunk");
    CHECK(png_defect(mark) == "it ends early: it has no end chunk");
}

TEST_CASE("what is no PNG is none of its matters") {
    for (const char* other : {"", "BM", "\x89PNG", "GIF89a of more than eighteen bytes"})
        CHECK(png_defect(other).empty());
}

TEST_CASE("the file that was found, of 168 bytes, is refused") {
    const std::string path = std::string(BOUGH_DATA_DIR) + "/../tests/fuzzing/found/long_chunk.png";
    CHECK_THROWS_WITH(read_texture(path, "a test"), Catch::Contains("declares") && Catch::Contains("are there"));
}
