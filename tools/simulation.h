// simulation.h: what treesim and treeprofile share: one run as frames, its errors as the tool's.
#pragma once
#include "formats/documents/motion.h"
#include "lib/bough.h"
#include "setting.h"

namespace bough {

double step_length(const RunOptions&); // [s]

// What is read of a run: the arrays of its frames, its bodies' poses, its trees once it has begun; its state, to go on from.
struct RunWishes {
    MotionFields fields = no_fields;
    bool poses = false, trees = false, state = false;
};
// At its start. The setting stays the caller's and the run's; without wishes for trees its tree is the plan's. Throws InputError for what the
// library refuses.
Simulation started(const std::shared_ptr<Setting>&, const RunOptions&, int threads, const RunWishes&);

// Takes the steps of one frame. A run that became non-finite throws PromiseError with frame, stage and body.
void advance_frame(Simulation&, std::int64_t frame, int substeps);
// Throws that PromiseError where it has.
void require_finite(Simulation&, std::int64_t frame);

// The frame's number, time and arrays, as far as `fields` asks for them. Throws PromiseError where a pose is non-finite.
void fill_frame(Simulation&, std::int64_t frame, double fps, const MotionFields& fields, MotionFrame&);

} // namespace bough
