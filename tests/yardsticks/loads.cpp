#include "loads.h"
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace yardstick {
namespace {

// (1/a^2)(1 - (a/2) cot(a/2)): by the recurrence-free series of x cot x up to x^12 where the quotient would lose digits.
double rate_coefficient(double a) {
    if (a > 0.3) return (1 - a / 2 / std::tan(a / 2)) / (a * a);
    const double x2 = a * a / 4; // x cot x = 1 - x^2/3 - x^4/45 - 2 x^6/945 - x^8/4725 - 2 x^10/93555 - ...
    return (1.0 / 3 + x2 * (1.0 / 45 + x2 * (2.0 / 945 + x2 * (1.0 / 4725 + x2 * (2.0 / 93555))))) / 4;
}

Vec3 wind_at(const bough::Wind& wind, double time) {
    if (wind.turbulence != 0 || wind.profile != 0)
        throw std::runtime_error("yardstick: uniform wind without turbulence only");
    if (wind.gust_factor == 1) return wind.velocity;
    const double mean = std::exp(-2.0) * std::cyl_bessel_i(0.0, 2.0);
    const double g = (std::exp(2 * (std::cos(2 * std::numbers::pi * time / wind.gust_period) - 1)) - mean) / (1 - mean);
    return wind.velocity * (1 + (wind.gust_factor - 1) * g);
}

// [m/s] The speed that foliage's drag and damping go with. Leaves roll up, at 7.5 m/s. Those of a clump turn with the wind besides, at 7.2 m/s.
double folded_speed(bool clump, double speed) {
    const double turned = clump ? 0.66 + 0.34 / (1 + std::pow(speed / 7.2, 4)) : 1;
    return turned * speed / (1 + speed / 7.5);
}

Vec3 air_force(const Tree& tree, std::size_t i, double density, const Mat3& R, const Vec3& u) {
    const Vec3& size = tree.size[i];
    switch (tree.kind[i]) {
    case bough::Kind::branch: {
        const Vec3 along = R.col(2), across = u - along * along.dot(u);
        return 0.6 * density * size[0] * (size[1] + size[2]) * across.norm() * across;
    }
    case bough::Kind::fruit:
        return 0.235 * density * std::numbers::pi * size[1] * size[1] * u.norm() * u;
    default: {
        const bool clump = is_clump(tree, i);
        const Vec3 normal = clump ? Vec3(Vec3::UnitY()) : Vec3(R.col(1)); // a clump's leaves keep theirs as it leans
        // Of a clump's leaves so many face along its normal, the others all ways: half of a leaf's drag broadside, whichever way.
        const double face = !clump ? 1 : tree.leaf_facing.empty() ? 0 : tree.leaf_facing[i];
        // A quarter of a plate's drag is from all sides.
        const Vec3 plate = 0.75 * u.dot(normal) * normal + 0.25 * u;
        return 0.6 * density * (size[0] * size[1] / 2) * folded_speed(clump, u.norm()) *
               (face * plate + (1 - face) * 0.5 * u);
    }
    }
}

Vec3 pull_at(const bough::Pull& pull, double time) {
    for (std::size_t k = 0; k + 1 < pull.time.size(); ++k)
        if (time >= pull.time[k] && time <= pull.time[k + 1])
            return pull.force[k] +
                   (time - pull.time[k]) / (pull.time[k + 1] - pull.time[k]) * (pull.force[k + 1] - pull.force[k]);
    return Vec3::Zero();
}

} // namespace

Vec3 rotation_vector(const Quat& turn) {
    const double sine = turn.vec().norm();
    if (sine == 0) return Vec3::Zero();
    double half = std::atan2(sine, turn.w());
    if (half > std::numbers::pi / 2) half -= std::numbers::pi;
    return 2 * half / sine * turn.vec();
}

Mat3 rate_map(const Vec3& theta) {
    Mat3 cross;
    cross << 0, -theta[2], theta[1], theta[2], 0, -theta[0], -theta[1], theta[0], 0;
    return Mat3::Identity() + cross / 2 + rate_coefficient(theta.norm()) * cross * cross;
}

Quat turn_of(const Vec3& theta) {
    const double a = theta.norm();
    return a == 0 ? Quat(Quat::Identity()) : Quat(Eigen::Quaterniond(Eigen::AngleAxisd(a, theta / a)));
}

void compute_loads(const Tree& tree, const bough::Scene& scene, const std::vector<Target>& targets, double time,
                   const Motion& motion, const Bodies& bodies, Loads& loads) {
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const Vec3 theta = rotation_vector(motion.turn[i]);
        const Mat3 T = rate_map(theta);
        const double beta = scene.damping_scale * tree.damping[i];
        const Vec3 stretched = theta + beta * (T * motion.rate[i]);
        loads.torque[i] = -scene.stiffness_scale * (T.transpose() * tree.stiffness[i].cwiseProduct(stretched));
        loads.force[i].setZero();
        loads.moment[i].setZero();
        if (!scene.wind) continue;
        const Vec3 u = wind_at(*scene.wind, time) - bodies.com_velocity[i];
        const double density = scene.air_density * (tree.drag.empty() ? 1 : tree.drag[i]);
        loads.force[i] = air_force(tree, i, density, bodies.R_wb[i], u);
        if (tree.kind[i] != bough::Kind::leaf) continue;
        const double area = 0.6 * density * tree.size[i][0] * tree.size[i][1] / 2;
        const bool clump = is_clump(tree, i);
        const double rate = (clump ? 1 : 6) * area / tree.mass[i] * folded_speed(clump, u.norm());
        const Mat3 I = bodies.R_wb[i] * tree.inertia[i] * bodies.R_wb[i].transpose();
        loads.moment[i] -= rate * I * bodies.omega[i];
    }
    for (std::size_t k = 0; k < targets.size(); ++k) {
        const std::size_t b = targets[k].body;
        const Vec3 f = pull_at(scene.pulls[k], time);
        loads.force[b] += f;
        loads.moment[b] += (bodies.R_wb[b] * (targets[k].point_b - tree.com[b])).cross(f);
    }
}

} // namespace yardstick
