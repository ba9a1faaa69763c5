// solver_support.h: plans of one tree, and states in random motion, for the tests of the stages.
#pragma once
#include "lib/plan/state.h"
#include "lib/plan/state_update.h"
#include "lib/study/solvers.h"
#include "tests/support/make_tree.h"

namespace solver {

using namespace bough;

template <class T = double>
Plan<T> plan_of(const Tree& tree, const Scene& scene, double dt = 1.0 / 30, const Wishes& wishes = {}) {
    return make_plan<T>(tree, {{0, tree.size_bodies(), 0}}, scene, wishes, dt, Solver::analytic);
}

// No gravity, the drawn tree at rest: what a test adds is all that acts.
inline Scene empty_scene() {
    Scene scene;
    scene.gravity.setZero();
    scene.pose = Pose::rest;
    return scene;
}

inline Vec3 random_vector(make_tree::Dice& dice, double size) {
    const double x = dice(-size, size), y = dice(-size, size), z = dice(-size, size);
    return {x, y, z};
}

// theta and theta_dot at random, kinematics up to date; the rates carried by the springs stay zero.
template <class T> void shake(const Plan<T>& plan, State<T>& state, unsigned seed, double angle, double rate) {
    make_tree::Dice dice{std::mt19937(seed)};
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        state.theta[i] = random_vector(dice, angle).template cast<T>();
        state.theta_dot[i] = random_vector(dice, rate).template cast<T>();
    }
    state_update(plan, state);
}

} // namespace solver
