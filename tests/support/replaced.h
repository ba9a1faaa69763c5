// replaced.h: a text with one part of it changed, which must be there.
#pragma once
#include <catch2/catch.hpp>
#include <string>

namespace bough::test {

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

} // namespace bough::test
