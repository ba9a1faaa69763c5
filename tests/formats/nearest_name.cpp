#include "formats/nearest_name.h"
#include <catch2/catch.hpp>

using namespace bough;

TEST_CASE("the nearest name is fewest edits away, counted by hand") {
    const std::vector<std::string> names{"stages", "error", "modes", "compare", "velocity"};
    CHECK(nearest_name("comapre", names, 1) == "compare"); // two letters that stand side by side
    CHECK(nearest_name("velocty", names, 1) == "velocity");
    CHECK(nearest_name("Modes", names, 0) == "modes");
    CHECK(nearest_name("mode", names, 1) == "modes");
    CHECK(nearest_name("errror", names, 1) == "error");
    CHECK(nearest_name("stabs", names, 1).empty()); // two edits from stages
    CHECK(nearest_name("stabs", names, 2) == "stages");
    CHECK(nearest_name("", names, 4).empty());
    CHECK(nearest_name("x", {"ab", "cd"}, 2) == "ab"); // the first of several
    CHECK(nearest_name("x", {}, 100).empty());
}
