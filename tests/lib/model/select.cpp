#include "lib/growth/segment.h"
#include "lib/model/append.h"
#include "lib/model/scene.h"
#include <catch2/catch.hpp>

using namespace bough;

namespace {

// A trunk of 4 m along Y and a side branch of 2 m along X from 3 m up, with a leaf at its end.
Tree tree_of(double segment_length) {
    Splines s;
    s.parent = {-1, 0};
    s.parent_at = {0, 0.75};
    s.level = {0, 1};
    s.first_point = {0, 2, 4};
    s.point = {{0, 0, 0}, {0, 4, 0}, {0, 3, 0}, {2, 3, 0}};
    s.radius = {0.1, 0.05, 0.02, 0.01};
    s.leaf_branch = {1};
    s.leaf_at = {1};
    s.leaf_position = {{2, 3, 0}};
    s.leaf_rotation = {Quat(Eigen::AngleAxisd(1.5707963267948966, Vec3::UnitY()))}; // z along X
    s.leaf_length = {0.1};
    s.leaf_width = {0.06};
    SegmentOptions o;
    o.segment_length = segment_length;
    return segment(s, wood_presets().front(), o);
}

// Two of them, the second with other pieces, 10 m along X.
struct SelectedPair {
    Tree joined;
    std::vector<TreeRange> ranges;
    SelectedPair() {
        const Tree a = tree_of(1), b = tree_of(0.5);
        append(joined, a, Vec3::Zero(), 0);
        append(joined, b, Vec3(10, 0, 0), 0);
        ranges = {{0, a.size_bodies(), 0}, {a.size_bodies(), b.size_bodies(), 2}};
    }
    Selected one(const Selector& s) const {
        const auto found = select(joined, ranges, s);
        REQUIRE(found.size() == 1);
        return found[0];
    }
    Vec3 world(const Selected& s) const {
        Vec3 p = s.point_b;
        for (auto i = std::int64_t(s.body); i >= 0; i = joined.parent[std::size_t(i)])
            p = joined.joint_position[std::size_t(i)] + joined.joint_rotation[std::size_t(i)] * p;
        return p;
    }
};

Selector branch_at(int tree, int branch, double at) {
    Selector s;
    s.by = Selector::By::branch;
    s.tree = tree;
    s.branch = branch;
    s.at = at;
    return s;
}

Selector nearest_to(const Vec3& p) {
    Selector s;
    s.by = Selector::By::nearest;
    s.nearest = p;
    return s;
}

} // namespace

TEST_CASE("a branch and a fraction name the same point under any segmentation") {
    const SelectedPair pair;
    for (double at : {0.0, 0.1, 0.25, 0.5, 0.6, 0.999, 1.0}) {
        for (int tree : {0, 1}) {
            const Vec3 base(10 * tree, 0, 0);
            CHECK((pair.world(pair.one(branch_at(tree, 0, at))) - base - Vec3(0, 4 * at, 0)).norm() < 1e-12);
            CHECK((pair.world(pair.one(branch_at(tree, 1, at))) - base - Vec3(2 * at, 3, 0)).norm() < 1e-12);
        }
    }
    CHECK(pair.joined.kind[pair.one(branch_at(0, 1, 1)).body] == Kind::branch);
}

TEST_CASE("a body is named by its index in its own document") {
    const SelectedPair pair;
    Selector s;
    s.by = Selector::By::body;
    s.tree = 1;
    s.body = 3;
    const Selected found = pair.one(s);
    CHECK(found.body == pair.ranges[1].first_body + 3);
    CHECK((found.point_b - pair.joined.com[found.body]).norm() == 0);
}

TEST_CASE("the nearest body is the one whose axis is, in any tree") {
    const SelectedPair pair;
    CHECK((pair.world(pair.one(nearest_to({0.1, 1.7, 0.3}))) - Vec3(0, 1.7, 0)).norm() < 1e-12);
    CHECK((pair.world(pair.one(nearest_to({11, 2.5, 0.2}))) - Vec3(11, 3, 0)).norm() < 1e-12);
    CHECK((pair.world(pair.one(nearest_to({0, 50, 0}))) - Vec3(0, 4, 0)).norm() < 1e-12);
    const Selected leaf = pair.one(nearest_to({2.07, 3.5, 0}));
    CHECK(pair.joined.kind[leaf.body] == Kind::leaf);
    CHECK((pair.world(leaf) - Vec3(2.07, 3, 0)).norm() < 1e-12);
}

TEST_CASE("a level names every branch body of it and no leaf") {
    const SelectedPair pair;
    Selector s;
    s.by = Selector::By::level;
    s.level = 1;
    const auto found = select(pair.joined, pair.ranges, s);
    CHECK(found.size() == 2 + 4);
    for (const Selected& f : found) CHECK(pair.joined.kind[f.body] == Kind::branch);
}

TEST_CASE("what is not there is said, and what there is") {
    const SelectedPair pair;
    const auto fails = [&](const Selector& s, const char* what) {
        CHECK_THROWS_AS(select(pair.joined, pair.ranges, s), std::out_of_range);
        CHECK_THROWS_WITH(select(pair.joined, pair.ranges, s), Catch::Contains(what));
    };
    fails(branch_at(2, 0, 0), "there are 2 trees");
    fails(branch_at(-1, 0, 0), "there are 2 trees");
    fails(branch_at(0, 2, 0.5), "branches go from 0 to 1");
    fails(branch_at(0, -1, 0.5), "branches go from 0 to 1");
    Selector s;
    s.by = Selector::By::body;
    s.body = std::int64_t(pair.ranges[0].bodies);
    fails(s, "has 7 bodies");
    s.by = Selector::By::level;
    s.level = 2;
    fails(s, "highest level of a branch is 1");
    CHECK_THROWS_AS(select(Tree{}, {}, nearest_to(Vec3::Zero())), std::out_of_range);
}
