// trajectory_difference.h: how far two runs' points are apart, and how far a run's have moved: of the tips, and of the wood's
// ends by branch level.
#pragma once
#include "trajectory.h"
#include <cmath>

namespace bough {

// [m] Over points and frames after the start: RMS, and the largest.
struct Distance {
    double rms = NAN, most = NAN;
};

using Points = std::vector<std::vector<Vec3>>; // samples x points

// Over the frames that both have. Points are compared one by one; `of` chooses some, none: all.
Distance distance(const Points& a, std::int64_t stride_a, const Points& b, std::int64_t stride_b,
                  const std::vector<std::size_t>* of = nullptr);
// Of the tips; NAN where either run is not finite.
Distance distance(const Trajectory& a, const Trajectory& b);
// From the first sample.
Distance deflection(const Points&, const std::vector<std::size_t>* of = nullptr);
// [rad] RMS of the joints' angles; NAN where the run is not finite. The truth has every frame.
double angle_distance(const Trajectory& run, const Trajectory& truth);

// Which of Trajectory::wood are of a level; `to_one`: of levels 0 and 1, trunk and limbs, which are what shape a tree has.
struct WoodLevels {
    std::vector<std::vector<std::size_t>> level;
    std::vector<std::size_t> to_one;
};
WoodLevels wood_levels(const Tree&);

} // namespace bough
