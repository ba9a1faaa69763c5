#include "shelter.h"
#include "body_air.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace bough {
namespace {

constexpr double calm = 1e-12; // [1] of u^2: none is left

struct Obstacle {
    double along; // [m] centre of mass along the wind
    std::size_t body;
    std::pair<std::int64_t, std::int64_t> column;
};

// World poses at the start: of each body its rotation and its joint.
struct Poses {
    std::vector<Mat3> R;
    std::vector<Vec3> x;
};
template <class T> Poses start_poses(const Plan<T>& plan) {
    Poses pose{std::vector<Mat3>(plan.bodies), std::vector<Vec3>(plan.bodies)};
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const Mat3 R = plan.R_pj[i].template cast<double>() *
                       rotation_from_vector<double>(plan.theta_start[i].template cast<double>());
        const Vec3 d = plan.joint_position[i].template cast<double>();
        const bool root = plan.parent[i] < 0;
        const auto p = std::size_t(plan.parent[i]);
        pose.R[i] = root ? R : Mat3(pose.R[p] * R);
        pose.x[i] = root ? d : Vec3(pose.x[p] + pose.R[p] * d);
    }
    return pose;
}

// u_b of what the column reaches with u_0^2: u_b^2 s(u_b) = u_0^2 (1 - exp(-s(u_b))), of which the left side grows with u_b, the right one falls.
double within(double u2, const std::function<double(double)>& share) {
    double low = 0, high = std::sqrt(u2);
    for (int k = 0; k < 60; ++k) {
        const double u = (low + high) / 2, s = share(u);
        (u * u * s < -u2 * std::expm1(-s) ? low : high) = u;
    }
    return high;
}

} // namespace

template <class T> std::vector<T> shelter_factors(const Plan<T>& plan, const std::vector<double>& tree_drag) {
    std::vector<T> factors(plan.bodies, T(1));
    const double density = plan.scene.air_density, cell = plan.scene.wind->shelter->cell;
    if (density == 0) return factors;
    const double speed = plan.scene.wind->velocity.norm();
    const Vec3 e = plan.scene.wind->velocity / speed;
    const Vec3 side = (std::abs(e.y()) < 0.9 ? e.cross(Vec3::UnitY()) : e.cross(Vec3::UnitX())).normalized(),
               other = side.cross(e);
    const Poses pose = start_poses(plan);
    // [1] Of a column's flux, at the speed that the body has, u over the undisturbed. (Foliage folds, so that it is no constant.)
    const auto share = [&](std::size_t i, double u) {
        const Vec3 past = u * speed * e;
        return double(plan.drag_area[i]) / density *
               air_force(plan.kind[i], pose.R[i], past, double(facing_of(plan, i))).force.dot(e) /
               (past.squaredNorm() * cell * cell);
    };
    const auto bodies_in = [&](std::size_t i) { return tree_drag.empty() ? 1.0 : std::max(tree_drag[i], 1.0); };
    std::vector<Obstacle> obstacles;
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const Vec3 place = pose.x[i] + pose.R[i] * plan.com[i].template cast<double>();
        const double own = stands_for_many(plan.kind[i]) ? 0 : share(i, 1) / bodies_in(i);
        if (!(own < 1))
            throw std::domain_error("/wind/shelter/cell: is " + std::to_string(cell) + " m, but body " +
                                    std::to_string(i) + " alone drags as much as " + std::to_string(own) +
                                    " columns have; expected a larger one");
        obstacles.push_back(
            {place.dot(e),
             i,
             {std::int64_t(std::floor(place.dot(side) / cell)), std::int64_t(std::floor(place.dot(other) / cell))}});
    }
    std::sort(obstacles.begin(), obstacles.end(), [](const Obstacle& a, const Obstacle& b) {
        return std::pair(a.along, a.body) < std::pair(b.along, b.body);
    });
    std::map<std::pair<std::int64_t, std::int64_t>, double> left; // of each column: u^2 over the undisturbed
    for (const Obstacle& o : obstacles) {
        double& u2 = left.try_emplace(o.column, 1).first->second;
        double u = std::sqrt(u2);
        const auto own_share = [&](double at) { return share(o.body, at); };
        const bool many = stands_for_many(plan.kind[o.body]) || bodies_in(o.body) > 1;
        if (u2 < calm) {
            u = 0;
        } else if (many || own_share(u) > 0.5) {
            u = within(u2, own_share);
            u2 *= std::exp(-own_share(u));
        } else {
            u2 *= 1 - own_share(u);
        }
        factors[o.body] = T(u);
    }
    return factors;
}

#define BOUGH_INSTANTIATE(T) template std::vector<T> shelter_factors(const Plan<T>&, const std::vector<double>&);
#include "../base/instantiate.inc"

} // namespace bough
