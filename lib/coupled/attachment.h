// attachment.h: springs and dampers of any stiffness between points of bodies and points in space (Attachment, scene.h), in the coupled step.
//
// This header treats an attachment to a point in space; attachment_ties.h treats one between two bodies. The force on the body, with x its point and
// X the target, is   f = -k (x - X) - c (x' - X').
// In coupled_step.h's linear model k J^T J joins K and c J^T J joins D, J = d x' / d eta at y*. Divided by s^2 (resolvent.h) this is a mass zeta =
// k/s^2 + c/s at the point. With rho the point from the body's joint
//   M += zeta 1,   B += zeta [rho],   A += zeta (rho^2 1 - rho rho^T)
// The force of y0 in that model, with what the targets' known way and y0's rates change it by, is
//   F += k (x_0 - X_mean) + c (V_0 - X'_mean) - (1/p - 1/2) (k dX + c dX') + k V_0 / s,   N += rho x F
// x_0 is the point at y0 itself, and V_0 = J eta_0. As J is that of the step's middle, x_1 meets its target to the third order of the turn, however
// large k is. The target goes evenly from the step's start to its end, so x_1 = X_1 where k is beyond all else: R(infinity) = 0. Both are as seen
// from the tree's ground. Where the ground moves, the target's way is less by what the ground would carry the point along, and what zeta makes of the
// ground's own acceleration is taken off F.
//
// Direction. A force on a point turns the bodies on its path to the ground. As they turn, its moment about each joint changes by the Hessian of -f.x,
// which is block diagonal in the bodies' absolute rotations like gravity's (body_load.h). With P from the body's joint to the next joint of the path,
// or to the point, it is  H = (P.f) 1 - sym(P f^T). Without it a path that is drawn tight by something far beyond its reach thrashes where force over
// length exceeds its joints' own stiffness and inertia. The solve takes instead a bound on it, whichever way f points:
//   H = |P| |f| (1 - (1 - n^2/2) p p^T) + |P| max(0, w |f_0| - |f|) (1 - p p^T / 2),   p = P / |P|,  n = |p x f| / |f|
// f is the force at the end of the last step, f_0 that of y0. For a turn by a across P and by b about it, and m the cosine between P and f, the
// Hessian is at most |P| |f| (m a^2 + n |a b|). P f^T couples both turns. So a bound a^2 + e b^2 has to have 4 (1 - m) e >= n^2. For any direction
// this is e = 1/2, the second part. The first has e = n^2/2: that is enough for m <= 1/2, so wherever f presses. Elsewhere twice the bound is more
// than the Hessian, which is what a step with R(infinity) = 0 needs to come to rest. With e = 0, as it was, pressed branches of grown trees trembled
// for ever at 1/30 s: of 125 cases (springs of 1e3 N/m; calm; 300 bodies) 21 moved by more than 1 cm/s after 8 s, up to 33 m/s. Now 10 do, up to
// 0.04, as at 1/120 s 10, up to 0.11. Error where a tip is drawn aside by 0.3 of its branch, mean of 25: e = 0 0.26 %, n^2/2 0.27 %, 1/2 0.42 %.
// w is 1 where the linear model may not be trusted: where a joint would turn by more than 0.1 rad under f_0 - f, answered by the path's own springs
// and inertias alone. Below, w is the square of that turn over 0.1 rad. (A straight twig that is pushed along itself by a micrometre has to turn by
// as much as one that is pulled a metre aside.) As any L does, H leaves fixed points and the second order as they are. Tried on a twig of 0.8 mm,
// 0.36 m, E 5 GPa, pressed 0.1 m towards its foot, largest kinetic energy of the seventh second [J], k 1e3 / 20 N/m: without H 4e-2 / 3e-2; P.f alone
// where positive 2e-2 / 2e-2, and with the whole of w 2e-4 / 1e-4; the Hessian itself, with w, 3 / 0.7; this with
// e = 0 3e-7 / 1e-6. The price is that what is pressed comes to rest as slowly as that.
//
// Digits. Eliminating a joint takes zeta l^2 beside what the joint itself answers with, (J + |z| K) about its softest axis, and hands on their
// difference. With m_t the least of (J + |z| K) / l^2 along the path, (zeta / m_t)^2 roundings of m_t are lost. So zeta is at most 290 m_t in float,
// where 0.01 of m_t is lost, and 7 10^4 m_t in double, where 10^-6 is. (With 0.01 in double too, pressed branches went on by 7 m/s.) A stiffer spring
// is taken with that stiffness k_c, and its target is shifted by f_k (1/k_c - 1/k). f_k is its own force, of whose change each step takes a fifth. At
// rest it is then as long as a spring of k. In float its point follows the target within 1 / 290 of its way in a step. A stronger damper is taken as
// one of that c. With the whole of the last step's force for f_k, branches that 1e9 N/m pressed in float went on by up to 18 m/s at 1/30 s, and by up
// to 53 m/s at 1/120 s (93 of 125 by more than 1 cm/s). Now 65 of 125 do at 1/30 s, by up to 0.5 m/s, as 73 in double at 1/120 s: slow
// swings. Only one stem, which 10^5 N press (4 of the 125), still goes on by up to 6 m/s in float.
// A spring shifted so, whose target is out of reach, pulls harder at every step. What several such springs hold against each other with grows until
// rounding moves the joints between them: (H / (J + |z| K) |s|^2)^2 roundings, as zeta's. So the f_k that shifts is at most sqrt(1 / epsilon) times
// what turns a joint of the path by a radian in a step, the least of (J + |z| K) / (l |s|^2): 2900 of it in float, 7 10^7 in double. Beyond that, a
// target is pulled at with that force and with k_c.
//
// Both forces are carried from step to step. Reads motions of the bodies on paths alone. Writes sums for them before the solves, and forces after
// them. O(path) an attachment, about 0.3 us a joint of all paths together; all in double. A step allocates nothing. Errors none.
#pragma once
#include "coupled_state.h"
#include <complex>

namespace bough {

// Sets up the plan's attachments at the start pose. O(paths).
template <class T> void begin_attachments(const Plan<T>&, CoupledState<T>&);

// Adds an attachment while the run goes on, its target at rest. Returns its number, which no other one gets. O(attachments x path). Needs Plan::pose.
template <class T>
std::uint64_t attach(const Plan<T>&, CoupledState<T>&, std::size_t body, const Vec3& point_b, double stiffness,
                     double damping, const Vec3& target);
// Takes over one that another run made, with its number, on a body here. Its forces are zero.
template <class T> void adopt(const Plan<T>&, CoupledState<T>&, const Attached&, std::size_t body);
// Returns the attachment of this number; null: there is none.
Attached* attached(Attachments&, std::uint64_t number);
template <class T> void release(const Plan<T>&, CoupledState<T>&, std::uint64_t number);
// Releases those on bodies that have broken off.
template <class T> void release_from(const Plan<T>&, CoupledState<T>&, const std::vector<std::size_t>& bodies);

// Fills in AttachedBody::now from arrays in document order, as they stand.
template <class T> void read_attached(const State<T>&, CoupledState<T>&);
// Fills in AttachedBody::sums for the step from `time` [s]. Needs AttachedBody::now of its start.
template <class T> void place_attachments(const Plan<T>&, const CoupledPlan<T>&, CoupledState<T>&, double time);
// Finds the forces at the step's end, and the work. Called once the step is solved, before the energy guard. Needs AttachedBody::now of its end.
void settle_attachments(Attachments&);

// What is added to a body of the solve at pole p. The parts are those of resolvent.h.
template <class S> struct AttachmentTerms {
    Eigen::Matrix<S, 3, 3> A, B, M;
    Eigen::Matrix<S, 3, 1> N, F;
};
template <class S> AttachmentTerms<S> attachment_terms(const AttachmentSums&, std::complex<double> p, double h);

} // namespace bough
