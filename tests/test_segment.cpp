#include "integrate.h"
#include "lib/growth/segment.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;
using std::numbers::pi;

namespace {

const Material& wood() {
    return wood_presets().front();
}

void add_branch(Splines& s, int parent, double at, const std::vector<Vec3>& points, const std::vector<double>& radii) {
    if (s.first_point.empty()) s.first_point.push_back(0);
    s.parent.push_back(parent);
    s.parent_at.push_back(at);
    s.level.push_back(parent < 0 ? 0 : s.level[std::size_t(parent)] + 1);
    s.point.insert(s.point.end(), points.begin(), points.end());
    s.radius.insert(s.radius.end(), radii.begin(), radii.end());
    s.first_point.push_back(std::int32_t(s.point.size()));
}

void add_leaf(Splines& s, int branch, double at, const Vec3& position) {
    s.leaf_branch.push_back(branch);
    s.leaf_at.push_back(at);
    s.leaf_position.push_back(position);
    s.leaf_rotation.push_back(Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized())));
    s.leaf_length.push_back(0.08);
    s.leaf_width.push_back(0.05);
}

void add_fruit(Splines& s, int branch, double at, const Vec3& position) {
    s.fruit_branch.push_back(branch);
    s.fruit_at.push_back(at);
    s.fruit_position.push_back(position);
    s.fruit_center.push_back(position - Vec3(0, 0.05, 0));
    s.fruit_radius.push_back(0.03);
}

// A quarter circle of radius R from the origin, upward and bending to +x, of n points.
std::vector<Vec3> quarter(double R, int n) {
    std::vector<Vec3> points;
    for (int k = 0; k < n; ++k) {
        const double a = pi / 2 * k / (n - 1);
        points.push_back({R * (1 - std::cos(a)), R * std::sin(a), 0});
    }
    return points;
}

std::vector<double> taper(double from, double to, int n) {
    std::vector<double> radii;
    for (int k = 0; k < n; ++k) radii.push_back(from + (to - from) * k / (n - 1));
    return radii;
}

// Trunk, a curved bough off its axis, a twig on the bough, leaves and a fruit; everything beside its bearer.
Splines small_tree() {
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0.1, 3, 0}, {0, 6, 0.2}}, {0.15, 0.1, 0.03});
    std::vector<Vec3> bough = quarter(2, 30);
    for (Vec3& p : bough) p = Vec3(0.3 + p.y(), 2.5 + p.x(), p.z());
    add_branch(s, 0, 0.4, bough, taper(0.06, 0.01, 30));
    add_branch(s, 1, 0.6, {{1.9, 3.2, 0.1}, {1.9, 3.2, 0.6}}, {0.01, 0});
    add_leaf(s, 2, 1, {1.9, 3.2, 0.61});
    add_leaf(s, 0, 0.99, {0.05, 6, 0.2});
    add_fruit(s, 1, 0.3, {1.2, 2.4, 0});
    s.name = "small";
    s.source = "made by hand";
    return s;
}

struct Drawn {
    std::vector<Mat3> R;
    std::vector<Vec3> x;
};

// (7) and (10) at theta = 0.
Drawn sweep(const Tree& tree) {
    Drawn d;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Mat3 R = tree.joint_rotation[i].toRotationMatrix();
        const auto p = std::size_t(tree.parent[i]);
        d.x.push_back(tree.parent[i] < 0 ? tree.joint_position[i] : Vec3(d.x[p] + d.R[p] * tree.joint_position[i]));
        d.R.push_back(tree.parent[i] < 0 ? R : Mat3(d.R[p] * R));
    }
    return d;
}

// Point of branch b at a fraction of its arc length, by walking its points.
Vec3 point_at(const Splines& s, std::size_t b, double at) {
    const auto begin = std::size_t(s.first_point[b]), end = std::size_t(s.first_point[b + 1]);
    double length = 0;
    for (std::size_t i = begin; i + 1 < end; ++i) length += (s.point[i + 1] - s.point[i]).norm();
    double left = at * length;
    for (std::size_t i = begin; i + 1 < end; ++i) {
        const double step = (s.point[i + 1] - s.point[i]).norm();
        if (left <= step || i + 2 == end) return s.point[i] + (s.point[i + 1] - s.point[i]) * (left / step);
        left -= step;
    }
    return s.point[end - 1];
}

std::vector<std::size_t> pieces_of(const Tree& tree, int branch) {
    std::vector<std::size_t> pieces;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == Kind::branch && tree.branch[i] == branch) pieces.push_back(i);
    return pieces;
}

SegmentOptions length_of(double segment_length) {
    SegmentOptions o;
    o.segment_length = segment_length;
    return o;
}

void require_sound(const Splines& s, const SegmentOptions& o, const Tree& tree) {
    const auto defect = check(tree);
    if (defect) FAIL(defect->field << "[" << defect->index << "] " << defect->message);
    CHECK(count_bodies(s, o) == std::int64_t(tree.size_bodies()));
}

} // namespace

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

TEST_CASE("a sharp corner is a joint, and pieces are even on either side of it") {
    Splines s;
    add_branch(s, -1, 0, {{0, 0, 0}, {0, 1, 0}, {2.3, 1, 0}}, {0.05, 0.05, 0.02});
    const Tree tree = segment(s, wood(), length_of(0.4));
    require_sound(s, length_of(0.4), tree);
    REQUIRE(tree.size_bodies() == 9);
    for (std::size_t i = 0; i < 3; ++i) CHECK(tree.size[i][0] == Approx(1.0 / 3));
    for (std::size_t i = 3; i < 9; ++i) CHECK(tree.size[i][0] == Approx(2.3 / 6));
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

TEST_CASE("max_bodies lengthens the pieces and keeps every branch, leaf and fruit") {
    const Splines s = small_tree();
    const std::int64_t all = count_bodies(s, {});
    for (std::int64_t most = 6; most <= all; ++most) {
        SegmentOptions o;
        o.max_bodies = most;
        const Tree tree = segment(s, wood(), o);
        require_sound(s, o, tree);
        CHECK(std::int64_t(tree.size_bodies()) <= most);
        CHECK(std::int64_t(tree.size_bodies()) >= most - 2);
        for (int b = 0; b < 3; ++b) CHECK_FALSE(pieces_of(tree, b).empty());
    }
    SegmentOptions few;
    few.max_bodies = 5;
    CHECK_THROWS_WITH(segment(s, wood(), few), Catch::Contains("at least 6 bodies"));
    CHECK_THROWS_AS(count_bodies(s, few), std::invalid_argument);
    few.max_bodies = 2;
    CHECK_THROWS_WITH(segment(s, wood(), few), Catch::Contains("at least 6 bodies"));
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
    SegmentOptions o;
    o.max_bodies = 4;
    const Tree tree = segment(s, wood(), o);
    require_sound(s, o, tree);
    CHECK(tree.size_bodies() == 4);
    for (const Vec3& size : tree.size) CHECK(size[0] > 0.9);
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
