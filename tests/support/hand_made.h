// hand_made.h: splines by hand, and what the tests of cutting and segmenting ask of the bodies made of them.
#pragma once
#include "lib/growth/segment.h"
#include <catch2/catch.hpp>
#include <numbers>

namespace hand_made {

using namespace bough;
using std::numbers::pi;

inline const Material& wood() {
    return wood_presets().front();
}

inline void add_branch(Splines& s, int parent, double at, const std::vector<Vec3>& points,
                       const std::vector<double>& radii) {
    if (s.first_point.empty()) s.first_point.push_back(0);
    s.parent.push_back(parent);
    s.parent_at.push_back(at);
    s.level.push_back(parent < 0 ? 0 : s.level[std::size_t(parent)] + 1);
    s.point.insert(s.point.end(), points.begin(), points.end());
    s.radius.insert(s.radius.end(), radii.begin(), radii.end());
    s.first_point.push_back(std::int32_t(s.point.size()));
}

inline void add_leaf(Splines& s, int branch, double at, const Vec3& position) {
    s.leaf_branch.push_back(branch);
    s.leaf_at.push_back(at);
    s.leaf_position.push_back(position);
    s.leaf_rotation.push_back(Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized())));
    s.leaf_length.push_back(0.08);
    s.leaf_width.push_back(0.05);
}

inline void add_fruit(Splines& s, int branch, double at, const Vec3& position) {
    s.fruit_branch.push_back(branch);
    s.fruit_at.push_back(at);
    s.fruit_position.push_back(position);
    s.fruit_center.push_back(position - Vec3(0, 0.05, 0));
    s.fruit_radius.push_back(0.03);
}

// A quarter circle of radius R from the origin, upward and bending to +x, of n points.
inline std::vector<Vec3> quarter(double R, int n) {
    std::vector<Vec3> points;
    for (int k = 0; k < n; ++k) {
        const double a = pi / 2 * k / (n - 1);
        points.push_back({R * (1 - std::cos(a)), R * std::sin(a), 0});
    }
    return points;
}

inline std::vector<double> taper(double from, double to, int n) {
    std::vector<double> radii;
    for (int k = 0; k < n; ++k) radii.push_back(from + (to - from) * k / (n - 1));
    return radii;
}

// Trunk, a curved bough off its axis, a twig on the bough, leaves and a fruit; everything beside its bearer.
inline Splines small_tree() {
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
inline Drawn sweep(const Tree& tree) {
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
inline Vec3 point_at(const Splines& s, std::size_t b, double at) {
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

inline std::vector<std::size_t> pieces_of(const Tree& tree, int branch) {
    std::vector<std::size_t> pieces;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == Kind::branch && tree.branch[i] == branch) pieces.push_back(i);
    return pieces;
}

inline SegmentOptions length_of(double segment_length) {
    SegmentOptions o;
    o.segment_length = segment_length;
    return o;
}

inline void require_sound(const Splines& s, const SegmentOptions& o, const Tree& tree) {
    const auto defect = check(tree);
    if (defect) FAIL(defect->field << "[" << defect->index << "] " << defect->message);
    CHECK(count_bodies(s, o) == std::int64_t(tree.size_bodies()));
}

} // namespace hand_made
