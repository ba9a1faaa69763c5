// explain.h: a plan's account of itself: which stages run, which arrays are held, and why, in the order of the step. `treesim --report plan` prints
// it. The tests hold it against what really happens (StageClock, the states' arrays).
#pragma once
#include "plan.h"
#include <string>
#include <utility>

namespace bough {

struct PlannedStage {
    Stage stage;
    bool on;
    std::string reason; // the part of the scene that asks for it, or that lacks it
};

struct PlannedArray {
    std::string name;
    bool on;
    std::size_t bytes; // as allocated, or as it would be
    std::string reason;
};

struct PlanAccount {
    std::vector<PlannedStage> stages = std::vector<PlannedStage>(stage_count); // all, in the order in which they run
    std::vector<PlannedArray> arrays; // of the state: what this way of making steps holds in some scene

    void stage(Stage stage, bool on, std::string reason) {
        stages[std::size_t(stage)] = {stage, on, std::move(reason)};
    }
    void array(std::string name, std::size_t bytes, bool on, std::string reason) {
        arrays.push_back({std::move(name), on, bytes, std::move(reason)});
    }
};

// What the stepper says nothing of is left out for its solver's sake. It says its own last: what poses need stands by then.
template <class T> PlanAccount explain(const Plan<T>&);

// These are reasons, for Stepper::explain().
// Why poses, and what goes with them, are kept or not.
template <class T> const char* pose_reason(const Plan<T>&);
// "/wind; /wind/grid, 9 cells", or "no wind".
template <class T> std::string wind_reason(const Plan<T>&);
// What of the wind varies from place to place and from tree to tree: "; /wind/grid, 9 cells", or "".
template <class T> std::string wind_parts(const Plan<T>&);
// What loads the bodies: "/wind, /pulls", or that none does.
template <class T> std::string forces_reason(const Plan<T>&);
// "; roots moved by /root_motion", or "".
template <class T> std::string moved_roots(const Plan<T>&);
// "; angles kept within /joint_limit", or "".
template <class T> std::string limited_angles(const Plan<T>&);
// Are forces to come from the caller alone?
template <class T> bool callers_forces(const Plan<T>&);

} // namespace bough
