// coupled_support.h: a tree, a scene and the coupled step, and motions held against the articulated reference.
#pragma once
#include "lib/plan/ground.h"
#include "lib/study/energy.h"
#include "lib/study/solvers.h"
#include "lib/study/trajectory.h"
#include "tests/support/coupled_cases.h"
#include "tests/support/solver_parts.h"
#include "tests/support/solver_support.h"
#include <catch2/catch.hpp>

namespace coupled {

using namespace bough;

constexpr std::array<Scheme, 4> extrapolating{Scheme::p12, Scheme::p25, Scheme::p50, Scheme::p34};

template <class T = double> struct CoupledRun {
    Plan<T> plan;
    State<T> state;
    CoupledRun(const Tree& tree, const Scene& scene, Scheme scheme = Scheme::p12, double dt = 1.0 / 30)
        : plan(make_plan<T>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, dt, Solver::coupled, scheme)),
          state(make_state(plan)) {}
    void steps(int n) {
        for (int k = 0; k < n; ++k) advance(plan, state);
    }
    double total_energy() const {
        const Energy e = energy(plan, state);
        return e.bodies + e.elastic + e.potential;
    }
};

// A tree let go from theta (empty: where the plan starts it) at rest, for some frames of 1/30 s. ground: in place of the scene's.
struct Motion {
    Tree tree;
    Scene scene;
    int frames = 30;
    std::vector<Vec3> theta{};
    std::optional<RootSpline> ground{};
};

// Frames x tips [m], as seen from the ground.
using Track = std::vector<std::vector<Vec3>>;

inline Track track_of(const Motion& motion, Plan<double> plan, int steps_per_frame) {
    if (motion.ground) plan.splines = {*motion.ground};
    State<double> state = make_state(plan);
    if (!motion.theta.empty()) state.theta = motion.theta;
    move_ground(plan, state, 0);
    state_update(plan, state);
    const std::vector<std::size_t> tips = tip_bodies(motion.tree);
    Track track;
    for (int f = 0; f <= motion.frames; ++f) {
        for (int k = 0; f > 0 && k < steps_per_frame; ++k) advance(plan, state);
        track.emplace_back();
        for (const std::size_t i : tips) {
            Vec3 x = state.x_w[i] + state.R_wb[i].col(2) * motion.tree.size[i][0];
            if (const Ground* ground = plan.root_motion ? ground_of(plan, state, i) : nullptr)
                x = ground->R.transpose() * (x - ground->x);
            track.back().push_back(x);
        }
    }
    REQUIRE(state.flags.unresolved == 0);
    REQUIRE(state.flags.fast_turns == 0);
    return track;
}

inline Plan<double> plan_of(const Motion& motion, Solver solver, Scheme scheme, int steps_per_frame) {
    Scene scene = motion.scene;
    if (motion.ground) scene.root_motion = {two_keys()};
    return make_plan<double>(motion.tree, {{0, motion.tree.size_bodies(), 0}}, scene, {}, 1 / (30.0 * steps_per_frame),
                             solver, scheme);
}

// tolerance [rad] a step, absolute (extrapolation.h).
inline Track truth_of(const Motion& motion, double tolerance = 1e-10) {
    Plan<double> plan = plan_of(motion, Solver::articulated_reference, Scheme::p12, 1);
    parts::set_tolerance(plan, tolerance);
    return track_of(motion, plan, 1);
}

// Root mean square of the tips' distance between two runs over tips and frames, over that of the second's tips from its start.
inline double track_error(const Track& run, const Track& truth) {
    double off = 0, way = 0;
    for (std::size_t f = 0; f < truth.size(); ++f)
        for (std::size_t k = 0; k < truth[f].size(); ++k) {
            off += (run[f][k] - truth[f][k]).squaredNorm();
            way += (truth[f][k] - truth[0][k]).squaredNorm();
        }
    return std::sqrt(off / way);
}

inline double error_of(const Motion& motion, const Track& truth, Scheme scheme, int steps_per_frame) {
    return track_error(track_of(motion, plan_of(motion, Solver::coupled, scheme, steps_per_frame), steps_per_frame),
                       truth);
}

// The order that halving the step from h = 1 / (30 n) s shows.
inline double order_at(const Motion& motion, const Track& truth, Scheme scheme, int n) {
    return std::log2(error_of(motion, truth, scheme, n) / error_of(motion, truth, scheme, 2 * n));
}

} // namespace coupled
