// added_motion.h: how far each joint's turning moves the ends of a tree: what holding the joint would lose.
//
// A joint that turns by an angle moves what it carries by at most that angle times the reach of its composite: the farthest end along the tree, a
// fruit's radius included.
//
// The estimate takes no run. The joint's angle is twice the moment about it of the peak load on all it carries, in the drawn pose, over its K, for
// the axis where that is largest. The factor is 2 because what is loaded at once swings to twice the angle at which it comes to rest. The peak load
// is the wind at its highest:
//   v = s V_c gust_factor + 3 turbulence |V| V_c / |V_c|,   times the profile at the body's height,
// V_c is the cell's mean velocity (V without a grid); s is 2 where the cell has octaves, else 1. With a swirl the largest load of its mean direction
// and its two extreme ones counts. Plates, which will turn into the wind, are taken broadside. Pulls act at the largest of their keys, in any phase
// with the wind. With Pose::rest gravity acts too; with Pose::settled its moment counts once, as the sag that the drawn pose lacks. What is attached
// pushes back with a force that is not known beforehand: joints between it and the ground have an infinite estimate, so that none of them is held.
// What swings when it pulls hard or lets go is not estimated. Two things are left out: shelter, and that a joint which rings in the gusts' own rhythm
// can turn by more.
// How well the estimate holds (hold.h): a bare cherry of 19 642 bodies was held to 1 cm over 10 s of calm, breeze and gusty. Its tips were off by
// 1.5, 2.0 and 4.1 mm RMS, and by 16, 32 and 149 mm at most, at ends that whip. An estimate from a trial run (study/merge_below.h) holds in that run.
// Reads a checked tree (joined, stiffness not yet scaled by the scene). O(n), and O(depth) a pull. Errors none.
#pragma once
#include "../model/scene.h"
#include "../model/tree.h"
#include <string>
#include <vector>

namespace bough {

// [m] Returns the reach of each joint's composite.
std::vector<double> composite_reach(const Tree&);

// Returns why there is no estimate for this scene, or "". The estimate needs something that moves the tree. It knows nothing of attachments whose
// targets move, of pulls that turn with their bodies, or of root motion.
std::string no_estimate(const Scene&);

// [m] Returns the estimate of each joint; infinite where K is 0 under a load, and between what is attached and the ground. Throws std::out_of_range
// as select() does.
std::vector<double> added_motion(const Tree&, const std::vector<TreeRange>&, const Scene&);

} // namespace bough
