// saved_run.h: a run between two frames as a state document, and back (--save-state, --resume).
#pragma once
#include "treesim_options.h"

namespace bough {

// Makes a run that was just started go on where the saved one stopped. Throws InputError where the state is of another run.
template <class T> void restore(const TreesimOptions&, const Setting&, const SavedState&, Run<T>&);

// Writes the run's state after `frame` to --save-state. Throws OutputError.
template <class T> void save(const TreesimOptions&, const Setting&, Run<T>&, std::int64_t frame);

} // namespace bough
