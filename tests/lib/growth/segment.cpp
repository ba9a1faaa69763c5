#include "tests/support/hand_made.h"
#include "tests/support/integrate.h"

using namespace hand_made;

TEST_CASE("joints lie on the curve, side joints where they were drawn, off the parent's axis") {
    const Splines s = small_tree();
    REQUIRE_FALSE(check(s).has_value());
    for (double length : {0.0, 0.1, 0.5, 100.0}) {
        const SegmentOptions o = length_of(length);
        const Tree tree = segment(s, wood(), o);
        require_sound(s, o, tree);
        const Drawn d = sweep(tree);
        std::size_t leaf = 0;
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            const auto b = std::size_t(tree.branch[i]);
            if (tree.kind[i] == Kind::branch) {
                CHECK((d.x[i] - point_at(s, b, tree.s[i])).norm() < 1e-12);
                CHECK(tree.s[i] < 1);
            } else if (tree.kind[i] == Kind::leaf) {
                CHECK((d.x[i] - s.leaf_position[leaf]).norm() < 1e-12);
                CHECK((d.R[i] - s.leaf_rotation[leaf].toRotationMatrix()).norm() < 1e-12);
                ++leaf;
            } else {
                CHECK((d.x[i] - s.fruit_position[0]).norm() < 1e-12);
                CHECK((d.x[i] + d.R[i] * tree.com[i] - s.fruit_center[0]).norm() < 1e-12);
            }
        }
        CHECK(leaf == 2);
        CHECK(tree.joint_position[pieces_of(tree, 1)[0]].head<2>().norm() > 0.1);
    }
}

TEST_CASE("every piece ends where the next one begins and the last one at the branch's tip") {
    const Splines s = small_tree();
    const Tree tree = segment(s, wood(), {});
    const Drawn d = sweep(tree);
    for (int b = 0; b < 3; ++b) {
        const auto pieces = pieces_of(tree, b);
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            const std::size_t i = pieces[k];
            const Vec3 tip = d.x[i] + d.R[i].col(2) * tree.size[i][0];
            const bool last = k + 1 == pieces.size();
            const Vec3 next = last ? point_at(s, std::size_t(b), 1) : d.x[pieces[k + 1]];
            CHECK((tip - next).norm() < 1e-12);
            if (last) continue;
            CHECK(tree.parent[pieces[k + 1]] == std::int32_t(i));
            CHECK(continues_parent(tree, pieces[k + 1]));
            CHECK(tree.size[i][2] == tree.size[pieces[k + 1]][1]);
        }
    }
    CHECK(tree.name == "small");
    CHECK(tree.source == "made by hand");
    CHECK(tree.material == wood().name);
}

TEST_CASE("what hangs on a branch hangs on the piece that holds its arc length") {
    const Splines s = small_tree();
    const Tree tree = segment(s, wood(), length_of(0.25));
    const auto holds = [&](std::size_t child, int branch, double at) {
        const auto p = std::size_t(tree.parent[child]);
        const auto pieces = pieces_of(tree, branch);
        const double next = p == pieces.back() ? 1 : tree.s[p + 1];
        return tree.branch[p] == branch && tree.s[p] <= at && (at < next || next == 1);
    };
    CHECK(holds(pieces_of(tree, 1)[0], 0, 0.4));
    CHECK(holds(pieces_of(tree, 2)[0], 1, 0.6));
    const std::size_t leaf = tree.size_bodies() - 3;
    CHECK(holds(leaf, 2, 1));
    CHECK(holds(leaf + 1, 0, 0.99));
    CHECK(holds(leaf + 2, 1, 0.3));
    CHECK(tree.kind[leaf + 2] == Kind::fruit);
    CHECK(tree.level[leaf] == 2);
}

TEST_CASE("frames do not spin about the branch, and a trunk's x keeps near the world's") {
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 4, 0}}, {0.1, 0.1});
    const Drawn straight = sweep(segment(s, wood(), {}));
    for (const Mat3& R : straight.R) {
        CHECK((R.col(0) - Vec3::UnitX()).norm() < 1e-12);
        CHECK((R.col(2) - Vec3::UnitY()).norm() < 1e-12);
    }
    // Bending in the x y plane turns all frames about z: y of the body stays the world's -z.
    Splines bent;
    add_branch(bent, -1, 0, quarter(4, 200), taper(0.1, 0.02, 200));
    for (const Mat3& R : sweep(segment(bent, wood(), {})).R) CHECK((R.col(1) + Vec3::UnitZ()).norm() < 1e-12);
    // A branch that grows straight down has a frame too.
    Splines down;
    add_branch(down, -1, 0, {{0, 0, 0}, {0, -4, 0}}, {0.1, 0.1});
    const Tree tree = segment(down, wood(), {});
    require_sound(down, {}, tree);
    CHECK((sweep(tree).R[0].col(2) + Vec3::UnitY()).norm() < 1e-12);
}

TEST_CASE("mass: exact for a straight taper, second order for a curved one") {
    Splines cone;
    add_branch(cone, -1, 0, {{0, 0, 0}, {0, 3, 0}}, {0.1, 0});
    for (int n : {1, 3, 50}) {
        double mass = 0;
        for (double m : segment(cone, wood(), length_of(3.0 / n)).mass) mass += m;
        CHECK(mass == Approx(wood().density * pi * 0.01 * 3 / 3).epsilon(1e-13));
    }
    // Radius 0.02 + 0.08 (1 - t)^2 along a quarter circle of 20001 points.
    const int points = 20001;
    const auto radius = [](double t) { return 0.02 + 0.08 * (1 - t) * (1 - t); };
    std::vector<double> radii;
    for (int k = 0; k < points; ++k) radii.push_back(radius(double(k) / (points - 1)));
    Splines s;
    add_branch(s, -1, 0, quarter(2, points), radii);
    const double truth = wood().density * pi * pi * integrate([&](double t) { return radius(t) * radius(t); }, 0, 1);
    double before = 0;
    for (int n : {8, 16, 32, 64}) {
        double mass = 0;
        for (double m : segment(s, wood(), length_of(pi / n)).mass) mass += m;
        const double error = std::abs(mass / truth - 1);
        if (before > 0) CHECK(before / error == Approx(4).epsilon(0.1));
        before = error;
    }
    CHECK(before < 1e-3);
}

TEST_CASE("a branch of 1e5 points and a chain of 1e5 bodies") {
    const int points = 100000;
    Splines s;
    std::vector<Vec3> helix;
    for (int k = 0; k < points; ++k) {
        const double t = double(k) / points;
        helix.push_back({std::cos(20 * t), 10 * t, std::sin(20 * t)});
    }
    add_branch(s, -1, 0, helix, taper(0.1, 0.01, points));
    const Tree coarse = segment(s, wood(), {});
    require_sound(s, {}, coarse);
    CHECK(coarse.size_bodies() > 50);
    CHECK(coarse.size_bodies() < 100);
    const SegmentOptions o = length_of((10.0 * std::sqrt(5.0)) / points);
    const Tree tree = segment(s, wood(), o);
    require_sound(s, o, tree);
    CHECK(tree.size_bodies() >= 99990);
    const Drawn d = sweep(tree);
    for (std::size_t i = 0; i < tree.size_bodies(); i += 997)
        CHECK((d.x[i] - point_at(s, 0, tree.s[i])).norm() < 1e-10);
}

TEST_CASE("no branches give an empty tree") {
    Splines s;
    s.first_point.push_back(0);
    CHECK(segment(s, wood(), {}).size_bodies() == 0);
    CHECK(count_bodies(s, {}) == 0);
}

TEST_CASE("lengths, turns and numbers that are none are refused, by name") {
    const Splines s = small_tree();
    const auto refusal = [&](const SegmentOptions& o) {
        CHECK_THROWS_AS(count_bodies(s, o), std::invalid_argument);
        try {
            segment(s, wood(), o);
        } catch (const std::invalid_argument& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(refusal({.segment_length = NAN}) == "segment_length: is nan, expected metres, 0 or more");
    CHECK(refusal({.segment_length = -1}) == "segment_length: is -1, expected metres, 0 or more");
    CHECK(refusal({.segment_length = INFINITY}) == "segment_length: is inf, expected metres, 0 or more");
    for (const double bend : {0.0, -0.2, double(NAN), double(INFINITY)})
        CHECK_THAT(refusal({.max_bend = bend}), Catch::Matchers::StartsWith("max_bend: is ") &&
                                                    Catch::Matchers::EndsWith("expected radians, more than 0"));
    CHECK(refusal({.max_bodies = -3}) == "max_bodies: is -3, expected 0 or more");
    for (const double merge : {-1e-6, double(NAN), double(INFINITY)})
        CHECK_THAT(refusal({.merge = merge}), Catch::Matchers::StartsWith("merge: is "));
}
