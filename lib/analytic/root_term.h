// root_term.h: what the motion of the ground does to a joint: (20) with the root's own motion alone, exactly.
//
// Derivation. The composite of joint j is carried rigidly by its tree's ground (Ground, root_motion.h). It moves with omega, alpha, and its joint
// with a(x_j) = a + alpha x (x_j - x) + omega x (omega x (x_j - x)). The moment about the joint that this motion asks for is (17), with h and J the
// composite's first moment and inertia about the joint:
//   tau_total = h x a(x_j) + J alpha + omega x (J omega)
// The joint's own equation (spring.h) has to supply, beyond this, the motion relative to the ground. So its tau becomes
//   tau + h x (g - a(x_j)) - J alpha - omega x (J omega)
// Gravity and the joint's acceleration act as one, the apparent gravity g - a(x_j). Nothing here depends on the joints' own rates: the terms of (20)
// that do are not the root's. On a ground that turns or accelerates steadily the tree comes to rest, relative to it, where true dynamics has it rest.
//
// Gradient. As for gravity, turning the composite by phi changes these moments. The part of joint j itself enters G: the apparent gravity in
// gravity's own form and, from d(J u) = phi x (J u) - J (phi x u),
//   sym(J alpha*) + omega* J omega* + (omega.J omega) 1 - sym((J omega) omega^T)
// gamma_j, the bound on the path's other joints, is that of gravity times |g - a(x_j)| / |g| (its row is stored for |g|, or for unit gravity where
// the scene has none). It takes the apparent gravity at the joint for that of all that is outboard, and leaves out their turning. So what is far out
// on a fast turning ground is bounded less than gravity is.
//
// Time. The ground's accelerations are their means over the step, so that the change of velocity is exact whatever happens within it. Its turning is
// the mean of both ends (ground_course.h). As seen from the ground, they and gravity are turned with the ground, from where it is after half of the
// step's turn to where the composite still is, at the start. Errors are of second order. A jump that begins and ends within a step is not felt: its
// mean acceleration is 0, and the oscillators take what drives them as constant (spring.h). A drive linear in time, as the coupled step has, would
// let them feel it, but not make them right: each joint would answer by itself to what all of them do (a jump that small steps resolve swings trees
// 0.4 to 1.4 times as far as true dynamics).
// Reads   plan.splines, time; c_J_w, c_h_w, x_w. Cost: a few 3x3 products a joint, O(moved trees) a step. Errors none.
#pragma once
#include "analytic_state.h"

namespace bough {

// Writes the load of each spline for the step from `time` [s] into work.root_load.
template <class T> void root_loads(const Plan<T>&, AnalyticWork<T>&, double time);

// Returns the load on joint i, or null where its ground rests.
template <class T> const RootLoad<T>* root_load_of(const Plan<T>& plan, const AnalyticWork<T>& work, std::size_t i) {
    const std::int64_t spline = spline_under(plan.moved, i);
    return spline < 0 ? nullptr : &work.root_load[std::size_t(spline)];
}

// Returns g - a(x_w) [m/s^2].
template <class T> Vector3<T> apparent_gravity(const RootLoad<T>& root, const Vector3<T>& x_w) {
    const Vector3<T> arm = x_w - root.x;
    return root.g - root.alpha.cross(arm) - root.omega.cross(root.omega.cross(arm));
}

// Returns J alpha + omega x (J omega) [N m], world.
template <class T> Vector3<T> turning_moment(const RootLoad<T>& root, const Matrix3<T>& J_w) {
    return J_w * root.alpha + root.omega.cross(J_w * root.omega);
}

// Returns its part of G [N m/rad], in the axes in which J, omega, alpha are given.
template <class T> Matrix3<T> turning_gradient(const Matrix3<T>& J, const Vector3<T>& omega, const Vector3<T>& alpha) {
    const Matrix3<T> w = cross_matrix(omega);
    const Vector3<T> l = J * omega;
    const Matrix3<T> half = T(0.5) * (J * cross_matrix(alpha) - l * omega.transpose());
    return half + half.transpose() + w * J * w + omega.dot(l) * Matrix3<T>::Identity();
}

} // namespace bough
