// notes.h: what treesim says of a run: its plan, what acted in it, what it cost.
#pragma once
#include "simulation.h"

namespace bough {

// Guards that acted in the steps since `started`, and what was left out or kept; what broke, landed and hit.
void note_run(const RunAccount&, std::int64_t started, std::vector<std::string>& notes);

// --report-cost. ms: of all frames.
std::string cost_line(const RunAccount&, const RunOptions&, double ms, std::int64_t frames);

} // namespace bough
