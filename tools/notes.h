// notes.h: what treesim says of a run: its plan, what acted in it, what it cost.
#pragma once
#include "simulation.h"

namespace bough {

// Guards that acted in so many steps, and what was left out or kept.
template <class T>
void note_flags(const Plan<T>&, const StepFlags&, std::int64_t steps, std::vector<std::string>& notes);
// What broke, landed and hit.
template <class T> void note_world(const World<T>&, std::vector<std::string>& notes);

// --report-cost. ms: of all frames.
template <class T> std::string cost_line(const Plan<T>&, const RunOptions&, double ms, std::int64_t frames);

} // namespace bough
