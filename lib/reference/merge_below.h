// merge_below.h: joints that hardly move become rigid, found by a trial run: a tree's level of detail fitted to an error.
//
// The whole tree runs through the scene (coupled, P12, double). By each joint's largest angle from where it starts, which is where it would be
// held, times its composite's reach (added_motion.h), joints are held from the ends inward up to a sum on each way to the ground (hold.h). What
// that makes of the motion is not estimated but run: the reduced tree through the same scene, its branches' tips compared with the whole
// tree's in each frame (rigid_error.h). The sum starts at the error asked for, is doubled while the tips stay within it and halved while they do not, and then
// bisected (in its logarithm); a run ends at the first tip that is off by more. The best that stayed within it is kept: its error is one that a
// whole run has had. Another wind, or a longer one, may have another.
// Cost: the whole run, and up to `runs` of reduced trees; 12 bytes a tip and frame.
#pragma once
#include "../fast/targets.h"
#include "rigid_error.h"
#include <functional>
#include <optional>

namespace bough {

struct MergeBelow {
    double error = 0.01; // [m] that no tip may be off by, > 0
    Scene scene;         // without simulate
    double seconds = 10, fps = 30;
    int runs = 10; // at most, of reduced trees
    std::optional<fast::Target> simd = std::nullopt;
    std::function<void(std::int64_t frame, std::int64_t frames)> tick = {}; // of all runs, at most; may throw to end
};

struct MergedBelow {
    std::size_t joints = 0, moving = 0;
    int runs = 0;     // of reduced trees
    RigidError found; // of the best run; frames 0 where nothing could be merged
};

// Sets Tree::rigid; leaves it empty where no joint may be held. Throws what make_plan throws, std::domain_error where the whole run becomes non-finite.
MergedBelow merge_below(Tree&, const std::vector<TreeRange>&, const MergeBelow&);

} // namespace bough
