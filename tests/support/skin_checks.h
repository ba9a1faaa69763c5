// skin_checks.h: what the tests of the skin share: poses by forward kinematics, tubes taken apart, closedness, volume and
// winding number of a triangle mesh, each from its own definition.
#pragma once
#include "lib/growth/skin.h"
#include "tests/support/make_tree.h"
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <numbers>
#include <tuple>

namespace skin_checks {

using namespace bough;

using Key = std::tuple<double, double, double>;
inline Key key(const Vec3& p) {
    return {p.x(), p.y(), p.z()};
}

struct SkinPose {
    std::vector<Mat3> R_wb;
    std::vector<Vec3> x_w;
};

// Every joint turned by theta(i), by forward kinematics of our own.
template <class Theta> SkinPose posed(const Tree& tree, Theta theta) {
    SkinPose pose;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Mat3 R_pb = tree.joint_rotation[i].toRotationMatrix() * rotation_from_vector<double>(theta(i));
        const std::int32_t p = tree.parent[i];
        pose.R_wb.push_back(p < 0 ? R_pb : Mat3(pose.R_wb[std::size_t(p)] * R_pb));
        pose.x_w.push_back(p < 0 ? tree.joint_position[i]
                                 : Vec3(pose.x_w[std::size_t(p)] + pose.R_wb[std::size_t(p)] * tree.joint_position[i]));
    }
    return pose;
}

// A bend of up to `most` radians about a random axis across each joint.
inline SkinPose bent(const Tree& tree, double most, unsigned seed) {
    make_tree::Dice dice{std::mt19937(seed)};
    return posed(tree, [&](std::size_t) {
        const double angle = dice(0, most), around = dice(-std::numbers::pi, std::numbers::pi);
        return Vec3(angle * std::cos(around), angle * std::sin(around), 0);
    });
}

inline const SkinPart* part(const Skin& skin, const std::string& name) {
    for (const SkinPart& p : skin.part)
        if (p.name == name) return &p;
    return nullptr;
}

using Triangles = std::vector<std::array<std::int32_t, 3>>;

inline Triangles triangles(const Skin& skin, const std::string& name) {
    const SkinPart* p = part(skin, name);
    if (!p) return {};
    const auto first = skin.triangle.begin() + std::ptrdiff_t(p->first_index);
    return {first, first + std::ptrdiff_t(p->index_count)};
}

// Tubes of the bark. They are made one after another: a new one begins where no vertex was used before.
inline std::vector<Triangles> tubes(const Skin& skin) {
    std::vector<Triangles> result;
    std::int32_t last = -1;
    for (const auto& t : triangles(skin, "bark")) {
        if (std::min({t[0], t[1], t[2]}) > last) result.emplace_back();
        result.back().push_back(t);
        last = std::max({last, t[0], t[1], t[2]});
    }
    return result;
}

// Edges not run through exactly once in each direction, vertices in one place being one.
inline std::int64_t open_edges(const Triangles& mesh, const std::vector<Vec3>& position) {
    std::map<Key, int> id;
    std::map<std::pair<int, int>, int> runs;
    std::int64_t degenerate = 0;
    for (const auto& t : mesh) {
        int v[3];
        for (int k = 0; k < 3; ++k)
            v[k] = id.emplace(key(position[std::size_t(t[std::size_t(k)])]), int(id.size())).first->second;
        degenerate += v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
        for (int k = 0; k < 3; ++k) ++runs[{v[k], v[(k + 1) % 3]}];
    }
    CHECK(degenerate == 0);
    std::int64_t open = 0;
    for (const auto& [edge, count] : runs) {
        const auto back = runs.find({edge.second, edge.first});
        open += count != 1 || back == runs.end() || back->second != 1;
    }
    return open;
}

inline double volume(const Triangles& mesh, const std::vector<Vec3>& p) {
    double v = 0;
    for (const auto& [a, b, c] : mesh) v += p[std::size_t(a)].dot(p[std::size_t(b)].cross(p[std::size_t(c)])) / 6;
    return v;
}

// How often a closed mesh winds about a point: sum of solid angles (van Oosterom and Strackee) over 4 pi; 1 inside.
inline double winding(const Triangles& mesh, const std::vector<Vec3>& p, const Vec3& q) {
    double sum = 0;
    for (const auto& t : mesh) {
        const Vec3 a = p[std::size_t(t[0])] - q, b = p[std::size_t(t[1])] - q, c = p[std::size_t(t[2])] - q;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return sum / (4 * std::numbers::pi);
}

inline double from_axis(const Tree& tree, const SkinPose& pose, std::size_t body, const Vec3& p) {
    const Vec3 d = pose.R_wb[body].transpose() * (p - pose.x_w[body]);
    const double z = std::clamp(d.z(), 0.0, tree.size[body].x());
    return (d - Vec3(0, 0, z)).norm();
}

inline double thickest_near(const Tree& tree, const std::array<std::int32_t, 4>& joint) {
    double r = 0;
    for (const std::int32_t j : joint) r = std::max({r, tree.size[std::size_t(j)].y(), tree.size[std::size_t(j)].z()});
    return r;
}

inline std::vector<std::int32_t> branch_starts(const Tree& tree) {
    std::vector<std::int32_t> starts;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == Kind::branch && !continues_parent(tree, i)) starts.push_back(std::int32_t(i));
    return starts;
}

// Tubes by branch. A tube's own branch is that of the last body it is bound to: its collar's parent comes before.
inline std::map<std::int32_t, Triangles> tubes_by_branch(const Tree& tree, const Skin& skin) {
    std::map<std::int32_t, Triangles> result;
    for (Triangles& tube : tubes(skin)) {
        std::int32_t last = 0;
        for (const auto& t : tube)
            for (const std::int32_t v : t) last = std::max(last, skin.joint[std::size_t(v)][0]);
        result[tree.branch[std::size_t(last)]] = std::move(tube);
    }
    return result;
}

} // namespace skin_checks
