// The tools' operator new: large blocks begin at a huge page, all are usable, and what cannot be had is std::bad_alloc.
#include "tools/common.h"
#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <new>

namespace {

constexpr std::size_t huge_page = std::size_t(1) << 21;

bool usable(std::size_t size) {
    std::vector<unsigned char> block(size, 7);
    bool good = true;
    for (const unsigned char byte : block) good = good && byte == 7;
    return good;
}

} // namespace

TEST_CASE("blocks of all sizes are usable") {
    REQUIRE(bough::machine_threads() >= 1); // what links the tools' own operator new
    for (const std::size_t size : {std::size_t(0), std::size_t(1), std::size_t(4096), huge_page - 1, huge_page,
                                   2 * huge_page - 1, 2 * huge_page, 2 * huge_page + 1, 9 * huge_page + 4097})
        CHECK(usable(size));
    std::vector<double> growing;
    for (std::size_t i = 0; i < 3'000'000; ++i) growing.push_back(double(i));
    CHECK(growing[2'999'999] == 2'999'999);
}

#if defined(__linux__) && !defined(BOUGH_SANITIZED)
TEST_CASE("large blocks begin at a huge page") {
    const std::vector<char> a(2 * huge_page), b(5 * huge_page + 3);
    CHECK(reinterpret_cast<std::uintptr_t>(a.data()) % huge_page == 0);
    CHECK(reinterpret_cast<std::uintptr_t>(b.data()) % huge_page == 0);
}
#endif

TEST_CASE("what cannot be had is refused as by any operator new") {
    const volatile std::size_t too_much = std::numeric_limits<std::size_t>::max() / 4;
    CHECK_THROWS_AS(::operator new(too_much), std::bad_alloc);
    CHECK(::operator new(too_much, std::nothrow) == nullptr);
    ::operator delete(nullptr);
    static int asked = 0;
    std::set_new_handler([] {
        if (++asked == 3) std::set_new_handler(nullptr);
    });
    CHECK_THROWS_AS(::operator new(too_much), std::bad_alloc);
    CHECK(asked == 3);
}
