// joint.h: the inertia of a joint's oscillator, which the drag, the spring and the audit of energy share.
//
// S = F^1/2 I_tilde F^1/2. I_tilde is the composite's inertia about the joint (§4; the second R of "R I R" is a transpose). F = diag(f_bend, f_bend,
// f_twist) has the factors of branch_mode.h, or 1 with JointInertia::paper. Both are written in the axes of the joint's own body (z along the
// branch), not of the joint frame: there a turning body does not change its inertia. F keeps S symmetric and positive. Statics do not see it.
#pragma once
#include "analytic_state.h"
#include <limits>

namespace bough {

// Returns S [kg m^2], body axes. A body without extent about an axis (a thin rod about itself, in float) would make it singular. So a few rounding
// errors of the trace are added to the diagonal, far below any rod's real inertia in double.
template <class T>
Matrix3<T> joint_inertia(const AnalyticPlan<T>& own, const State<T>& state, const AnalyticWork<T>& work,
                         std::size_t i) {
    const Matrix3<T>& R = state.R_wb[i];
    Matrix3<T> S = R.transpose() * work.c_J_w[i] * R;
    const Vector3<T>& f = own.inertia_factor[i];
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) S(r, c) *= f[r] * f[c];
    S.diagonal().array() += 4 * std::numeric_limits<T>::epsilon() * S.trace();
    return S;
}

} // namespace bough
