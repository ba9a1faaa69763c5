// explanation.h: a plan's account of itself as text: what `treesim --report plan` and Simulation::explain() print.
#pragma once
#include "../plan/plan.h"

namespace bough {

// Gives a line each for the plan, what the scene changed of the tree (changes: Assembly::changes), and every stage and array with its reason.
template <class T> std::string explanation(const Plan<T>&, const std::vector<std::string>& changes);

} // namespace bough
