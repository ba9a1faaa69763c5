#include "trajectory.h"
#include "../plan/ground.h"
#include "body_poses.h"
#include "solvers.h"
#include <chrono>
#include <cmath>

namespace bough {
namespace {

// What of a run is kept of all bodies: the ends of the wood, the joints' angles, and statistics.
struct Bodies {
    std::vector<std::size_t> wood;
    MotionStatistics statistics;
};

template <class T> void sample_bodies(const Plan<T>& plan, const State<T>& state, Bodies& bodies, Trajectory& out) {
    BodyPoses poses = body_poses(plan, state, bodies.statistics.tree());
    bodies.statistics.add(poses.x, poses.R, poses.theta, poses.v);
    out.wood.emplace_back();
    for (const std::size_t i : bodies.wood)
        out.wood.back().push_back(poses.x[i] + poses.R[i].col(2) * bodies.statistics.tree().size[i][0]);
    out.theta.push_back(std::move(poses.theta));
}

template <class T>
bool sample(const Plan<T>& plan, const State<T>& state, const Tree& tree, const std::vector<std::size_t>& tips,
            Bodies* bodies, Trajectory& out) {
    if (first_non_finite(state)) return false;
    std::vector<Vec3> tip;
    tip.reserve(tips.size());
    for (const std::size_t i : tips) {
        tip.push_back(tip_position(plan, state, tree, i));
        if (!tip.back().allFinite()) return false;
    }
    out.tip.push_back(std::move(tip));
    if (bodies) sample_bodies(plan, state, *bodies, out);
    return true;
}

template <class T>
Trajectory run(const Problem& problem, const Variant& how, bool all_bodies, int repeat,
               const std::function<void()>& tick) {
    using Time = std::chrono::steady_clock;
    Scene scene = for_solver(problem.scene, how.solver);
    scene.joint_inertia = how.inertia;
    const double dt = 1 / (problem.fps * how.steps_per_frame);
    Plan<T> plan = make_plan<T>(problem.tree, problem.ranges, scene, {}, dt, how.solver, how.scheme, problem.simd, 0,
                                how.tolerance);
    const std::vector<std::size_t> tips = tip_bodies(problem.tree);
    const auto stride = std::int64_t(std::max(1.0, 1 / how.steps_per_frame));
    const auto substeps = std::int64_t(std::max(1.0, how.steps_per_frame));
    Trajectory best;
    for (int k = 0; k < repeat; ++k) {
        Trajectory now;
        now.stride = stride;
        std::optional<Bodies> bodies;
        if (all_bodies) bodies.emplace(Bodies{wood_bodies(problem.tree), {problem.tree, problem.fps}});
        Bodies* const kept = bodies ? &*bodies : nullptr;
        State<T> state = make_state(plan);
        now.finite = sample(plan, state, problem.tree, tips, kept, now);
        for (std::int64_t f = stride; now.finite && f < problem.frames; f += stride) {
            tick();
            const Time::time_point start = Time::now();
            for (std::int64_t s = 0; s < substeps; ++s) advance(plan, state);
            now.seconds += std::chrono::duration<double>(Time::now() - start).count();
            present(plan, state);
            now.finite = sample(plan, state, problem.tree, tips, kept, now);
        }
        if (bodies && stride == 1) now.motion = bodies->statistics.result();
        now.hash = state_hash(state);
        now.flags = state.flags;
        if (k == 0 || now.seconds < best.seconds) best = std::move(now);
    }
    return best;
}

} // namespace

Trajectory run_trajectory(const Problem& problem, const Variant& how, bool all_bodies, int repeat,
                          const std::function<void()>& tick) {
    return how.single ? run<float>(problem, how, all_bodies, repeat, tick)
                      : run<double>(problem, how, all_bodies, repeat, tick);
}

} // namespace bough
