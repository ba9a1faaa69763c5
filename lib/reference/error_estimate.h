// error_estimate.h: what a run with the coupled solver loses at its step, seen from inside the run: beside it goes a
// companion, the same plan with twice the step, and the branches' tips of both are compared (step doubling: Hairer,
// Norsett, Wanner, Solving Ordinary Differential Equations I, II.4). The companion never returns to the run: it is the
// error of the whole motion so far that is seen, not that of one step.
//
// Reading. Where the error falls with h^q, difference = (2^q - 1) error. q is 1 to 3 here and changes with tree, load
// and step (stiff joints in a changing load 1, the springs of a resolved mode 3), so the difference itself is taken, as
// at order 1: a bound more than a middle. A third run at 4 h would not tell q: where that run no longer resolves the
// motion, the differences say 3 and more of runs whose error falls with h.
// Measured against articulated_reference, 2 to 3 s at 1/30 to 1/240 s: a chain of 20 and a branched tree of 21 rods
// with first modes of 0.3 to 11 Hz under gravity switched on, gusts, storm and a shaken root; an apple of 1000 bodies
// in gusts and under gravity switched on. Difference / error, of the tips' RMS, where resolved() below holds:
//   P12       0.76 to 9.6, half of them above 3; one at 0.45 (11 Hz at 1/30 s). Of the worst tip 0.42 to 12.5
//   P.5       0.76 to 10
//   P34       0.56 to 33: its own order is higher
//   LIE       0.05 to 1.2, below 1/2 for half of them: it damps what a step should resolve
// What both runs lose is not seen: an oscillation of frequency f > 1/(4 h) that a jolt sets off (a load switched on, a
// root that jerks) is damped away in either. At 36 and 114 Hz the difference was down to 1/100 of the error.
// At 1/5 of the RMS deflection and above, errors were anything from 1 to 84 %: the step is too coarse to tell. Leaves
// in strong wind, whose motion is chaotic, end there at any step.
#pragma once
#include "../stages/plan.h"
#include "../stages/state.h"
#include <vector>

namespace bough {

// Over tips and samples; tips and positions as in trajectory.h.
struct TipError {
    double rms = 0, worst = 0; // [m] from the companion: what the run's error is up to
    double deflection = 0;     // [m] RMS of the run's tips from the plan's start pose
    double extent = 0; // [m] largest distance of a tip from the origin in the start pose: what rounding is a share of
    std::int64_t samples = 0; // frames that were compared
    std::size_t tips = 0;
    bool finite = true; // the companion's state; ends the comparison where it is not
    bool resolved() const { return finite && rms < 0.2 * deflection; }
};

// Reads the run's states, never writes them. Cost: half of the run's steps again, and memory for a second state.
template <class T> class ErrorEstimate {
public:
    // plan: the run's, coupled. start: its state at the beginning, at rest or resumed: the error counted is what comes
    // from there on. Keeps a reference to the tree.
    ErrorEstimate(const Tree&, const Plan<T>& plan, const State<T>& start);

    // To be called after each frame of the run. Takes the companion's steps up to there, and compares where both have a
    // state: after an even number of steps. A run that begins after an odd one is joined at its first frame after an
    // even one. Allocates nothing.
    void follow(const State<T>& run);

    TipError result() const;

private:
    void begin(const State<T>& run);
    void compare(const State<T>& run);

    const Tree& tree_;
    Plan<T> plan_;
    State<T> state_;
    std::vector<std::size_t> tips_;
    std::vector<Vec3> start_tips_; // [m]
    bool begun_ = false;
    double squares_ = 0, worst_ = 0, deflection_squares_ = 0; // [m^2]
    TipError found_;
};

} // namespace bough
