// allocate_coupled.h: what a state of the coupled solver holds, whichever way its steps go.
#pragma once
#include "coupled_state.h"

namespace bough {

// Room for what the plan's steps need, attachments as they begin (attachment.h) among it; roots: of the trees. O(n). Allocates.
template <class T> void allocate_coupled(const Plan<T>&, State<T>&, CoupledState<T>& own, std::size_t roots);

} // namespace bough
