// coupled_cases.h: a tree with leaves and fruit, pulls and moving grounds for the tests of the coupled step.
#pragma once
#include "lib/model/root_motion.h"
#include "tests/support/paper_trees.h"

namespace coupled {

using namespace bough;

// paper_trees::branched with five leaves and two fruits on the branches' ends: 28 bodies.
inline Tree leafy(double E, double beta) {
    Tree tree = paper_trees::branched(E, beta);
    for (const std::int32_t on : {10, 15, 20, 9, 13})
        make_tree::add_leaf(tree, on, {0, 0, 0.1}, make_tree::turn(0.4 * on, Vec3(1, 0.3, 0.2)), 0.08, 0.05, 3e-4, 1, 1,
                            1);
    for (const std::int32_t on : {10, 15})
        make_tree::add_fruit(tree, on, {0, 0, 0.12}, make_tree::turn(2.5, Vec3::UnitY()), 0.06, 0.03, 1, 1, 1);
    return tree;
}

inline Pull pull_on(std::int64_t body, const Vec3& from, const Vec3& to) {
    Pull pull;
    pull.on.body = body;
    pull.time = {0, 2};
    pull.force = {from, to};
    return pull;
}

// A ground of velocity v [m/s] at time 0, steady acceleration a, steady omega [rad/s] about the world's origin; for two seconds.
inline RootSpline steady_ground(const Vec3& v, const Vec3& a, const Vec3& omega) {
    const double T = 2;
    RootSpline s;
    s.position = QuinticSpline{{0, T}, {Vec3::Zero(), v * T + a * (T * T / 2)}, {v, v + a * T}, {a, a}};
    s.rotation = QuinticSpline{{0, T}, {Vec3::Zero(), omega * T}, {omega, omega}, {Vec3::Zero(), Vec3::Zero()}};
    return s;
}

// What a plan for such a ground is made from: its splines are then replaced.
inline RootMotion two_keys() {
    RootMotion keys;
    keys.time = {0, 1};
    keys.position.assign(2, Vec3::Zero());
    return keys;
}

} // namespace coupled
