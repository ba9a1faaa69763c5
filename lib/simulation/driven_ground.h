// driven_ground.h: a tree's ground that is moved from step to step (Simulation::set_ground), as the curve of root_motion.h that solvers read.
//
// The curve has two keys, where the ground is now and where it is to be, and a key behind them that gives the second its velocity. The caller gives
// places and velocities at both. The acceleration at the second is that of the cubic through them, which is off by O(h^2) where the motion is smooth;
// at the first it is that of the curve before. So motion that the steps do not resolve shows within them (ground_course.h), and motion that they
// resolve follows root_motion to O(h^4).
#pragma once
#include "../model/root_motion.h"
#include "run_types.h"

namespace bough {

// Makes all of a scene's trees (`trees` of them) moved ones: those without keys of their own get keys that keep them where they are.
void move_all_trees(Scene&, std::size_t trees);

// A caller's motion is of the tree's place, which the spline turns about; a Ground's is of the world's origin, carried along. Both ways, O(1).
Ground ground_of(const RootSpline&, const GroundMotion&);
GroundMotion motion_of(const RootSpline&, const Ground&);

// These functions read and give pose and velocities of a Ground. make_driven makes a curve that the others change without allocating.
void make_driven(RootSpline&); // at rest where the tree was drawn
// Puts the ground there at time `now` [s].
void put_ground(RootSpline&, double now, const Ground&);
// Leads the ground from where it is at `now` to `to`, `seconds` later.
void lead_ground(RootSpline&, double now, double seconds, const Ground& to);
// Moves the ground on for `seconds` at its present velocity and turning, where no call asks for more.
void keep_going(RootSpline&, double now, double seconds);

} // namespace bough
