#include "sway.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bough {

double sway_frequency(const Tree& tree, const Vec3& direction, double gravity) {
    const std::size_t n = tree.size_bodies();
    std::vector<Mat3> R_wb(n);
    std::vector<Vec3> x_w(n), com_w(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Mat3 R_pj = tree.joint_rotation[i].toRotationMatrix();
        const std::int32_t p = tree.parent[i];
        R_wb[i] = p < 0 ? R_pj : Mat3(R_wb[std::size_t(p)] * R_pj);
        x_w[i] =
            p < 0 ? tree.joint_position[i] : Vec3(x_w[std::size_t(p)] + R_wb[std::size_t(p)] * tree.joint_position[i]);
        com_w[i] = x_w[i] + R_wb[i] * tree.com[i];
    }
    std::vector<double> c_mass(tree.mass); // of a body and all beyond it
    std::vector<Vec3> c_moment(n);         // mass times position
    for (std::size_t i = 0; i < n; ++i) c_moment[i] = tree.mass[i] * com_w[i];
    for (std::size_t i = n; i-- > 0;)
        if (tree.parent[i] >= 0) {
            c_mass[std::size_t(tree.parent[i])] += c_mass[i];
            c_moment[std::size_t(tree.parent[i])] += c_moment[i];
        }
    // Small rotation, the joint's displacement and its height's second order, world.
    std::vector<Vec3> turn(n), shift(n);
    std::vector<double> rise(n);
    const auto second_order = [](const Vec3& w, const Vec3& arm) { return 0.5 * w.cross(w.cross(arm)).y(); };
    double elastic = 0, lifted = 0, inertial = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (!(tree.stiffness[i].minCoeff() > 0)) return 0;
        const Vec3 torque = R_wb[i].transpose() * (c_moment[i] - c_mass[i] * x_w[i]).cross(direction);
        const Vec3 theta = torque.cwiseQuotient(tree.stiffness[i]);
        const std::int32_t p = tree.parent[i];
        turn[i] = R_wb[i] * theta;
        shift[i] = Vec3::Zero();
        rise[i] = 0;
        if (p >= 0) {
            rise[i] = rise[std::size_t(p)] + second_order(turn[std::size_t(p)], x_w[i] - x_w[std::size_t(p)]);
            shift[i] = shift[std::size_t(p)] + turn[std::size_t(p)].cross(x_w[i] - x_w[std::size_t(p)]);
            turn[i] += turn[std::size_t(p)];
        }
        const Vec3 moved = shift[i] + turn[i].cross(com_w[i] - x_w[i]), turn_b = R_wb[i].transpose() * turn[i];
        elastic += theta.dot(torque);
        lifted += 2 * gravity * tree.mass[i] * (rise[i] + second_order(turn[i], com_w[i] - x_w[i]));
        inertial += tree.mass[i] * moved.squaredNorm() + turn_b.dot(tree.inertia[i] * turn_b);
    }
    return std::sqrt(std::max(0.0, elastic + lifted) / inertial) / (2 * std::numbers::pi);
}

} // namespace bough
