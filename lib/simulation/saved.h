// saved.h: a run between two steps as numbers, and back. A run that is cut in two ends as the whole one, bit by bit.
#pragma once
#include "run.h"

namespace bough {

// Saves what the solver carries from step to step, after `frame` of the run's frames. Fills in theta ... sleep, articulated_step and frame; the
// caller fills in the rest, which names the run. O(bodies).
template <class T> void save_run(Run<T>&, std::int64_t frame, SavedState&);

// [s] Returns the time of a saved state: `step` steps of dt [s] after the start, unless its step was changed.
double saved_time(const SavedState&, std::int64_t step, double dt);

// Makes a run that was just started go on from there. step: how many steps the saved run had taken. Throws SceneError, with the place in the
// document, where the arrays do not fit the run. O(bodies).
template <class T> void restore_run(const SavedState&, std::int64_t step, Run<T>&);

} // namespace bough
