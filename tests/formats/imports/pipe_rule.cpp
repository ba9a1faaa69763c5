#include "formats/imports/pipe_rule.h"
#include <catch2/catch.hpp>

using namespace bough;

namespace {

ImportedBranch straight(std::int32_t parent, double at, double length, std::vector<double> radius) {
    ImportedBranch b;
    b.parent = parent;
    b.parent_at = at;
    for (std::size_t k = 0; k < radius.size(); ++k)
        b.point.emplace_back(0, length * double(k) / double(radius.size() - 1), 0);
    b.radius = std::move(radius);
    return b;
}

double powered(double r) {
    return std::pow(r, 2.25);
}

} // namespace

TEST_CASE("without any radius the rule holds at every fork and the base is 1/68 of the longest way") {
    // A trunk of 6 that carries two branches at its middle, one of them a twig of its own at its end.
    std::vector<ImportedBranch> tree{straight(-1, 0, 6, {0, 0, 0}), straight(0, 0.5, 4, {0, 0}),
                                     straight(0, 0.5, 2, {0, 0}), straight(1, 1, 1, {0, 0})};
    ImportNotes notes;
    fill_radii(tree, notes);
    const double tip = tree[0].radius[2];
    CHECK(tree[0].radius[0] == Approx(8.0 / 68)); // 3 up the trunk, 4 along the branch, 1 along the twig
    CHECK(powered(tree[1].radius[0]) == Approx(2 * powered(tip)));
    CHECK(tree[2].radius == std::vector<double>{tip, tip});
    CHECK(powered(tree[0].radius[0]) == Approx(4 * powered(tip)));
    CHECK(tree[0].radius[1] == tree[0].radius[0]);
    REQUIRE(notes.lines.size() == 1);
    CHECK(notes.lines[0].find("9 of 9 radii") == 0);
    CHECK(notes.radii_guessed);
}

TEST_CASE("what is known stays, gaps between are straight, ends follow the rule from there") {
    std::vector<ImportedBranch> tree{straight(-1, 0, 4, {0.4, 0, 0.2, 0.1, 0}), straight(0, 0.875, 1, {0, 0})};
    ImportNotes notes;
    fill_radii(tree, notes);
    CHECK_FALSE(notes.radii_guessed);
    CHECK(tree[0].radius[1] == Approx(0.3));
    tree[0].radius[1] = 0.3;
    CHECK(tree[0].radius == std::vector<double>{0.4, 0.3, 0.2, 0.1, 0}); // drawn to a point
    // The known points of a trunk that carries two tips: its median is 0.2 / 2^(1/2.25), more than what it grows on is.
    CHECK(tree[1].radius[0] == Approx(0.05)); // where it grows, the trunk is half-way from 0.1 to 0
    tree = {straight(-1, 0, 3, {0, 0.3, 0, 0}), straight(0, 0.5, 1, {0.1, 0.1})};
    fill_radii(tree, notes);
    CHECK(tree[0].radius[0] == Approx(0.3)); // nothing leaves between
    CHECK(powered(tree[0].radius[2]) == Approx(powered(0.3) / 2));
    CHECK(tree[0].radius[3] == tree[0].radius[2]);
    CHECK(tree[1].radius == std::vector<double>{0.1, 0.1});
}

TEST_CASE("a tree with all its radii, drawn to points or not, is left alone without a word") {
    std::vector<ImportedBranch> tree{straight(-1, 0, 3, {0.3, 0.2, 0}), straight(0, 0.5, 1, {0.1, 0.1})};
    ImportNotes notes;
    fill_radii(tree, notes);
    CHECK(tree[0].radius == std::vector<double>{0.3, 0.2, 0});
    CHECK(notes.lines.empty());
}
