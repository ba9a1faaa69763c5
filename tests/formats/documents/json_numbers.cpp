// Arrays of numbers (json_numbers.h) beside nlohmann's own reading of the same text.
#include "formats/documents/document_parts.h"
#include "tests/support/sanitized.h"
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace bough;

namespace {

std::vector<double> reals_of(const std::string& list) {
    std::vector<double> values;
    std::vector<Field> fields{array("x", values, Per{})};
    read_json("{\"x\":" + list + "}", "file", nullptr, fields);
    return values;
}
std::vector<std::int32_t> integers_of(const std::string& list) {
    std::vector<std::int32_t> values;
    std::vector<Field> fields{array("x", values, Per{})};
    read_json("{\"x\":" + list + "}", "file", nullptr, fields);
    return values;
}

void check_same(const std::string& list) {
    const auto expected = nlohmann::json::parse(list).get<std::vector<double>>();
    const std::vector<double> values = reals_of(list);
    REQUIRE(values.size() == expected.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
        INFO(list << ", number " << k << ": " << values[k]);
        CHECK(std::bit_cast<std::uint64_t>(values[k]) == std::bit_cast<std::uint64_t>(expected[k]));
    }
}

} // namespace

TEST_CASE("numbers of an array are those that nlohmann reads, to the last bit") {
    check_same("[]");
    check_same("[ ]");
    check_same("[1]");
    check_same("[0, -0, -0.0, 1e0, 1E+2, 1e-2, -12.5e-3, 0.1, 3]");
    check_same("[1\n,\t2 ,\r\n3]");
    check_same("[9007199254740993, -9007199254740993, 18446744073709551615, 18446744073709551616, 1e22, "
               "123456789012345678901234567890]");
    check_same("[4.9e-324, 2.2250738585072011e-308, 1e-400, 1.7976931348623157e308, 5]");
    std::mt19937_64 random(1);
    std::string list = "[";
    char text[64];
    for (int k = 0; k < (sanitized ? 2000 : 20000); ++k) {
        double value = std::bit_cast<double>(random());
        if (!std::isfinite(value)) value = 0.5;
        std::snprintf(text, sizeof text, k % 3 ? "%.17g" : "%.6g", k % 2 ? value : double(random() % 100000) / 1000);
        list += (k ? ", " : "") + std::string(text);
    }
    check_same(list + "]");
}

TEST_CASE("integers of an array are read as integers") {
    CHECK(integers_of("[0, -1, 2147483647, -2147483648, 7]") ==
          std::vector<std::int32_t>{0, -1, 2147483647, -2147483647 - 1, 7});
    CHECK_THROWS_WITH(integers_of("[1, 2, 2.5, 4]"), Catch::Contains("/x/2"));
    CHECK_THROWS_WITH(integers_of("[1, 2, 1e2, 4]"), Catch::Contains("/x/2"));
    CHECK_THROWS_WITH(integers_of("[1, 2147483648, 4]"), Catch::Contains("/x/1"));
    CHECK_THROWS_WITH(integers_of("[1, 99999999999999999999, 4]"), Catch::Contains("/x/1"));
}

TEST_CASE("what is no JSON in an array of numbers is told with its place") {
    for (const char* list :
         {"[1,]", "[1, ]", "[1,,2]", "[,1]", "[1 2]", "[01, 2]", "[1., 2]", "[.5, 2]", "[+1, 2]", "[1e, 2]",
          "[0x10, 2]", "[--1, 2]", "[1, 2", "[1, ", "[nan, 1]", "[1, inf, 2]", "[1e999, 2]", "[1, 1e999]", "[-, 1]"}) {
        INFO(list);
        CHECK_FALSE(nlohmann::json::accept(list));
        CHECK_THROWS_WITH(reals_of(list), Catch::StartsWith("file:1"));
    }
    // Line and column, behind many numbers that were read well.
    std::string list = "[";
    for (int k = 0; k < 10000; ++k) list += "0.25,\n";
    CHECK_THROWS_WITH(reals_of(list + "  0.5, oops, 3]"), Catch::StartsWith("file:10001:8"));
    CHECK_THROWS_WITH(reals_of(list + "  0.5, \"a\", 3]"), Catch::Contains("/x/10001"));
}
