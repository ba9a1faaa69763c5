// stability.h: what `treeprofile stability` finds: a grid of extreme cases, each cell a bounded run of one case with one
// solver and precision. "Bounded" is the definition of lib/study/README.md; positions being finite proves nothing.
//
// Each cell starts at rest (stability_cases.h) and is judged by
// energy    E = kinetic (of the oscillators for the analytic step, of the bodies for all others) + elastic + potential. Never
//           above what it was at the start plus what the air could have put in, W = sum over steps of max(0, the air's moments at the
//           start times the joints' turns, those at the end times the same), by more than 1 % of the largest kinetic + elastic energy so far. (A jump
//           of the ground does work that is not booked: such cells are judged without.)
// growth    RMS tip deflection of the last quarter at most 1.05 times that of the third, where the load is a steady wind, damping
//           is on and a quarter holds a period of the first mode.
// motion    In the cases of a wind on the user's tree coupled moves as the truth does (stability_motion.h): bounded is not right.
// A joint past 1 rad has left the method's assumption of small angles a joint: `outside`, which is said, not excused.
// Ringing is sign changes of theta_dot a joint axis and frame, below a millionth of the largest rate left out; guards are those of StepFlags but
// buckling, which is physics, and joint limits, which the scene asks for.
#pragma once
#include "../plan/plan.h"
#include "solvers.h"
#include "stability_cases.h"
#include "stability_cell.h"
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace bough {

struct StabilityReport {
    std::vector<StabilityCell> cells;
    std::int64_t bodies = 0;
    double fps = 30;
};

struct StabilityOptions {
    std::int64_t frames = 100;          // steps a cell
    bool with_implicit = true;          // beside coupled and analytic in double and float, articulated_implicit
    std::string only;                   // cases whose group or name contains this; empty: all
    std::vector<std::string> without{}; // none whose group or name contains one of these
    bool with_truth = true;             // the cases of wind are held against the truth
};

struct MotionTruth;

// One cell: `frames` steps of the case with this solver and precision, of which that may be held against a truth of as many.
// tick once a step; may throw.
StabilityCell run_cell(const StabilitySetup&, const StabilityCase&, Solver, bool single, std::int64_t frames,
                       const std::function<void()>& tick, const MotionTruth* = nullptr);

// The whole grid for a user's tree and scene. progress(done, cells); may throw to end.
StabilityReport measure_stability(const StabilitySetup&, const StabilityOptions&,
                                  const std::function<void(std::int64_t, std::int64_t)>& progress);

} // namespace bough
