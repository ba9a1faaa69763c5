// loop.h: treesim --loop: one period of a motion that repeats (lib/simulation/loop.h), as frames.
#pragma once
#include "common.h"
#include "frame_sink.h"
#include "lib/simulation/loop.h"
#include "option_list.h"
#include "simulation.h"

namespace bough {

struct LoopChoice {
    std::optional<double> seconds;       // --loop
    std::optional<double> tolerance;     // [1] of the height
    std::optional<std::int64_t> periods; // at most, before the one that is written
    bool blend = false;
};
void add_loop_options(OptionList&, LoopChoice&);

// Throws UsageError where --loop, or what only goes with it, does not go with the options of the run.
void refuse_contradictions(const LoopChoice&, const RunOptions&);

// Frames of the loop. Throws UsageError where its length is not that of whole frames, with the nearest that is.
std::int64_t loop_frames(const LoopChoice&, const RunOptions&);

// Gives the scene's wind the loop's period. Throws UsageError for a scene that cannot repeat.
void make_periodic(const LoopChoice&, Scene&);

// Leaves the run at the loop's first frame. Throws PromiseError where it does not close, but with --loop-blend; Interrupted.
LoopStart close_loop(Simulation&, const LoopChoice&, const RunOptions&, const CommonOptions&);

// A sink for the loop's frames, in front of the given one. `again`: writes the first once more behind the last, for a player that goes
// on from there. Takes what of the start it needs.
std::unique_ptr<FrameSink> loop_sink(std::unique_ptr<FrameSink>, bool again, LoopStart&, const LoopChoice&,
                                     const RunOptions&);

// From the loop's last frame to the next period's first: a note of how far it is from the loop's first. Throws PromiseError where that is
// more than the tolerance.
void measure_seam(Simulation&, const LoopStart&, const LoopChoice&, const RunOptions&, std::vector<std::string>& notes);

} // namespace bough
