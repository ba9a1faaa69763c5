// Numbers in text against another reader of them (strtod), bit by bit.
#include "formats/plain_text.h"
#include <bit>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <new>
#include <nlohmann/json.hpp>
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

TEST_CASE("what goes on one line of a terminal is valid and moves no cursor") {
    CHECK(valid_utf8("a\xff\xc3(\xe2\x82") == std::string("a?") + "?(" + "?" + "?");
    CHECK(valid_utf8("gr\u00fcn \u2603 \U0001F333") == "gr\u00fcn \u2603 \U0001F333");
    CHECK(valid_utf8("a\x1b[2Jb\tc\x7f") == "a?[2Jb?c?");
    CHECK(valid_utf8("a\xc2\x9b"
                     "2Jb\xc2\x85") == "a?2Jb?"); // the one-character forms of the same
    CHECK(valid_utf8("\xc2\xa0") == "\xc2\xa0");
    CHECK(valid_utf8("a\u2028b\u202ec\u2066d\u2069") == "a?b?c?d?"); // lines broken, letters turned round
    CHECK(valid_utf8("\u2027\u202f\u2065\u206a") == "\u2027\u202f\u2065\u206a");
    CHECK(valid_utf8("\xc0\x80\xed\xa0\x80\xf4\x90\x80\x80").find_first_not_of('?') == std::string::npos);
}

TEST_CASE("errors of libraries are told in words") {
    std::string what;
    try {
        nlohmann::json::parse("3").get<std::string>();
    } catch (const nlohmann::json::exception& error) {
        what = error.what();
    }
    REQUIRE(what.find("[json.exception") != std::string::npos);
    CHECK(in_words("x.json: is no glTF: " + what) == "x.json: is no glTF: type must be string, but is number");
    CHECK(in_words("[json.exception.") == "[json.exception.");
    CHECK(in_words(std::bad_alloc().what()) == "it needs more memory than there is");
    try {
        std::vector<char> bytes;
        bytes.resize(SIZE_MAX);
    } catch (const std::length_error& error) {
        CHECK(in_words(error.what()) == "it needs more memory than there is");
    }
    CHECK(in_words("assimp could not read it: std::bad_alloc; expected") ==
          "assimp could not read it: it needs more memory than there is; expected");
}
