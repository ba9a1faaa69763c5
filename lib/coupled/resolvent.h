// resolvent.h: the solve of the coupled step (coupled_step.h): (s^2 M + s C + K)^-1 of the whole tree at one complex
// frequency s = p / h, in O(n): an articulated-body pass (Featherstone 2008, chapter 7) with complex joint impedances.
//
// The equation is divided by s^2 and written in accelerations. For every body
//   N = A alpha + B a + N_0,  F = B^T alpha + M a + F_0,  and about every joint  N = tau - Z (joint's acceleration), with
//   A = J + H/s^2 + ([c] D [c]^T + spin I)/s,  B = m [c] + [c] D/s,  M = m 1 + D/s,   Z = (beta/s + 1/s^2) rates^T K rates
//   N_0 = N + H (omega_0 less the ground's)/s + (1/p - 1/2) slope_N,  F_0 = F + (1/p - 1/2) slope_F,   tau = torque - torque_rate/s
// Inward, E = (A + Z)^-1, u = tau - N_0:
//   A' = Z E A, B' = Z E B, M' = M - B^T E B, N' = N_0 + A E u, F' = F_0 + B^T E u, shifted by r to the parent's joint.
// (Z E A is A - A E A without its subtraction; at high stiffness that is 70 times better in float.)
// Outward: a' = a_p + alpha_p x r, gamma = E (u - A alpha_p - B a'), alpha = alpha_p + gamma. For the ground alpha and a are its own acceleration +
// (1/p - 1/2) its slope over the step. Then x = rates gamma, and with x_v = -x/p, x_u = (h x_v - eta_0)/p
//   theta_dot_change += h w(c x_v),  theta_change += h w(c x_u),  w = 2 Re for a pair of poles, 1 for a real one.
// Re s > 0, and K, beta, D are not negative. So Re of s A + s Z is positive where |s|^2 M + K + H is, and elimination without pivoting is safe, here
// by L D L^T of complex symmetric 3x3 matrices. The template parameter S, std::complex<T> or T (a real pole), is the field of the solve.
// Reads   coupled, theta_dot, CoupledState::ground. Adds to theta_change, theta_dot_change. O(n). Errors none.
#pragma once
#include "coupled_state.h"
#include "scheme.h"

namespace bough {

template <class T> void resolvent(const Plan<T>&, const CoupledPlan<T>&, State<T>&, CoupledWork<T>&, const Pole&);

} // namespace bough
