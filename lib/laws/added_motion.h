// added_motion.h: by how much the ends of a tree move for what each of its joints turns: what holding the joint would lose.
//
// A joint that turns by an angle moves what it carries by at most that angle times the reach of its composite: the farthest end along the tree,
// radius of a fruit included.
//
// Estimate, without a run: the joint's angle is twice the moment about it of the peak load on all it carries, in the drawn pose, over its K, of the
// axis of which that is largest: twice, as what is loaded at once swings to twice where it comes to rest. The peak load: the wind at its highest,
//   v = s V_c gust_factor + 3 turbulence |V| V_c / |V_c|,   times the profile at the body's height,
// V_c the cell's mean velocity (without a grid V), s 2 where the cell has octaves, else 1; with a swirl the largest of its mean
// direction and its two extreme ones; on plates, which will turn into it, broadside. Pulls at the largest of their keys, in any phase
// with the wind. With Pose::rest gravity too, with Pose::settled its moment once: the sag that the drawn pose has not. Shelter is left out, and that
// a joint which rings in the gusts' own rhythm can turn by more.
// How it keeps what it says (hold.h): a bare cherry of 19 642 bodies held to 1 cm, 10 s of calm, breeze and gusty: tips off by 1.5, 2.0 and 4.1 mm RMS,
// by 16, 32 and 149 mm at most, at ends that whip. What a trial run found (study/merge_below.h) it keeps in that run.
// Reads a checked tree (joined, stiffness not yet scaled by the scene). O(n) and O(depth) a pull. Errors none.
#pragma once
#include "../model/drawn_pose.h"
#include "../model/scene.h"
#include "../model/tree.h"
#include <string>
#include <vector>

namespace bough {

// [m] of each joint's composite.
std::vector<double> composite_reach(const Tree&);

// Why there is no estimate for this scene, or empty: it needs something that moves the tree, and knows nothing of root motion.
std::string no_estimate(const Scene&);

// [m] Of each joint. Infinite where K is 0 under a load. Throws std::out_of_range as select() does.
std::vector<double> added_motion(const Tree&, const std::vector<TreeRange>&, const Scene&);

} // namespace bough
