#include "reduce_air.h"
#include "../base/cholesky.h"
#include "../laws/air.h"
#include "../model/drawn_pose.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <numbers>

namespace bough {
namespace {

// Even over the sphere: heights in equal steps, turned by the golden angle from one to the next.
std::array<Vec3, 64> even_directions() {
    std::array<Vec3, 64> all;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    for (std::size_t k = 0; k < all.size(); ++k) {
        const double z = 1 - (2 * double(k) + 1) / double(all.size()), r = std::sqrt(1 - z * z);
        all[k] = Vec3(r * std::cos(golden * double(k)), r * std::sin(golden * double(k)), z);
    }
    return all;
}

// Least squares of sum of bodies' forces by one force law: drag = sum f.g / sum g.g, what is left of sum |f|^2.
struct Fit {
    double drag = 0, left = 0;
};
struct Fits {
    double ff = 0, fc = 0, cc = 0, fs = 0, ss = 0; // f: the sum; c: a cylinder along z, s: a sphere; of kappa A = 1
    Fit cylinder() const { return {fc / cc, ff - fc * fc / cc}; }
    Fit sphere() const { return {fs / ss, ff - fs * fs / ss}; }
};

// Mean over all directions of the wind of a body's drag, f.u, of kappa A = 1.
double mean_drag(Kind kind) {
    return kind == Kind::branch ? 3 * std::numbers::pi / 16 : is_flat(kind) ? blade_mean : 1.0;
}

// How much a direction counts, by the cosine of its angle to the wind, to or fro.
double weight_of(double cosine) {
    return 0.02 + std::pow(cosine, 8);
}

} // namespace

// Mass at a group's joint belongs as well to what it hangs on: it turns nothing about the joint, and the joint's place is the parent's. So
// the rest can have its centre where the air acts, from the ends inward.
void center_on_pressure(const Tree& whole, Reduced& r, const std::vector<std::uint8_t>& joined, double plate_kappa) {
    Tree& t = r.tree;
    std::vector<Vec3> pressed(joined.size(), Vec3::Zero()); // [m^3] first moment of drag areas
    std::vector<double> drag(joined.size(), 0);             // [m^2]
    each_joined(r, joined, [&](std::size_t i, std::size_t g) {
        const double area = mean_drag(whole.kind[i]) * drag_area(whole, i, whole.kind[i], 1, plate_kappa);
        drag[g] += area;
        pressed[g] += area * Vec3(r.offset[i] + r.rotation[i] * whole.com[i]);
    });
    for (std::size_t g = joined.size(); g-- > 0;) {
        const double arm = t.com[g].norm(), first = t.mass[g] * arm;
        if (!joined[g] || !(drag[g] > 0) || !(first > 0)) continue;
        const Vec3 along = t.com[g] / arm;
        // Centres farther out leave less inertia about them, J - first to across: none of some axis at `all`.
        const Mat3 across = Mat3::Identity() - along * along.transpose();
        const Mat3 about_joint = t.inertia[g] + first * arm * across;
        const Cholesky<double> root(about_joint);
        if (!root.positive) continue;
        Mat3 half = first * across;
        solve_lower(root.L, half);
        Mat3 taken = half.transpose();
        solve_lower(root.L, taken);
        const double all = 1 / Eigen::SelfAdjointEigenSolver<Mat3>(taken, Eigen::EigenvaluesOnly).eigenvalues()[2];
        const double to = std::min(pressed[g].dot(along) / drag[g], arm + 0.95 * (all - arm));
        if (!(to > arm)) continue;
        const double moved = t.mass[g] - first / to;
        t.mass[g] = first / to;
        t.com[g] = to * along;
        t.inertia[g] = about_joint - first * to * across;
        if (t.parent[g] < 0) continue; // mass on the ground
        const auto p = std::size_t(t.parent[g]);
        const Vec3 center = (t.mass[p] * t.com[p] + moved * t.joint_position[g]) / (t.mass[p] + moved);
        const auto about = [](const Vec3& d) { return Mat3(d.squaredNorm() * Mat3::Identity() - d * d.transpose()); };
        t.inertia[p] += t.mass[p] * about(t.com[p] - center) + moved * about(t.joint_position[g] - center);
        t.mass[p] += moved;
        t.com[p] = center;
    }
}

// The sum of the bodies' forces, direction by direction, a group after another.
void fit_air(const Tree& whole, Reduced& r, const std::vector<std::uint8_t>& joined, double plate_kappa,
             const Vec3& toward) {
    Tree& t = r.tree;
    const std::array<Vec3, 64> directions = even_directions();
    std::vector<std::vector<std::int32_t>> members(joined.size());
    std::vector<double> reach(joined.size(), 0);
    each_joined(r, joined, [&](std::size_t i, std::size_t g) {
        members[g].push_back(std::int32_t(i));
        const bool own = whole.branch[i] == t.branch[g] && whole.kind[i] == t.kind[g];
        if (own) reach[g] = std::max(reach[g], (r.offset[i] + r.rotation[i] * Vec3(0, 0, whole.size[i][0])).norm());
    });
    const Mat3 one = Mat3::Identity();
    const DrawnPose drawn = drawn_pose(t);
    for (std::size_t g = 0; g < joined.size(); ++g) {
        if (!joined[g]) continue;
        std::array<Vec3, 64> force;
        force.fill(Vec3::Zero());
        const Vec3 up = drawn.R_wb[g].row(1); // in the group's axes
        for (const std::int32_t member : members[g]) {
            const auto i = std::size_t(member);
            const Kind kind = kind_in_air(whole, i);
            const double drag = drag_area(whole, i, kind, 1, plate_kappa), facing = facing_in_air(whole, i);
            const Mat3 R = r.rotation[i].toRotationMatrix();
            for (std::size_t k = 0; k < directions.size(); ++k)
                force[k] += drag / unfolded(kind, 1.0) * air_force(kind, R, directions[k], facing, up).force;
        }
        Fits fits;
        for (std::size_t k = 0; k < directions.size(); ++k) {
            const double w = toward.isZero() ? 1 : weight_of((drawn.R_wb[g] * directions[k]).dot(toward));
            const Vec3 cylinder = air_force(Kind::branch, one, directions[k]).force;
            fits.ff += w * force[k].squaredNorm();
            fits.fc += w * force[k].dot(cylinder);
            fits.cc += w * cylinder.squaredNorm();
            fits.fs += w * force[k].dot(directions[k]);
            fits.ss += w;
        }
        const Fit cylinder = fits.cylinder(), sphere = fits.sphere();
        const double length = std::max(reach[g], t.com[g].norm());
        if (!t.drag.empty()) t.drag[g] = 1; // the size has it all
        if (t.kind[g] == Kind::branch && cylinder.left <= sphere.left) {
            const double radius = cylinder.drag / (cylinder_drag / 2) / (2 * length);
            t.size[g] = Vec3(length, radius, radius);
        } else {
            const double radius = std::sqrt(sphere.drag / (sphere_drag / 2) / std::numbers::pi);
            t.size[g] = Vec3(length, radius, radius);
            t.rigid.resize(joined.size(), 0);
            t.rigid[g] = round_to_air;
        }
    }
}

} // namespace bough
