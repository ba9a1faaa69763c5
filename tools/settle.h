// settle.h: treesim --settle: what is run before frame 0, so that it stands in the wind's own sway (Simulation::settle).
#pragma once
#include "treesim_options.h"

namespace bough {

// Frames that are run before frame 0: of --settle, else of settling_time() where a wind blows. None by default where what comes first is what is
// asked for (pose rest: the fall; /fracture: what the wind breaks, which it would have broken by then), or is not the start (--resume, --loop).
std::int64_t frames_before(const TreesimOptions&, const Setting&);

// Those of a run at its start. Throws PromiseError, Interrupted.
void settle(Simulation&, std::int64_t frames, const TreesimOptions&);

// How many they were, as a note; "" for none.
std::string settled_note(std::int64_t frames, const TreesimOptions&);

} // namespace bough
