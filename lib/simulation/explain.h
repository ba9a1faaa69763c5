// explain.h: a plan's account of itself: which stages run, which arrays are held, and why, in the order of the step. `treesim --report plan` prints
// it. The tests hold it against what really happens (StageClock, the states' arrays).
#pragma once
#include "../plan/plan.h"

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
    std::vector<PlannedStage> stages; // all, in the order in which they run
    std::vector<PlannedArray> arrays; // of the state; also those that another solver would have
};

template <class T> PlanAccount explain(const Plan<T>&);

} // namespace bough
