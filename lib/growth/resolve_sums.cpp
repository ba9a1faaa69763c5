#include "resolve_sums.h"
#include "../model/body_shape.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bough {
namespace {

// d log (G |u|) / d log |u| at 8 m/s
double grows_at_8(Kind many) {
    const Unfolding<double> G = unfolding(many, 8.0);
    return G.slope / G.share;
}

// How the air meets a body, as leaves that face along `axis` by `facing` (Tree::leaf_facing). A blade faces along its normal wholly. Wood has -1,
// where c_n + c_u of air.h is 0: as (21), the law then has no force along the axis. (No leaves have -1; those of which none faces along an axis
// have -1/2.)
struct Face {
    Vec3 axis;
    double facing;
};
Face face_of(const Tree& tree, std::size_t i, const Mat3& R) {
    if (is_clump(tree, i)) return {Vec3::UnitY(), tree.leaf_facing.empty() ? 0 : tree.leaf_facing[i]};
    if (is_flat(tree.kind[i])) return {R.col(1), 1};
    return {R.col(2), tree.kind[i] == Kind::fruit ? 0.0 : -1.0};
}

// [m^2] of n n^T, n the normals of leaves of this area.
Mat3 faces_of(const Face& face, double area) {
    return area * ((1 - face.facing) / 3 * Mat3::Identity() + face.facing * face.axis * face.axis.transpose());
}

// [m^2] A branch's or a fruit's, as wood across the wind of the same drag in horizontal winds.
double wood_across(const Tree& tree, std::size_t i, const Mat3& R) {
    const Vec3& size = tree.size[i];
    if (tree.kind[i] == Kind::fruit) return sphere_drag / cylinder_drag * sphere_section(size[1]);
    return frustum_section(size[0], size[1], size[2]) * met_by_wind_across(R.col(2));
}

// What a joint further out, whose load's first moment is `outer`, feels of a torque about the first joint of its branch, whose load's is
// `inner`: all loads growing alike. Torques are across the moments under any acceleration; along them, that of the moment's own share. No
// more than all of it.
Mat3 share_of_torque(const Vec3& outer, const Vec3& inner) {
    const double square = inner.squaredNorm();
    if (!(square > 0)) return Mat3::Identity();
    const double share = std::clamp(outer.dot(inner) / square, 0.0, 1.0);
    const Mat3 M =
        (outer.dot(inner) * Mat3::Identity() - inner * outer.transpose() + share * inner * inner.transpose()) / square;
    return M / std::max(1.0, M.norm() / std::sqrt(3.0));
}

void add_up(const Tree& whole, const Flexibility& bend, const Resolution& chosen, std::vector<Sums>& sums) {
    const std::size_t n = whole.size_bodies();
    const double in_leaf = wood_in_leaf(kind_of_many_leaves(whole));
    for (std::size_t i = 0; i < n; ++i) {
        Sums& s = sums[std::size_t(chosen.body[i])];
        const Vec3 &size = whole.size[i], center = bend.pose.at(i, whole.com[i]);
        s.mass += whole.mass[i];
        s.first += whole.mass[i] * center;
        s.give += bend.give[i];
        s.damping = std::max(s.damping, whole.damping[i]);
        s.upright &= bend.upright[i] != 0;
        ++s.parts;
        const Face face = face_of(whole, i, bend.pose.R_wb[i]);
        if (is_flat(whole.kind[i])) {
            const double area = foliage_area(whole, i);
            const double met = area * met_by_wind(face.axis, face.facing);
            s.faces += faces_of(face, area);
            s.leaves += area;
            s.met += met;
            s.air += met * center;
            s.thickness += area * size[2];
            s.proportion += area * size[1] / size[0];
            s.count += whole.leaf_count.empty() ? 1 : whole.leaf_count[i];
        } else {
            const double wood = wood_across(whole, i, bend.pose.R_wb[i]);
            s.wood += wood;
            s.air += wood * in_leaf * center;
            s.faces += faces_of(face, wood * in_leaf / met_by_wind(face.axis, face.facing));
        }
        const std::int32_t p = whole.parent[i];
        if (p < 0 || chosen.body[std::size_t(p)] != chosen.body[i]) {
            s.joints += bend.mass[i] * bend.pose.x_w[i];
            s.joined += bend.mass[i];
        }
        const auto first = std::size_t(chosen.first[std::size_t(chosen.body[i])]);
        if (whole.kind[i] == Kind::branch && whole.kind[first] == Kind::branch &&
            whole.branch[i] == whole.branch[first]) {
            s.last = std::int32_t(i);
            const Mat3 M = share_of_torque(bend.first[i], bend.first[first]);
            s.yields += M.transpose() * stiffness_w(whole, i, bend.pose.R_wb[i]).inverse() * M;
        }
    }
    for (Sums& s : sums) s.com = s.first / s.mass;
    for (std::size_t i = 0; i < n; ++i) {
        Sums& s = sums[std::size_t(chosen.body[i])];
        const Mat3& R = bend.pose.R_wb[i];
        const Mat3 d = cross_matrix<double>(bend.pose.at(i, whole.com[i]) - s.com);
        s.inertia += R * whole.inertia[i] * R.transpose() - whole.mass[i] * d * d;
    }
}

// How the parts of a body bend where what bears it is held.
void add_bend(const Tree& whole, const Flexibility& bend, const Resolution& chosen, std::vector<Sums>& sums) {
    const Kind many = kind_of_many_leaves(whole);
    const double in_leaf = wood_in_leaf(many);
    bends(whole, bend, chosen.body, [&](std::size_t i, const Bend& b) {
        Sums& s = sums[std::size_t(chosen.body[i])];
        const Mat3& R = bend.pose.R_wb[i];
        s.loss += whole.damping[i] * b.turn.cwiseProduct(stiffness_w(whole, i, R) * b.turn).sum();
        s.swing += whole.mass[i] * b.center.squaredNorm() +
                   b.turned.cwiseProduct(R * whole.inertia[i] * R.transpose() * b.turned).sum();
        if (is_flat(whole.kind[i])) {
            const Face face = face_of(whole, i, R);
            s.braked +=
                foliage_area(whole, i) * b.center.cwiseProduct(damped(many, face.axis, face.facing) * b.center).sum();
        } else {
            const bool wood = whole.kind[i] == Kind::branch;
            const Vec3& size = whole.size[i];
            const double area = wood ? frustum_section(size[0], size[1], size[2]) : wood_across(whole, i, R);
            const Mat3 D = wood ? damped_wood(R.col(2)) : Mat3(Vec3(1.5, 1, 1.5).asDiagonal());
            s.braked += area * in_leaf * b.center.cwiseProduct(D * b.center).sum();
        }
    });
}

} // namespace

Kind kind_of_many_leaves(const Tree& tree) {
    double area = 0, proportion = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        if (!is_flat(tree.kind[i])) continue;
        const double one = foliage_area(tree, i);
        area += one;
        proportion += one * leaf_proportion(tree, i);
    }
    return area > 0 ? kind_of_many(proportion / area) : Kind::clump;
}

double wood_in_leaf(Kind many) {
    return 2 / unfolding(many, 8.0).share;
}

// Of (1 - c^2)^3/2, c = u.t, to second order in the axis' level part, and
// exact for upright and level ones.
double met_by_wind_across(const Vec3& axis) {
    const double level = 1 - axis.y() * axis.y();
    return 1 - 0.75 * level + 0.1744 * level * level;
}

// Of a blade, air.h: (u.n)^2 is (1 - n_y^2) / 2 of |u|^2, which a quarter of its drag does not ask for. What blades that turn with the wind have
// less is in h of air.h.
double met_by_wind(const Vec3& n, double facing) {
    return 1 + facing * (-0.5 + 0.75 * (1 - n.y() * n.y()));
}

Mat3 damped(Kind many, const Vec3& n, double facing) {
    return (1 - facing / 2) * damped_all_ways(many) +
           1.5 * facing * (1 + grows_at_8(many) / 2 * (1 - n.y() * n.y())) * (n * n.transpose());
}

Mat3 damped_all_ways(Kind many) {
    const double level = 1 + grows_at_8(many) / 2;
    return Vec3(level, 1, level).asDiagonal();
}

Mat3 damped_wood(const Vec3& t) {
    constexpr int winds = 4; // those against them damp alike
    Mat3 sum = Mat3::Zero();
    for (int k = 0; k < winds; ++k) {
        const double angle = k * std::numbers::pi / winds;
        const Vec3 u(std::cos(angle), 0, std::sin(angle));
        const Vec3 across = u - u.dot(t) * t;
        const double speed = across.norm();
        if (speed > 0) sum += speed * (Mat3::Identity() - t * t.transpose()) + across * across.transpose() / speed;
    }
    return sum / winds;
}

std::vector<Sums> sum_up(const Tree& whole, const Flexibility& bend, const Resolution& chosen) {
    std::vector<Sums> sums(chosen.size());
    add_up(whole, bend, chosen, sums);
    add_bend(whole, bend, chosen, sums);
    return sums;
}

} // namespace bough
