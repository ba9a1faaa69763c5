// trajectory.h: one run of one solver at one step length, kept as the positions of the tree's tips in each frame; where all
// bodies are asked for, also as those of the ends of its wood, the joints' angles, and what the motion is like.
#pragma once
#include "../model/tips.h"
#include "../plan/plan.h"
#include "../plan/state.h"
#include "../plan/tip_position.h"
#include "motion_statistics.h"
#include "solvers.h"
#include <functional>
#include <string>
#include <vector>

namespace bough {

// What is run: the joined tree, its scene, `frames` frames (the start included) at `fps`.
struct Problem {
    const Tree& tree;
    const std::vector<TreeRange>& ranges;
    Scene scene;
    double fps = 30;
    std::int64_t frames = 61;
    std::optional<fast::Target> simd = std::nullopt; // the fast path, for what it holds; none: the plain path
};

// How: one row of a work-precision table.
struct Variant {
    Solver solver = Solver::analytic;
    JointInertia inertia = JointInertia::branch; // analytic alone
    bool single = false;                         // float; coupled and analytic alone
    double steps_per_frame = 1;                  // 2^k; below 1 a step spans 1 / steps_per_frame frames
    double tolerance = 1e-8;                     // articulated_reference alone
    Scheme scheme = Scheme::p12;                 // coupled alone
};

struct Trajectory {
    std::int64_t stride = 1;            // frames between two samples
    std::vector<std::vector<Vec3>> tip; // [m] samples x tips, as seen from the tree's ground
    // Where all bodies are asked for:
    std::vector<std::vector<Vec3>> theta; // [rad] samples x joints
    std::vector<std::vector<Vec3>> wood;  // [m] samples x far ends of wood_bodies(), as seen from the tree's ground
    MotionSummary motion;                 // of runs of a step a frame and more, to the last finite frame
    double seconds = 0;                   // run time of the steps alone, the fastest of `repeat` runs
    bool finite = true;
    std::uint64_t hash = 0;
    StepFlags flags;
};

// tick is called once a frame and may throw to end the run. A run that becomes non-finite ends there (finite = false).
// Throws what make_plan throws. O(bodies) a step.
Trajectory run_trajectory(const Problem&, const Variant&, bool all_bodies, int repeat,
                          const std::function<void()>& tick);

} // namespace bough
