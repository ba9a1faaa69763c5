// explain.h: a plan's account of itself: which stages run, which arrays are held, and why, in the order of the step. What it says is what
// `treesim --explain` prints; the tests hold it against what really happens (state_arrays.h, StageClock).
#pragma once
#include "plan.h"

namespace bough {

// Fills stages and arrays of a plan whose other fields are final. wishes: what make_plan was given.
template <class T> void explain(Plan<T>&, const Wishes&);

} // namespace bough
