// saved_tree.h: `treesim --save-tree`: the run's tree as a document, drawn as it stands at the last frame (lib/plan/posed_tree.h).
#pragma once
#include "common.h"
#include "simulation.h"

namespace bough {

// Whether a run can have its tree saved at all. Throws UsageError: for a scene of several trees.
void require_one_tree(const Setting&);

// Throws OutputError where joints broke: what is left is no tree document, and where the file cannot be written.
template <class T> void save_tree(const std::string& file, const Setting&, Run<T>&, const CommonOptions&);

} // namespace bough
