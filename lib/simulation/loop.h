// loop.h: one period of a motion that repeats.
//
// The wind is made to repeat after the loop's length (Wind::period). Whole periods are run until the motion repeats as well: a damped tree forgets
// how it began. Two periods are compared at five times, among them the seam and the frame after it. The far ends of all that carries nothing (tips,
// leaves, fruit) are compared. If at all five times each is within the tolerance of where it was a period before, places and velocities at the seam
// are too. One period is then shown. The frame behind it, which is the first frame a period later, tells how far its ends are off: the loop's seam.
//
// What never repeats by itself, as leaves that turn over in the wind, can be blended (blend). Over the loop's last third each joint's rotation in its
// parent's body passes from its present value q(t) to that of a period before, q(t - T), which runs into the loop's first frame:
//   q'(t) = slerp(q(t), q(t - T), w),   w = x^2 (3 - 2 x),   x from 0 to 1 over that third
// So poses and velocities are continuous, also from the last frame to the first. Each body's pose follows from its parent's. Blending takes a second
// copy of the run, which is run again from a period before the start of the last third.
#pragma once
#include "simulation.h"
#include <functional>
#include <optional>

namespace bough {

// Gives the wind this period [s], above 0. Throws SceneError for another number, and for a scene without wind, with a wind of another period, or with
// something whose times do not repeat.
void make_periodic(double seconds, Scene&);

struct LoopOptions {
    std::int64_t frames = 0;             // of a period, 2 to 1e9
    double tolerance = 1e-4;             // [1] of the height, above 0
    std::optional<std::int64_t> periods; // at most, before the one that is shown: 2, which are compared, to 1e6
    bool blend = false;
};
// LoopOptions::periods, or 20 if not given; 5 where ends are blended, since there they only let the run forget its start.
std::int64_t most_periods(const LoopOptions&);

// Takes a run to frame f, counted from its start, in steps of one frame. It may throw to end the run.
using ToFrame = std::function<void(Simulation&, std::int64_t f)>;

// How far the ends of two periods are apart [m], at most.
struct LoopGap {
    double branches = 0, others = 0;
    double largest() const { return branches > others ? branches : others; }
};

// A run at the loop's first frame.
struct LoopStart {
    std::int64_t periods = 0;         // that were run before
    bool closed = false;              // the motion repeats, within the tolerance
    LoopGap gap;                      // of the last two periods, in all that was compared
    double height = 0;                // [m] of the tree: the farthest end's distance from its root
    std::vector<std::size_t> bodies;  // whose ends are compared: branches' tips, then leaves, petals and fruit
    std::size_t tips = 0;             // how many of them are branches'
    std::vector<Vec3> end;            // [m] where they are
    std::optional<Simulation> before; // where ends are blended: the run where that begins, a period before
};

// Runs from the start to the loop's first frame. Throws SceneError for options out of their ranges, before any step, and what `to` throws.
LoopStart close_loop(Simulation&, const LoopOptions&, const ToFrame& to);

// Takes a run that is one frame behind the loop's last.
LoopGap loop_seam(Simulation&, const LoopStart&);

// How many of so many frames are blended.
constexpr std::int64_t blended_frames(std::int64_t frames) {
    return frames - 2 * frames / 3;
}

// Blends a loop's frames so that its ends meet, one after another from the first that is blended.
class LoopBlend {
public:
    // before: LoopStart's; frames: those of its loop. Throws SceneError for less than 2.
    LoopBlend(Simulation before, std::int64_t frames, ToFrame to);
    // frame: with positions and rotations, which are changed.
    void blend(MotionFrame& frame);

private:
    Simulation before_;
    std::int64_t frames_, made_ = 0;
    ToFrame to_;
};

} // namespace bough
