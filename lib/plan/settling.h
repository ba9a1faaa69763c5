// settling.h: how long a tree in the wind remembers how it began.
//
// A run that starts at rest is struck by the wind at time 0, and what that sets off dies away as the slowest sway does. Its frequency and damping
// are read off one shape, the bend u that a slight tilt of gravity toward the wind gives the standing tree (sag.h), by Rayleigh's quotient:
//   omega^2 = a sum m u.e / sum m |u|^2,   a e the tilt's acceleration
//   omega zeta = (sum_joints beta theta^T K theta + sum_bodies u^T D u) / (2 sum m |u|^2)
// theta how the joints bend, D minus the derivative of the air's forces (air.h) in the mean wind of the body's height. u dies away as
// e^(-omega zeta t), or where that is damped beyond critically as its slower root. To a hundredth it is taken as
// forgotten. What sways otherwise than in that shape takes longer; measured, tips of a run from rest beside those of one that had run for a minute, RMS of the
// difference over the sway's, trees of 1 500 bodies in gusty wind: bare maple 0.05, oak, pine below 0.1, willow 0.15; in leaf all below 0.05.
#pragma once
#include "../model/scene.h"
#include "../model/tree.h"
#include <vector>

namespace bough {

// What the first sway of a tree is.
struct FirstSway {
    double omega = 0; // [rad/s] undamped
    double zeta = 0;  // [1] damping ratio, the wind's share included
};

// [s] most: a tree that sways for longer, has no damping, or gives way to the tilt; least: a stiff one, whose leaves still swing.
constexpr double most_settling = 20, least_settling = 2;

// Of a tree on its own; stiffness and damping are scaled by the scene's factors. The bodies of `range`, all roots among them together. O(bodies).
// omega 0: no such sway was found.
FirstSway first_sway(const Tree&, const TreeRange& range, const Scene&);

// [s] The time until the start is forgotten, the longest of the trees', within the bounds above; 0 where no wind blows. /wood and /load are in the tree by
// now. O(bodies).
double settling_time(const Tree&, const std::vector<TreeRange>&, const Scene&);

} // namespace bough
