// Numbers in text against another reader of them (strtod), bit by bit.
#include "formats/plain_text.h"
#include <bit>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <random>

using namespace bough;

TEST_CASE("numbers of any number of digits are the nearest doubles") {
    std::mt19937_64 random(1);
    for (int round = 0; round < 200000; ++round) {
        const std::size_t digits = 1 + random() % 24, point = random() % 26;
        std::string text = random() % 3 ? "" : "-";
        for (std::size_t k = 0; k < digits; ++k) {
            if (k == point) text += '.';
            text += char('0' + random() % 10);
        }
        if (digits == point) text += '.';
        const auto value = parse_number(text);
        CAPTURE(text);
        REQUIRE(value);
        REQUIRE(std::bit_cast<std::uint64_t>(*value) ==
                std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)));
    }
    for (const char* text :
         {"9007199254740992", "9007199254740993", "-9007199254740993", "9007199254740992.0", "-0", "-0.000", ".5",
          "-.5", "5.", "18446744073709551617", "1844674407370955161.7", "0000000000000000000000001", "1e5", "+1.5"}) {
        CAPTURE(text);
        REQUIRE(parse_number(text));
        CHECK(std::bit_cast<std::uint64_t>(*parse_number(text)) ==
              std::bit_cast<std::uint64_t>(std::strtod(text, nullptr)));
    }
    for (const char* text :
         {"", "-", ".", "-.", "+", "++1", "--1", "1.2.3", "1-", "1 ", " 1", "1e", "nan", "inf", "0x1", "1,5"}) {
        CAPTURE(text);
        CHECK_FALSE(parse_number(text));
    }
}
