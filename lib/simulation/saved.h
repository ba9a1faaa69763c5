// saved.h: a run between two steps as numbers, and back: a run that is cut in two ends as the whole one, bit by bit.
#pragma once
#include "run.h"

namespace bough {

// What the solver carries from step to step, of a run after `frame` of its frames. Fills in theta ... sleep, articulated_step and frame; the rest, which
// names the run, is the caller's. O(bodies).
template <class T> void save_run(Run<T>&, std::int64_t frame, SavedState&);

// [s] The time of a saved state, `step` steps of dt [s] after the start but where its step was changed.
double saved_time(const SavedState&, std::int64_t step, double dt);

// Makes a run that was just started go on from there; step: the steps that the saved one had taken. Throws SceneError, with the place in the
// document, where the arrays do not fit the run. O(bodies).
template <class T> void restore_run(const SavedState&, std::int64_t step, Run<T>&);

} // namespace bough
