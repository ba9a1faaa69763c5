// sanitized.h: what a sanitized build leaves out. A sanitizer looks at the code that runs, not at the numbers that come out,
// and takes ten times as long: the few tests that go to large sizes, many steps or many cases stop earlier there. The
// Release build runs everything, and no bound differs. (Beside a sanitized build, tests/run leaves out of it the few that would only go more rounds.)
#pragma once
#include <initializer_list>
#include <vector>

#ifdef BOUGH_SANITIZED
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

// A test's sizes or cases; in a sanitized build the first `few` of them.
template <class T> std::vector<T> cases(std::size_t few, std::initializer_list<T> all) {
    return {all.begin(), sanitized && few < all.size() ? all.begin() + few : all.end()};
}
