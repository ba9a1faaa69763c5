// JPEGs whose Huffman tables have more codes than there are bytes, which stb_image does not bear; the file was found by fuzzing.
#include "formats/models/jpeg_check.h"
#include "formats/error.h"
#include "formats/models/texture_file.h"
#include "formats/open.h"
#include <catch2/catch.hpp>

using namespace bough;

namespace {

// A segment of tables, each by its counts of codes of the lengths 1 to 16, which then follow as zeros.
std::string segment(const std::vector<std::vector<int>>& tables) {
    std::string content;
    for (const std::vector<int>& counts : tables) {
        std::size_t codes = 0;
        content += '\0';
        for (std::size_t k = 0; k < 16; ++k) {
            content += char(k < counts.size() ? counts[k] : 0);
            codes += std::size_t(k < counts.size() ? counts[k] : 0);
        }
        content.append(codes, '\0');
    }
    const std::size_t length = content.size() + 2;
    return std::string("\xFF\xC4") + char(length >> 8) + char(length & 255) + content;
}

const std::string start = "\xFF\xD8", scan = std::string("\xFF\xDA\0\2", 4), end = "\xFF\xD9";
const std::string comment =
    std::string("\xFF\xFE\0\x16", 4) + "\xFF\xC4" + std::string(18, '\xFF'); // its 20 bytes look like a table

} // namespace

TEST_CASE("tables of at most 256 codes are let through, and what only looks like one") {
    const std::string good = segment({{0, 2}, {0, 0, 128, 128}});
    CHECK(jpeg_tables_fit(""));
    CHECK(jpeg_tables_fit(start));
    CHECK(jpeg_tables_fit(start + comment + good + scan + "abc" + end));
    CHECK(jpeg_tables_fit(start + scan + std::string("a\xFF\0\xC4", 4) + "b" + good + end));
    CHECK(jpeg_tables_fit(start + "\xFF\xC4")); // cut off: the decoder's to refuse
}

TEST_CASE("a table of more is found wherever it stands") {
    const std::string bad = segment({{0, 2}, {0, 0, 129, 128}});
    CHECK_FALSE(jpeg_tables_fit(start + bad));
    CHECK_FALSE(jpeg_tables_fit(start + comment + "\xFF\xFF" + bad + scan + end));
    CHECK_FALSE(jpeg_tables_fit(start + scan + "abc" + bad + scan + end));
    CHECK_FALSE(jpeg_tables_fit(start + end + bad)); // behind the end, where a decoder may still look
    CHECK_FALSE(jpeg_tables_fit((start + bad).substr(0, 50)));
}

TEST_CASE("quantization tables end where their segment does") {
    const auto quantization = [](std::size_t length, std::size_t bytes) {
        return std::string("\xFF\xDB") + char((length + 2) >> 8) + char((length + 2) & 255) + std::string(bytes, '\0');
    };
    CHECK(jpeg_tables_fit(start + quantization(65, 65) + quantization(130, 130) + scan + end));
    CHECK_FALSE(
        jpeg_tables_fit(start + quantization(64, 65) + scan + end)); // a decoder reads one byte more than we skip
}

TEST_CASE("the files that were found are refused") {
    for (const char* const name :
         {"bad_huffman.jpg", "bad_huffman_filled.jpg"}) { // the second with fill bytes before its start
        const std::string path = std::string(BOUGH_DATA_DIR) + "/../tests/fuzzing/found/" + name;
        CHECK_FALSE(jpeg_tables_fit(read_input(path)));
        CHECK_THROWS_WITH(read_texture(path, "a test"), Catch::Contains("does not fit"));
    }
}
