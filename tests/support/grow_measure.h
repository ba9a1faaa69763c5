// grow_measure.h: what the tests of growth measure on splines, each by walking the points, not by the growth's formulas.
#pragma once
#include "lib/growth/grow.h"
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace bough::measure {

using std::numbers::pi;

inline std::size_t first(const Splines& s, std::size_t b) {
    return static_cast<std::size_t>(s.first_point[b]);
}
inline std::size_t last(const Splines& s, std::size_t b) {
    return static_cast<std::size_t>(s.first_point[b + 1]) - 1;
}

inline double length(const Splines& s, std::size_t b) {
    double sum = 0;
    for (std::size_t i = first(s, b); i < last(s, b); ++i) sum += (s.point[i + 1] - s.point[i]).norm();
    return sum;
}

inline Vec3 start_direction(const Splines& s, std::size_t b) {
    return (s.point[first(s, b) + 1] - s.point[first(s, b)]).normalized();
}

inline Vec3 end_direction(const Splines& s, std::size_t b) {
    return (s.point[last(s, b)] - s.point[last(s, b) - 1]).normalized();
}

inline double angle(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / pi;
}

inline std::vector<std::size_t> of_level(const Splines& s, int level) {
    std::vector<std::size_t> result;
    for (std::size_t b = 0; b < s.branches(); ++b)
        if (s.level[b] == level) result.push_back(b);
    return result;
}

inline std::vector<std::size_t> children(const Splines& s, std::size_t parent) {
    std::vector<std::size_t> result;
    for (std::size_t b = 0; b < s.branches(); ++b)
        if (s.parent[b] == static_cast<std::int32_t>(parent)) result.push_back(b);
    return result;
}

// Position and radius at a fraction of a branch's arc length, walked here.
inline std::pair<Vec3, double> at(const Splines& s, std::size_t b, double fraction) {
    double left = fraction * length(s, b);
    for (std::size_t i = first(s, b); i < last(s, b); ++i) {
        const double step = (s.point[i + 1] - s.point[i]).norm();
        const double t = left / step;
        if (t <= 1)
            return {s.point[i] + t * (s.point[i + 1] - s.point[i]), s.radius[i] + t * (s.radius[i + 1] - s.radius[i])};
        left -= step;
    }
    return {s.point[last(s, b)], s.radius[last(s, b)]};
}

// A tree without any variation: straight stems, conical crown.
inline GrowthParameters plain(int levels) {
    GrowthParameters p;
    p.levels = levels;
    p.shape = 0;
    p.scale = 12;
    p.level[0].base_size = 0.25;
    p.ratio = 0.02;
    p.ratio_power = 1.3;
    for (LevelParameters& l : p.level) {
        l.length = 0.3;
        l.curve_res = 4;
        l.branches = 8;
        l.down_angle = 60;
        l.rotate = 140;
    }
    p.level[0].length = 1;
    p.level[0].branches = 1;
    p.level[0].down_angle = 0;
    p.level[0].rotate = 0;
    p.level[2].length = 0.5;
    return p;
}

// Every rule of splines.h and grow.h that can be measured on a grown tree.
inline void check_sound(const Splines& s) {
    REQUIRE(s.first_point.size() == s.branches() + 1);
    REQUIRE(s.radius.size() == s.points());
    std::size_t faults = 0;
    for (std::size_t i = 0; i < s.points(); ++i) faults += !(s.point[i].allFinite() && s.radius[i] > 0);
    CHECK(faults == 0);
    for (std::size_t b = 0; b < s.branches(); ++b) {
        faults += last(s, b) <= first(s, b);
        if (s.parent[b] < 0) {
            faults += s.level[b] != 0 || s.parent_at[b] != 0;
            continue;
        }
        const auto parent = static_cast<std::size_t>(s.parent[b]);
        faults += parent >= b || s.level[b] < s.level[parent] || s.level[b] > s.level[parent] + 1;
        faults += !(s.parent_at[b] >= 0 && s.parent_at[b] <= 1);
        const auto [position, radius] = at(s, parent, s.parent_at[b]);
        faults += (position - s.point[first(s, b)]).norm() > 1e-9 * 10;
        faults += s.radius[first(s, b)] > radius * (1 + 1e-9);
    }
    CHECK(faults == 0);
    for (std::size_t i = 0; i < s.leaves(); ++i) {
        const auto branch = static_cast<std::size_t>(s.leaf_branch[i]);
        const auto [position, radius] = at(s, branch, s.leaf_at[i]);
        faults += branch >= s.branches() || !(s.leaf_at[i] >= 0 && s.leaf_at[i] <= 1);
        faults += std::abs(s.leaf_rotation[i].norm() - 1) > 1e-12;
        faults += (s.leaf_rotation[i] * Vec3::UnitY()).y() < -1e-12;
        faults += (s.leaf_position[i] - position).norm() > radius * (1 + 1e-9) + 1e-9;
        faults += !(s.leaf_length[i] > 0 && s.leaf_width[i] > 0);
    }
    for (std::size_t i = 0; i < s.fruits(); ++i) {
        const auto [position, radius] = at(s, static_cast<std::size_t>(s.fruit_branch[i]), s.fruit_at[i]);
        faults += std::abs((s.fruit_position[i] - position).norm() - radius) > 1e-9;
        faults += (s.fruit_position[i] - s.fruit_center[i] - Vec3(0, 2 * s.fruit_radius[i], 0)).norm() > 1e-12;
    }
    CHECK(faults == 0);
}

} // namespace bough::measure
