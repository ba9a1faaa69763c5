// rustling.h: the rustle of a run's clumps: its wind, where they stand.
#pragma once
#include "frame_sink.h"
#include "setting.h"

namespace bough {

// For the sinks of meshes. Keeps references to the setting and the tree that is shown, whose first bodies are the setting's.
RustleMaker rustle_maker(const Setting&, const Tree& shown, double fps);

} // namespace bough
