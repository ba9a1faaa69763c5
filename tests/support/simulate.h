// simulate.h: a tree, a scene, steps: what the tests of motion share.
#pragma once
#include "lib/plan/state.h"
#include "lib/plan/state_update.h"
#include "lib/study/energy.h"
#include "lib/study/solvers.h"

namespace simulate {

using namespace bough;

template <class T> struct PlainRun {
    Plan<T> plan;
    State<T> state;
    PlainRun(const Tree& tree, const Scene& scene, double dt = 1.0 / 30, const Wishes& wishes = {})
        : plan(make_plan<T>(tree, {{0, tree.size_bodies(), 0}}, scene, wishes, dt, Solver::analytic)),
          state(make_state(plan)) {}
    void steps(int n) {
        for (int k = 0; k < n; ++k) advance(plan, state);
    }
    // Kinetic (of the joints), elastic and potential: what the springs promise not to raise.
    double total_energy() const {
        const Energy e = energy(plan, state);
        return e.kinetic + e.elastic + e.potential;
    }
    double largest_angle() const {
        double a = 0;
        for (const auto& theta : state.theta) a = std::max(a, double(theta.norm()));
        return a;
    }
};

// A scene with nothing in it: no gravity, no air.
inline Scene nothing() {
    Scene scene;
    scene.gravity.setZero();
    scene.pose = Pose::rest;
    return scene;
}

inline Wind still_air() {
    Wind wind;
    wind.profile = 0;
    return wind;
}

inline Wind steady(double speed) {
    Wind wind = still_air();
    wind.velocity = Vec3(speed, 0, 0);
    return wind;
}

} // namespace simulate
