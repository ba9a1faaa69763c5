// breaking.h: breaks joints whose spring's torque after the step is above their threshold (fracture.h). What they carried becomes free bodies.
#pragma once
#include "world.h"

namespace bough {

// contacts: of the same step. Takes what broke off out of plan, state and remaining tree. New pieces are the last of World::free. O(breakable
// joints); where something broke O(what broke off and its path to the root).
template <class T> void break_joints(Plan<T>&, State<T>&, World<T>&, const std::vector<ContactPoint>& contacts);

} // namespace bough
