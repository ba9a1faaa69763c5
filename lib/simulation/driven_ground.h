// driven_ground.h: a tree's ground that is moved from step to step (Simulation::set_ground), as the curve of root_motion.h that solvers read.
//
// The curve has two keys, where the ground is now and where it is to be, and one behind them that gives the second its velocity. Places and velocities at both
// are what is asked for; the acceleration at the second is that of the cubic through them, which is off by O(h^2) where the motion is smooth, at the first
// that of the curve before. So what the steps do not resolve shows in them (ground_course.h), and what they do moves as root_motion does, to O(h^4).
#pragma once
#include "../model/root_motion.h"

namespace bough {

// A scene whose trees, `trees` of them, are all moved: those without keys of their own get some that keep them where they are.
void move_all_trees(Scene&, std::size_t trees);

// Of a Ground they read and give pose and velocities. The first makes a curve that the others change without allocating.
void make_driven(RootSpline&); // at rest where the tree was drawn
// There at time `now` [s].
void put_ground(RootSpline&, double now, const Ground&);
// From where it is at `now` there, `seconds` later.
void lead_ground(RootSpline&, double now, double seconds, const Ground& to);
// Where nothing was asked for that is still to come: on from where it is for `seconds`, at the velocity and turning that it has.
void keep_going(RootSpline&, double now, double seconds);

} // namespace bough
