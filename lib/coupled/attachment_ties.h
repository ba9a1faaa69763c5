// attachment_ties.h: what the coupled step's sweeps cannot eliminate, and what is solved for between them. These are attachments between two bodies,
// of one tree or of two (a hammock, a cable, branches that are tied), and pulls that turn with their body (Pull::in_body).
//
// A pair closes a loop. F is the force that holds its near point back and pulls its far point on, b the acceleration of the near point as seen from
// the far one, and b_0 the same without ties:
//   F = zeta b + F_0,   zeta = k/s^2 + c/s,   b = b_0 - W F
// (F_0 as in attachment.h, for the way from the far point to the near one). The stiffer the spring, the more b depends on F through W alone. So the
// unknown is y, with
//   F = sigma y,   sigma^2 = zeta:   (1 + sigma W sigma) y = sigma b_0 + F_0 / sigma
// This system is symmetric. Where zeta is beyond all else it is as well conditioned as W, whatever other pairs are like. A pull that turns
// (pulled_points.h) has a stiffness that is not symmetric. Its unknown is y = alpha of the body, psi = alpha/s^2 + omega_0/s. Both are implicit like
// all else, so no stiffness and no loop asks for smaller steps.
// The largest zeta is that of attachment.h. No zeta of a pair stands in the sweeps, but its H does, which is as large as zeta times the way by which
// the points are off. (With the largest zeta of double, twigs that are drawn to three times their reach were lost in float within ten steps.)
// W and b_0 come from the paths alone, between the inward and the outward sweep, by what these keep of each joint (n, f a wrench about it):
//   inward   E u -= E n,   n' = n - (E A)^T n,   f' = f - (E B)^T n,   to the next joint n' + r x f', f'
//   outward  a' = a_p + alpha_p x r,   alpha = alpha_p + E u - E A alpha_p - E B a'
// Then the bodies of the paths get their part of the forces, and the sweep outward goes on. Cost: O(3 ties x paths) + O((3 ties)^3) a pole, in
// double. A step allocates nothing. Errors none.
#pragma once
#include "coupled_state.h"

namespace bough {

// Makes room for the ties of a.all and a.pulled, and for their paths. Allocates.
void find_ties(Attachments&);

// Solves at pole p. Needs `solved` of the bodies as the sweep inward has left it, and their places at y*. Fills in SolvedBody::moment and gain.
template <class T> void solve_ties(const Plan<T>&, CoupledState<T>&, std::complex<double> p);

} // namespace bough
