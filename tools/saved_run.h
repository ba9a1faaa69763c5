// saved_run.h: a run between two frames as documents: its state, to go on from (--save-state, --resume), and its tree, drawn as it stands
// (--save-tree, lib/plan/posed_tree.h).
#pragma once
#include "treesim_options.h"

namespace bough {

// Makes a run that was just started go on where the saved one stopped. Throws InputError where the state is of another run.
void restore(const TreesimOptions&, const SavedState&, Simulation&);

// Writes the run's state after `frame` to --save-state, its tree to --save-tree, where these are given. Throws OutputError, for a tree of which
// joints broke too: what is left is no tree document.
void save(const TreesimOptions&, const Simulation&, std::int64_t frame);

// Whether a run can have its tree saved at all. Throws UsageError: for a scene of several trees, and where joints are held.
void require_one_tree(const Setting&);

} // namespace bough
