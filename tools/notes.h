// notes.h: what treesim says of a run: its plan, what acted in it, what it cost.
#pragma once
#include "simulation.h"

namespace bough {

// What the picture may suffer from in so many steps, and what to change; what broke, landed and hit.
void note_run(const RunAccount&, const Scene&, std::int64_t steps, std::vector<std::string>& notes);

// --report guards: how often each acted in so many steps.
std::string guards_lines(const RunAccount&, std::int64_t steps);

// --report cost. ms: of all frames.
std::string cost_line(const RunAccount&, const RunOptions&, double ms, std::int64_t frames);

} // namespace bough
