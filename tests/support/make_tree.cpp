// make_tree.cpp: compiled once for all test programs.
#include "make_tree.h"
#include <algorithm>

namespace make_tree {

Quat turn(double angle, const Vec3& axis) {
    return Quat(Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized())));
}

Quat upright() {
    return turn(-std::numbers::pi / 2, Vec3::UnitX());
}

std::size_t add_body(Tree& t, std::int32_t parent, Kind kind, const Vec3& at, const Quat& rotation, const Vec3& size,
                     std::int32_t branch, std::int32_t level, double s) {
    t.parent.push_back(parent);
    t.kind.push_back(kind);
    t.joint_position.push_back(at);
    t.joint_rotation.push_back(rotation.normalized());
    t.size.push_back(size);
    t.branch.push_back(branch);
    t.level.push_back(level);
    t.s.push_back(s);
    return t.parent.size() - 1;
}

std::size_t add_piece(Tree& t, std::int32_t parent, const Vec3& at, const Quat& rotation, double l, double r0,
                      double r1, std::int32_t branch, std::int32_t level, double s, const Wood& wood) {
    const double pi = std::numbers::pi, d = r1 - r0;
    const double a0 = l * (r0 * r0 + r0 * d + d * d / 3);
    const double a1 = l * l * (r0 * r0 / 2 + 2 * r0 * d / 3 + d * d / 4);
    const double a2 = l * l * l * (r0 * r0 / 3 + r0 * d / 2 + d * d / 5);
    const double r4 =
        l * (r0 * r0 * r0 * r0 + r0 * r0 * r0 * r1 + r0 * r0 * r1 * r1 + r0 * r1 * r1 * r1 + r1 * r1 * r1 * r1) / 5;
    const double mass = wood.density * pi * a0, com = a1 / a0;
    const double across = wood.density * pi * (r4 / 4 + a2) - mass * com * com, along = wood.density * pi * r4 / 2;
    t.mass.push_back(mass);
    t.com.push_back({0, 0, com});
    t.inertia.push_back(Vec3(across, across, along).asDiagonal());
    const double r = (r0 + r1) / 2, area_moment = pi * r * r * r * r / 4;
    const double bend = wood.youngs * area_moment / l, twist = 2 * wood.shear * area_moment / l;
    t.stiffness.push_back({bend, bend, twist});
    t.damping.push_back(wood.damping);
    return add_body(t, parent, Kind::branch, at, rotation, {l, r0, r1}, branch, level, s);
}

std::size_t add_leaf(Tree& t, std::int32_t parent, const Vec3& at, const Quat& rotation, double l, double w,
                     double thickness, std::int32_t branch, std::int32_t level, double s) {
    const double mass = 700 * thickness * l * w / 2;
    const double xx = w * w / 24, yy = thickness * thickness / 12, zz = l * l / 18; // second moments / mass, about com
    t.mass.push_back(mass);
    t.com.push_back({0, 0, l / 3});
    t.inertia.push_back(mass * Vec3(yy + zz, xx + zz, xx + yy).asDiagonal().toDenseMatrix());
    t.stiffness.push_back(Vec3(1e-4, 5e-4, 1e-4));
    t.damping.push_back(0.01);
    return add_body(t, parent, Kind::leaf, at, rotation, {l, w, thickness}, branch, level, s);
}

std::size_t add_fruit(Tree& t, std::int32_t parent, const Vec3& at, const Quat& rotation, double center, double radius,
                      std::int32_t branch, std::int32_t level, double s) {
    const double mass = 950 * 4 * std::numbers::pi / 3 * radius * radius * radius;
    t.mass.push_back(mass);
    t.com.push_back({0, 0, center});
    t.inertia.push_back(0.4 * mass * radius * radius * Mat3::Identity());
    t.stiffness.push_back(Vec3(0.1, 0.1, 0.1));
    t.damping.push_back(0.01);
    return add_body(t, parent, Kind::fruit, at, rotation, {center, radius, radius}, branch, level, s);
}

Tree chain(int n, double length, double r0, double r1, double bend, const Wood& wood) {
    Tree t;
    t.name = "chain";
    const double l = length / n;
    for (int i = 0; i < n; ++i) {
        const double a = double(i) / n, b = double(i + 1) / n;
        const Quat rotation = i == 0 ? upright() : turn(bend, Vec3::UnitX());
        add_piece(t, i - 1, i == 0 ? Vec3::Zero() : Vec3(0, 0, l), rotation, l, r0 + (r1 - r0) * a, r0 + (r1 - r0) * b,
                  0, 0, a, wood);
    }
    return t;
}

Tree branched() {
    Tree t;
    t.name = "branched";
    const double pi = std::numbers::pi;
    // The trunk: 4 pieces of 0.5 m, 60 mm to 20 mm thick in radius.
    for (int i = 0; i < 4; ++i)
        add_piece(t, i - 1, i == 0 ? Vec3::Zero() : Vec3(0, 0, 0.5), i == 0 ? upright() : turn(0.05, Vec3::UnitX()),
                  0.5, 0.06 - 0.01 * i, 0.05 - 0.01 * i, 0, 0, 0.25 * i);
    // Branch 1 starts on piece 1's axis, branch 2 on piece 2's surface, branch 3 well off piece 2's axis.
    add_piece(t, 1, {0, 0, 0.3}, turn(pi / 3, Vec3::UnitY()), 0.4, 0.03, 0.02, 1, 1, 0);
    add_piece(t, 4, {0, 0, 0.4}, turn(0.2, Vec3::UnitX()), 0.4, 0.02, 0, 1, 1, 0.5);
    add_piece(t, 2, {-0.036, 0, 0.2}, turn(-pi / 4, Vec3::UnitY()), 0.3, 0.02, 0.015, 2, 1, 0);
    add_piece(t, 6, {0, 0, 0.3}, turn(-0.2, Vec3::UnitY()), 0.3, 0.015, 0.005, 2, 1, 0.5);
    add_piece(t, 2, {0, 0.1, 0.4}, turn(-pi / 3, Vec3::UnitX()), 0.3, 0.012, 0.004, 3, 1, 0);
    // A twig on branch 1.
    add_piece(t, 4, {0, 0, 0.2}, turn(-pi / 4, Vec3::UnitX()), 0.25, 0.01, 0.003, 4, 2, 0);
    add_leaf(t, 5, {0, 0, 0.4}, turn(0.3, Vec3::UnitX()), 0.08, 0.05, 3e-4, 1, 1, 1);
    add_leaf(t, 9, {0, 0.003, 0.2}, turn(-0.8, Vec3::UnitX()), 0.08, 0.05, 3e-4, 4, 2, 0.8);
    add_leaf(t, 0, {0, 0.06, 0.2}, turn(-1.2, Vec3::UnitX()), 0.08, 0.05, 3e-4, 0, 0, 0.1);
    add_fruit(t, 7, {0, 0, 0.3}, turn(2.5, Vec3::UnitY()), 0.06, 0.03, 2, 1, 1);
    return t;
}

Tree random_tree(int n, unsigned seed) {
    Tree t;
    t.name = "random";
    Dice dice{std::mt19937(seed)};
    const int fruits = n / 20, leaves = 3 * n / 10, pieces = n - leaves - fruits;
    const double pi = std::numbers::pi;
    std::int32_t branch = 0;
    while (int(t.parent.size()) < pieces) {
        const int made = int(t.parent.size());
        // The first branch is the trunk; side branches start within a parent's radius of its axis.
        const std::int32_t p = made == 0 ? -1 : std::int32_t(dice(0, made));
        const double at = dice(0.1, 0.9), around = dice(-pi, pi), off = dice(0, 1);
        Vec3 size = p < 0 ? Vec3(0.5, 0.1, 0.1) : t.size[std::size_t(p)];
        double r = size.y() + (size.z() - size.y()) * at;
        Vec3 joint(off * r * std::cos(around), off * r * std::sin(around), size.x() * at);
        Quat rotation = turn(around, Vec3::UnitZ()) * turn(dice(0.5, 1.3), Vec3::UnitY());
        if (p < 0) joint.setZero(), rotation = upright();
        r *= p < 0 ? 1 : dice(0.4, 0.8);
        const int count = std::min(pieces - made, p < 0 ? 6 : 1 + int(dice(0, 6)));
        const double l = p < 0 ? 0.5 : size.x() * dice(0.5, 0.9), tip = r * dice(0, 0.5);
        const std::int32_t level = p < 0 ? 0 : t.level[std::size_t(p)] + 1;
        for (int i = 0; i < count; ++i) {
            const double a = double(i) / count, b = double(i + 1) / count;
            if (i > 0) joint = {0, 0, l}, rotation = turn(dice(-0.3, 0.3), Vec3(dice(-1, 1), dice(-1, 1), 0.1));
            add_piece(t, i == 0 ? p : made + i - 1, joint, rotation, l, r + (tip - r) * a, r + (tip - r) * b, branch,
                      level, a);
        }
        ++branch;
    }
    for (int i = 0; i < leaves + fruits; ++i) {
        const std::int32_t p = std::int32_t(dice(0, pieces));
        const std::size_t q = std::size_t(p);
        const double at = dice(0.1, 1), around = dice(-pi, pi);
        const Quat rotation = turn(around, Vec3::UnitZ()) * turn(dice(0.5, 1.5), Vec3::UnitY());
        const Vec3 joint(0, 0, at * t.size[q].x());
        if (i < leaves)
            add_leaf(t, p, joint, rotation, dice(0.05, 0.1), dice(0.03, 0.06), 3e-4, t.branch[q], t.level[q], t.s[q]);
        else
            add_fruit(t, p, joint, rotation, 0.05, dice(0.02, 0.04), t.branch[q], t.level[q], t.s[q]);
    }
    return t;
}

Tree forest(const std::vector<Tree>& trees) {
    Tree t;
    t.name = "forest";
    std::int32_t branches = 0;
    for (const Tree& more : trees) {
        const std::int32_t first = std::int32_t(t.parent.size());
        std::int32_t last_branch = branches - 1;
        for (std::size_t i = 0; i < more.parent.size(); ++i) {
            const std::int32_t p = more.parent[i];
            add_body(t, p < 0 ? -1 : p + first, more.kind[i], more.joint_position[i], more.joint_rotation[i],
                     more.size[i], more.branch[i] + branches, more.level[i], more.s[i]);
            t.mass.push_back(more.mass[i]);
            t.com.push_back(more.com[i]);
            t.inertia.push_back(more.inertia[i]);
            t.stiffness.push_back(more.stiffness[i]);
            t.damping.push_back(more.damping[i]);
            last_branch = std::max(last_branch, t.branch.back());
        }
        branches = last_branch + 1;
        const auto add_some = [&](auto& to, const auto& from, auto otherwise) {
            if (to.empty() && from.empty()) return;
            to.resize(std::size_t(first), otherwise);
            to.insert(to.end(), from.begin(), from.end());
            to.resize(t.parent.size(), otherwise);
        };
        add_some(t.leaf_count, more.leaf_count, 1);
        add_some(t.leaf_length, more.leaf_length, 0.0);
        add_some(t.leaf_width, more.leaf_width, 0.0);
        add_some(t.leaf_facing, more.leaf_facing, 0.0);
        add_some(t.drag, more.drag, 1.0);
    }
    return t;
}

} // namespace make_tree
