// settling.h: how long a tree in the wind remembers how it began.
//
// The wind strikes a run that starts at rest at time 0. What this sets off dies away as the slowest sway does. The sway's frequency and damping come
// from one shape by Rayleigh's quotient: the bend u that a slight tilt of gravity toward the wind gives the standing tree (sag.h):
//   omega^2 = a sum m u.e / sum m |u|^2,   a e the tilt's acceleration
//   omega zeta = (sum_joints beta theta^T K theta + sum_bodies u^T D u) / (2 sum m |u|^2)
// theta is how the joints bend, D minus the derivative of the air's forces (air.h) in the mean wind of the body's height. Single leaves have their
// mean over their own motion (streaming of air.h). u dies away as e^(-omega zeta t), or beyond critical damping as its slower root. The start is
// taken as forgotten when u is down to a hundredth. Sway in other shapes takes longer. Measured: the tips of a run from rest beside those of a run
// that had gone for a minute, RMS of the difference over the sway's, trees of 1 500 bodies in gusty wind: bare maple 0.05, oak and pine below 0.1,
// willow 0.15; in leaf all below 0.05.
#pragma once
#include "../model/scene.h"
#include "../model/tree.h"
#include <vector>

namespace bough {

// A tree's first sway.
struct FirstSway {
    double omega = 0; // [rad/s] undamped
    double zeta = 0;  // [1] damping ratio, the wind's share included
};

// [s] Bounds. most: for a tree that sways for longer, has no damping, or gives way to the tilt. least: for a stiff tree, whose leaves still swing.
constexpr double most_settling = 20, least_settling = 2;

// Returns the first sway of a tree on its own: of the bodies of `range`, all roots among them together. Stiffness and damping must be scaled by the
// scene's factors. omega 0: no such sway was found. O(bodies).
FirstSway first_sway(const Tree&, const TreeRange& range, const Scene&);

// [s] Returns the time until the start is forgotten, the longest of the trees', within the bounds above; 0 where no wind blows. /wood and /load must
// be in the tree by now. O(bodies).
double settling_time(const Tree&, const std::vector<TreeRange>&, const Scene&);

} // namespace bough
