// How many leaves a leaf stands for: where the number comes from, and that no tool on its way loses one.
#include "lib/growth/leaf_count.h"
#include "formats/documents/splines.h"
#include "formats/documents/tree.h"
#include "lib/free/shown_tree.h"
#include "lib/growth/grow.h"
#include "lib/model/append.h"
#include "lib/model/split.h"
#include "lib/plan/reduce.h"
#include "tests/support/hand_made.h"
#include "tests/support/random_documents.h"
#include <numeric>

using namespace bough;
using namespace bough::test;
using namespace hand_made;

namespace {

std::int64_t sum(const std::vector<std::int32_t>& counts) {
    return std::accumulate(counts.begin(), counts.end(), std::int64_t(0));
}

double leaf_area(const Splines& s) {
    double area = 0;
    for (std::size_t k = 0; k < s.leaves(); ++k) area += s.leaf_length[k] * s.leaf_width[k];
    return area;
}

Splines trunk_with_leaves(const std::vector<double>& lengths) {
    Splines s;
    add_branch(s, -1, 0, {Vec3::Zero(), Vec3(0, 2, 0)}, {0.05, 0.03});
    for (std::size_t k = 0; k < lengths.size(); ++k) {
        add_leaf(s, 0, 0.5, Vec3(0.05, 1, 0));
        s.leaf_length[k] = lengths[k];
    }
    return s;
}

// Leaves of a trunk with clumps among them.
Tree clumps() {
    return segment(trunk_with_leaves({0.05, 0.5, 0.1, 0.9}), wood(), {});
}

} // namespace

TEST_CASE("a leaf that is not spoken of is one up to 0.2 m, then as many as have its area") {
    Splines s = trunk_with_leaves({0.01, 0.2, 0.21, 0.4, 1, 1});
    s.leaf_kind = {0, 0, 0, 0, 0, 1};
    CHECK(leaf_counts(s) == std::vector<std::int32_t>{1, 1, 7, 25, 156, 1});
    s.leaf_width.assign(6, 3e-3); // proportions make no difference
    CHECK(leaf_counts(s) == std::vector<std::int32_t>{1, 1, 7, 25, 156, 1});
    s.leaf_count = {1, 1, 1, 3, 1, 1};
    CHECK(leaf_counts(s) == s.leaf_count);
}

TEST_CASE("what is said is said where it changes something") {
    Splines s = trunk_with_leaves({0.1, 0.15});
    say_leaf_count(s);
    CHECK(s.leaf_count.empty());
    s.leaf_length[1] = 0.25;
    say_leaf_count(s);
    CHECK(s.leaf_count == std::vector<std::int32_t>{1, 1});
    s.leaf_kind = {0, 1};
    say_leaf_count(s);
    CHECK(s.leaf_count.empty());
}

TEST_CASE("trees of few bodies stand for all their leaves") {
    GrowthParameters p = default_growth();
    const Splines all = grow(p, 3, {true, false, false});
    CHECK(all.leaf_count.empty());
    for (const std::int64_t bodies : {300, 1500}) {
        const Tree tree = segment(grow_bodies(p, 3, {true, false, false}, bodies), wood(), {});
        REQUIRE(tree.leaf_count.size() == tree.size_bodies());
        std::int64_t leaves = 0;
        double area = 0;
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            if (tree.kind[i] != Kind::leaf) REQUIRE(tree.leaf_count[i] == 1);
            if (tree.kind[i] == Kind::leaf) leaves += tree.leaf_count[i], area += foliage_area(tree, i);
        }
        CHECK(leaves == std::int64_t(all.leaves()));
        CHECK(area == Approx(leaf_area(all) / 2).epsilon(1e-9)); // triangles of that length and width
    }
    p.leaf_scale = 0.6; // a palm's
    const Splines long_ones = grow(p, 3, {true, false, false});
    CHECK(sum(long_ones.leaf_count) == std::int64_t(long_ones.leaves()));
    CHECK(segment(long_ones, wood(), {}).leaf_count.empty());
}

TEST_CASE("clumps keep through joining, splitting, reducing and what is shown") {
    const Tree a = clumps(), plain = segment(trunk_with_leaves({0.1, 0.1}), wood(), {});
    REQUIRE(plain.leaf_count.empty());
    REQUIRE(sum(a.leaf_count) == std::int64_t(a.size_bodies()) - 2 + 39 + 127);
    Tree joined;
    append(joined, plain, Vec3::Zero(), 0);
    CHECK(joined.leaf_count.empty());
    append(joined, a, Vec3(3, 0, 0), 1);
    append(joined, plain, Vec3(6, 0, 0), 0);
    REQUIRE(joined.leaf_count.size() == joined.size_bodies());
    CHECK(sum(joined.leaf_count) == sum(a.leaf_count) + 2 * std::int64_t(plain.size_bodies()));
    CHECK_FALSE(check(joined));
    const std::vector<Tree> parts = split_roots(joined);
    CHECK(parts[1].leaf_count == a.leaf_count);

    Tree held = a;
    held.rigid.assign(a.size_bodies(), 0);
    held.rigid[1] = 1; // a piece of the trunk
    const Reduced r = reduce(held, {{0, held.size_bodies(), 0}}, 0.6);
    for (std::size_t g = 0; g < r.leader.size(); ++g)
        CHECK(r.tree.leaf_count[g] == a.leaf_count[std::size_t(r.leader[g])]);

    const Tree shown = shown_tree(a, {2}, {Ball{}});
    REQUIRE(shown.leaf_count.size() == a.size_bodies() + 1);
    CHECK(sum(shown.leaf_count) == sum(a.leaf_count) + 1);
}

TEST_CASE("counts below 1, and of what is no leaf, are refused") {
    Tree tree = clumps();
    tree.leaf_count[0] = 2;
    REQUIRE(check(tree));
    CHECK(check(tree)->field == "leaf_count");
    CHECK(check(tree)->message == "is 2, expected 1 (only a leaf stands for more)");
    tree.leaf_count[0] = 1;
    tree.leaf_count.back() = 0;
    CHECK(check(tree)->message == "is 0, expected 1 or more");
    tree.leaf_count.pop_back();
    CHECK(check(tree)->field == "leaf_count");
    Splines s = trunk_with_leaves({0.1, 0.1});
    s.leaf_count = {3, -1};
    CHECK(check(s)->index == 1);
    s.leaf_count = {3, 2};
    CHECK_FALSE(check(s));
    s.leaf_kind = {0, 1};
    CHECK(check(s)->message == "is 2, expected 1 (only a leaf stands for more)");
}

TEST_CASE(
    "how leaves face keeps through joining, splitting, reducing and both forms, and is left out where none is said") {
    Tree a = clumps();
    const Tree plain = segment(trunk_with_leaves({0.1, 0.1}), wood(), {});
    a.leaf_facing.assign(a.size_bodies(), 0);
    a.leaf_facing.back() = 0.4;
    Tree joined;
    append(joined, plain, Vec3::Zero(), 0);
    CHECK(joined.leaf_facing.empty());
    append(joined, a, Vec3(3, 0, 0), 1);
    append(joined, plain, Vec3(6, 0, 0), 0);
    REQUIRE(joined.leaf_facing.size() == joined.size_bodies());
    CHECK(joined.leaf_facing[plain.size_bodies() + a.size_bodies() - 1] == 0.4);
    CHECK(std::count(joined.leaf_facing.begin(), joined.leaf_facing.end(), 0) ==
          std::ptrdiff_t(joined.size_bodies()) - 1);
    CHECK_FALSE(check(joined));
    CHECK(split_roots(joined)[1].leaf_facing == a.leaf_facing);

    Tree held = a;
    held.rigid.assign(a.size_bodies(), 0);
    held.rigid[1] = 1; // a piece of the trunk
    const Reduced r = reduce(held, {{0, held.size_bodies(), 0}}, 0.6);
    for (std::size_t g = 0; g < r.leader.size(); ++g)
        CHECK(r.tree.leaf_facing[g] == a.leaf_facing[std::size_t(r.leader[g])]);
    // Needles that spread wide are many of them a tuft, also where something is held.
    Tree needles = held;
    needles.leaf_length.assign(a.size_bodies(), 0);
    needles.leaf_width.assign(a.size_bodies(), 0);
    std::size_t tufts = 0;
    for (std::size_t i = 0; i < a.size_bodies(); ++i)
        if (is_clump(a, i)) needles.leaf_length[i] = 0.1, needles.leaf_width[i] = 0.002;
    const Reduced of_needles = reduce(needles, {{0, held.size_bodies(), 0}}, 0.6);
    for (std::size_t g = 0; g < of_needles.leader.size(); ++g) {
        CHECK(kind_in_air(of_needles.tree, g) == kind_in_air(needles, std::size_t(of_needles.leader[g])));
        tufts += kind_in_air(of_needles.tree, g) == Kind::tuft;
    }
    CHECK(tufts > 0);
    CHECK(shown_tree(a, {2}, {Ball{}}).leaf_facing.size() == a.size_bodies() + 1);

    Tree bare = a;
    bare.leaf_facing.clear();
    for (const Form form : {Form::json, Form::safetensors}) {
        CHECK(read_tree(written([&](Output& o) { write_tree(o, a, form); }), "t").leaf_facing == a.leaf_facing);
        const std::string without = written([&](Output& o) { write_tree(o, bare, form); });
        CHECK(without.find("leaf_facing") == std::string::npos);
        CHECK(read_tree(without, "t").leaf_facing.empty());
    }
}

TEST_CASE("counts come back from both forms, and are left out where there are none") {
    const Tree tree = clumps();
    Tree bare = tree;
    bare.leaf_count.clear();
    for (const Form form : {Form::json, Form::safetensors}) {
        const std::string text = written([&](Output& o) { write_tree(o, tree, form); });
        CHECK(read_tree(text, "t").leaf_count == tree.leaf_count);
        const std::string without = written([&](Output& o) { write_tree(o, bare, form); });
        CHECK(without.find("leaf_count") == std::string::npos);
        CHECK(read_tree(without, "t").leaf_count.empty());
    }
}
