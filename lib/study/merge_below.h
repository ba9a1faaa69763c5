// merge_below.h: joints that hardly move become rigid, found by a trial run: a tree's level of detail fitted to an error.
//
// The whole tree runs through the scene (coupled, P12, double). By each joint's largest angle from where it starts, which is where it would be
// held, times its composite's reach (added_motion.h), joints are held from the ends inward up to a sum on each way to the ground (hold.h). What
// that makes of the motion is not estimated but run: the reduced tree through the same scene, its branches' tips compared with the whole
// tree's in each frame (rigid_error.h). Where tips are off by more than the error, what the joints on their ways to the ground move by counts for
// more from then on (twice as many times as the tip is off by errors), so that some of them go free; where none is, the sum grows. The most joints
// held in a run that stayed within the error are kept: that error is one that a whole run has had. Another wind, or a longer one, may have another;
// and a motion that is chaotic, as that of a tree in leaf in strong wind, is another one whatever is held: then nothing can be.
// Cost: the whole run, and up to `runs` of reduced trees; 12 bytes a tip and frame.
#pragma once
#include "../lanes/target.h"
#include "rigid_error.h"
#include <functional>
#include <optional>

namespace bough {

struct MergeBelow {
    double error = 0.01; // [m] that no tip may be off by, > 0
    Scene scene;         // without simulate
    double seconds = 10, fps = 30;
    int runs = 16; // at most, of reduced trees
    std::optional<fast::Target> simd = std::nullopt;
    std::function<void(std::int64_t frame, std::int64_t frames)> tick = {}; // of all runs, at most; may throw to end
};

struct MergedBelow {
    std::size_t joints = 0, moving = 0;
    int runs = 0;     // of reduced trees
    RigidError found; // of the best run; frames 0 where nothing could be merged
};

// Sets Tree::rigid; leaves it empty where no joint may be held. Throws what make_plan throws, std::domain_error where the whole run becomes
// non-finite.
MergedBelow merge_below(Tree&, const std::vector<TreeRange>&, const MergeBelow&);

} // namespace bough
