// pulled_points.h: pulls in the coupled step, whose points go with their bodies: how this changes their moments, and pulls that turn with their
// bodies (Pull::in_body: a jet, a thread that the body winds up).
//
// As bodies turn, the arm of a force f on a point turns. Its moments change by the Hessian of -f.x, which is block diagonal in the bodies' absolute
// rotations like gravity's (body_load.h). P goes from a body's joint to the point, or to the next joint on the way there, and f is all that acts
// there:
//   H = (1 - w) ((P.f) 1 - sym(P f^T)) + w |P| |f| (1 - (1 - n^2/2) p p^T),   p = P / |P|,  n = |p x f| / |f|
// attachment.h derives the second part, which bounds the first whichever way f points. The first part is the true Hessian, and negative where f
// presses. But the sweep inward has to stay positive. So w is the square of the sum over a tree of |P| |f| g, at most 1. g is how far springs and
// inertias of the joints between there and the ground give in a step [rad/(N m)]. Where that sum is below 1, they outweigh the first part; a rod that
// is pressed at its tip buckles at 1.2 of it. As any L does, H leaves fixed points and the second order as they are.
// (A twig of 0.8 mm, 0.36 m, E 5 GPa, pulled aside by 1 N at 1/30 s: without H its joints' rates are 3500 rad/s in the eighth second, with it 2e-14.
// Branches of grown trees, pressed along themselves by up to 500 N, 125 cases: at 1/30 s up to 0.46 m/s in the twelfth second, at 1/240 s up to 0.49.
// It was 15 m/s at 1/30 s with 1 - p p^T alone, which leaves out that f couples turns about P with turns across it.)
//
// A force that turns with its body by psi becomes, by the chart of the joints' turns,
//   f + psi x f,   rho x f + psi x (rho x f) / 2        (the springs' own moments turn by as much the other way)
// This comes from no potential: its stiffness is not symmetric, and its part of the solve is a tie (attachment_ties.h). Its own body has no H
// besides. Reads AttachedBody's places at y*. Adds to sums. In double. Errors none.
#pragma once
#include "coupled_state.h"

namespace bough {

// Takes the caller's forces among the pulls, before place_attachments. (State::loads, where nothing else brings some: contacts and walkers push for a
// moment.) Returns true if they act on other bodies than before.
template <class T> bool take_loads(const Plan<T>&, const State<T>&, Attachments&);

// Finds the force of the step from `time`. For a pull that turns it finds all that the pull adds, except what its body's turning makes of it.
// (body_load.h has the others'.) Needs AttachedEnd::rho. O(1).
template <class T> void place_pull(const Plan<T>&, Attachments&, PulledPoint&, double time);

// Adds H of all pulls. O(bodies on their paths).
template <class T> void add_directions(const Plan<T>&, Attachments&);

} // namespace bough
