// stability_motion.h: whether a cell of the grid of extremes (stability.h) moves as the truth does: bounded is not right, a tree
// that stands still in a storm is bounded too.
//
// Compared: the cases of a wind on the user's tree (StabilityCase::compared), coupled; not the forest, whose trees are
// poles of ten bodies, nor K x 1e-3 and steps of 1/10 s, where one step a frame is not true, only bounded. The truth is the coupled solver at 64
// steps a frame, in double, which takes as long for any tree and any wind, and is within some percent of articulated_reference
// where that can be had (lib/study/README.md). It moves rightly where
//   lean, spread   of the trunk's top (motion_statistics.h) are within 25 % of the truth's, or within 1e-4 of the tree's height;
//   still          in a wind that changes, and of which the truth has no still frame, no frame is still.
#pragma once
#include "motion_statistics.h"
#include "stability_cases.h"
#include "stability_cell.h"
#include <functional>
#include <optional>
#include <string>

namespace bough {

struct MotionTruth {
    MotionSummary motion;
    double height = 0;     // [m] of the drawn tree
    bool unsteady = false; // the wind changes
};

// `frames` steps of the setup's length. None where the scene has no wind, the tree no trunk, or the truth is non-finite. tick
// once a step; may throw.
std::optional<MotionTruth> motion_truth(const StabilitySetup&, std::int64_t frames, const std::function<void()>& tick);

// Enters lean_error, spread_error and still, and whether the cell moves rightly; returns what does not, empty if all does.
std::string judge_motion(const MotionSummary&, const MotionTruth&, StabilityCell&);

} // namespace bough
