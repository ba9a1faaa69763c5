#include "lib/model/drawn_pose.h"
#include "tests/support/hand_made.h"

using namespace hand_made;

TEST_CASE("a straight branch is cut into pieces of equal length, as many as the length asks for") {
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 1, 0}, {0, 1.3, 0}, {0, 3, 0}}, {0.1, 0.08, 0.07, 0.01});
    for (int n : {1, 2, 7, 30, 1000}) {
        const Tree tree = segment(s, wood(), length_of(3.0 / n));
        REQUIRE(tree.size_bodies() == std::size_t(n));
        for (const Vec3& size : tree.size) CHECK(size[0] == Approx(3.0 / n).epsilon(1e-10));
    }
    SegmentReport report;
    segment(s, wood(), length_of(0.8), &report);
    CHECK(report.segment_length == Approx(0.75));
}

TEST_CASE("default pieces: a trunk 11, a bough 6, a twig 1, none shorter than its branch is thick") {
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 10, 0}}, {0.15, 0});
    add_branch(s, 0, 0.5, {{0, 5, 0}, {3, 5, 0}}, {0.05, 0});
    add_branch(s, 1, 0.5, {{1, 5, 0}, {1, 5, 1}}, {0.02, 0});
    add_branch(s, 2, 0.5, {{1, 5, 0.5}, {1, 5.2, 0.5}}, {0.005, 0});
    add_branch(s, 0, 0.2, {{0, 2, 0}, {0.4, 2, 0}}, {0.15, 0.15});
    const Tree tree = segment(s, wood(), {});
    CHECK(pieces_of(tree, 0).size() == 11);
    CHECK(pieces_of(tree, 1).size() == 6);
    CHECK(pieces_of(tree, 2).size() == 3);
    CHECK(pieces_of(tree, 3).size() == 2);
    CHECK(pieces_of(tree, 4).size() == 1);
}

TEST_CASE("a tree is cut alike alone, in a forest, and at any scale") {
    const Splines one = small_tree();
    Splines two = one, large = one;
    for (std::size_t b = 0; b < one.branches(); ++b) {
        std::vector<Vec3> points;
        std::vector<double> radii;
        for (auto i = std::size_t(one.first_point[b]); i < std::size_t(one.first_point[b + 1]); ++i) {
            points.push_back(one.point[i] + Vec3(500, 0, 0));
            radii.push_back(one.radius[i]);
        }
        add_branch(two, one.parent[b] < 0 ? -1 : one.parent[b] + 3, one.parent_at[b], points, radii);
    }
    for (Vec3& p : large.point) p *= 100;
    for (double& r : large.radius) r *= 100;
    const std::int64_t others = 3, pieces = count_bodies(one, {}) - others;
    CHECK(count_bodies(two, {}) == 2 * pieces + others);
    CHECK(count_bodies(large, {}) == pieces + others);
}

TEST_CASE("no even piece of a smooth curve turns by more than max_bend") {
    Splines s;
    add_branch(s, -1, 0, quarter(3, 400), taper(0.02, 0.01, 400));
    for (double bend : {0.35, 0.1, 0.02}) {
        SegmentOptions o = length_of(100);
        o.max_bend = bend;
        const Tree tree = segment(s, wood(), o);
        require_sound(s, o, tree);
        const double n = double(tree.size_bodies());
        CHECK(pi / 2 / n <= bend + pi / 2 / 399); // a joint on a point of the curve takes that point's turn
        CHECK(n <= 2 + 1.3 * pi / 2 / bend);
        for (const Vec3& size : tree.size) CHECK(size[0] == Approx(tree.size[0][0]).epsilon(1e-3));
    }
}

TEST_CASE("more pieces than an index holds are counted at once") {
    Splines s;
    for (int k = 0; k < 1000; ++k) add_branch(s, -1, 0, {{double(k), 0, 0}, {double(k), 3, 0}}, {0.1, 0.1});
    // A thousand times three million: cut, they would take a minute. No time is asked for, but the test's own limit holds.
    CHECK_THROWS_WITH(segment(s, wood(), {.segment_length = 1e-6}), Catch::Matchers::Contains("2147483647"));
}

TEST_CASE("a sharp corner is a joint, and pieces are even on either side of it") {
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 1, 0}, {2.3, 1, 0}}, {0.05, 0.05, 0.02});
    const Tree tree = segment(s, wood(), length_of(0.4));
    require_sound(s, length_of(0.4), tree);
    REQUIRE(tree.size_bodies() == 9);
    for (std::size_t i = 0; i < 3; ++i) CHECK(tree.size[i][0] == Approx(1.0 / 3));
    for (std::size_t i = 3; i < 9; ++i) CHECK(tree.size[i][0] == Approx(2.3 / 6));
}

TEST_CASE("coincident points are merged and a branch without length is dropped with what it bears moved down") {
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 0, 0}, {0, 2, 0}, {0, 2 + 1e-9, 0}, {0, 4, 0}}, {0.1, 0.1, 0.05, 0.05, 0.02});
    add_branch(s, 0, 0.5, {{0.3, 2, 0}, {0.3, 2, 1e-8}}, {0.02, 0.01}); // dropped
    add_branch(s, 1, 1, {{0.3, 2, 0}, {1.3, 2, 0}}, {0.02, 0.01});      // goes to the trunk
    add_leaf(s, 1, 0.2, {0.3, 2, 0});                                   // likewise
    add_branch(s, -1, 0, {{5, 0, 0}, {5, 0, 0}}, {0.1, 0.1});           // a root without length
    add_branch(s, 3, 0.5, {{5, 0, 0}, {5, 1, 0}}, {0.1, 0.1});          // becomes a root
    const SegmentOptions o = length_of(1);
    SegmentReport report;
    const Tree tree = segment(s, wood(), o, &report);
    require_sound(s, o, tree);
    CHECK(report.merged_points == 2);
    CHECK(report.dropped_branches == 2);
    CHECK(tree.size_bodies() == 4 + 1 + 1 + 1);
    const std::size_t side = pieces_of(tree, 2)[0];
    CHECK(tree.branch[std::size_t(tree.parent[side])] == 0);
    CHECK(tree.s[std::size_t(tree.parent[side])] == Approx(0.5));
    CHECK((sweep(tree).x[side] - Vec3(0.3, 2, 0)).norm() < 1e-12);
    CHECK(tree.parent[pieces_of(tree, 4)[0]] == -1);
    CHECK(tree.kind.back() == Kind::leaf);
    CHECK(tree.branch[std::size_t(tree.parent.back())] == 0);
}

TEST_CASE("radii of zero are raised but for tips, so that every body has mass and every joint stiffness") {
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 2, 0}, {0, 4, 0}}, {0, 0, 0});
    add_branch(s, 0, 1, {{0, 4, 0}, {1, 4, 0}}, {0, 0});
    SegmentReport report;
    const Tree tree = segment(s, wood(), {}, &report);
    require_sound(s, {}, tree);
    CHECK(report.thin_points == 3);
    for (const Vec3& K : tree.stiffness) {
        CHECK(K.minCoeff() > 0);
        CHECK(K.allFinite());
    }
    CHECK(tree.size[pieces_of(tree, 0).back()][2] == 0);
}

TEST_CASE("max_bodies keeps the tree's mass and its moments, whatever it leaves out") {
    const Splines s = small_tree();
    const std::int64_t all = count_bodies(s, {});
    const auto moments = [](const Tree& tree) {
        const DrawnPose pose = drawn_pose(tree);
        double mass = 0;
        Vec3 first = Vec3::Zero();
        Mat3 second = Mat3::Zero(); // inertia about the world's origin
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            const Vec3 c = pose.at(i, tree.com[i]);
            const Mat3 cross = cross_matrix(c);
            mass += tree.mass[i];
            first += tree.mass[i] * c;
            second += pose.R_wb[i] * tree.inertia[i] * pose.R_wb[i].transpose() - tree.mass[i] * cross * cross;
        }
        return std::tuple(mass, first, second);
    };
    const auto [mass, first, second] = moments(segment(s, wood(), {}));
    std::int64_t least = 0;
    for (std::int64_t most = all; most > 0; --most) {
        SegmentOptions o;
        o.max_bodies = most;
        try {
            const Tree tree = segment(s, wood(), o);
            CHECK_FALSE(check(tree));
            CHECK(std::int64_t(tree.size_bodies()) <= most);
            CHECK(std::int64_t(tree.size_bodies()) == count_bodies(s, o));
            const auto [m, h, J] = moments(tree);
            CHECK(m == Approx(mass).epsilon(1e-12));
            CHECK((h - first).norm() <= 1e-12 * first.norm());
            CHECK((J - second).norm() <= 1e-12 * second.norm());
            least = most;
        } catch (const std::invalid_argument& error) {
            CHECK_THAT(error.what(), Catch::Contains("at least " + std::to_string(least) + " bodies"));
        }
    }
    CHECK(least <= 4);
    SegmentOptions fine = length_of(1e-12);
    CHECK_THROWS_AS(count_bodies(s, fine), std::invalid_argument);
    fine.max_bodies = 20;
    CHECK(count_bodies(s, fine) <= 20);
}

TEST_CASE("a loop and a fold have no piece without a direction") {
    Splines s;
    std::vector<Vec3> ring;
    for (int k = 0; k <= 60; ++k) ring.push_back({std::cos(pi * k / 30), std::sin(pi * k / 30), 0});
    ring.back() = ring.front();
    add_branch(s, -1, 0, ring, std::vector<double>(61, 0.01));
    add_branch(s, -1, 0, {{3, 0, 0}, {3, 1, 0}, {3, 0, 0}}, {0.02, 0.02, 0.02});
    SegmentOptions o = length_of(100);
    o.max_bend = 10; // one piece each, but for the closing of the curve
    const Tree tree = segment(s, wood(), o);
    require_sound(s, o, tree);
    CHECK(tree.size_bodies() == 4);
    for (const Vec3& size : tree.size) CHECK(size[0] > 0.9);
}
