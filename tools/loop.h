// loop.h: treesim --loop: one period of a motion that repeats.
//
// The wind is made to repeat after the loop's length (Wind::period), and whole periods are run until the motion repeats as well: a
// damped tree forgets how it began. Two periods are held beside each other at five times, the seam and the frame after it among
// them: where the far ends of all that carries nothing (tips, leaves, fruit) are, in all of them, within the tolerance of where they
// were a period before, so are places and velocities at the seam. Then one period is written, and one frame more is made, which is
// what the first would be a period later: how far its ends are off is the loop's seam, and noted.
//
// What never repeats by itself, as leaves that turn over in the wind, can be made to (--loop-blend): over the loop's last third each joint's
// rotation in its parent's body passes from what it is, q(t), to what it was a period before, q(t - T), which runs into the loop's first frame:
//   q'(t) = slerp(q(t), q(t - T), w),   w = x^2 (3 - 2 x),   x from 0 to 1 over that third
// so that poses and velocities are continuous, also from the last frame to the first; each body's pose follows from its parent's. It takes a second
// copy of the run, which is made again from where the third began a period before.
#pragma once
#include "common.h"
#include "frame_sink.h"
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

// Gives the wind the period of so many frames. Throws UsageError for a scene without wind, with one of another period, or with something whose
// times do not repeat.
void make_periodic(std::int64_t frames, double fps, Scene&);

// The ends as they are at the loop's first frame.
struct LoopStart {
    std::int64_t periods = 0; // that were run before
    bool closed = false;      // within the tolerance; always but for --loop-blend
    double height = 0;        // [m] of the tree: the farthest end's distance from its root
    std::vector<Vec3> end;    // [m] far ends of branches' tips, then of leaves, petals and fruit
    std::size_t tips = 0;     // how many of them are branches'
};

// Leaves the run at the loop's first frame; with --loop-blend `before` is the run where the blending begins, a period before. Throws
// PromiseError where it does not close, Interrupted.
template <class T>
LoopStart close_loop(Run<T>&, const Tree&, const LoopChoice&, const RunOptions&, const CommonOptions&,
                     std::optional<Run<T>>& before);

// A sink for the loop's frames, in front of the given one. `again`: writes the first once more behind the last, for a player that goes
// on from there. `before`: as close_loop leaves it.
template <class T>
std::unique_ptr<FrameSink> loop_sink(std::unique_ptr<FrameSink>, bool again, std::optional<Run<T>> before, const Tree&,
                                     const LoopChoice&, const RunOptions&);

// Of so many frames, how many are blended.
constexpr std::int64_t blended_frames(std::int64_t frames) {
    return frames - 2 * frames / 3;
}

// From the loop's last frame to the next period's first: a note of how far it is from the loop's first. Throws PromiseError where that is
// more than the tolerance.
template <class T>
void measure_seam(Run<T>&, const Tree&, const LoopStart&, const LoopChoice&, const RunOptions&,
                  std::vector<std::string>& notes);

} // namespace bough
