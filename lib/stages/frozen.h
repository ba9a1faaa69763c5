// frozen.h: frozen coefficients: a joint's oscillators (spring.h) kept from step to step until what they are made of has changed.
//
// Why. Of a joint's step most is spent on its modes (eigenvectors of K + G in the metric of S) and on their propagators (6). They
// depend on the composite's inertia, on gravity's gradient and on the air's bounds, which hardly change from frame to frame: a
// branch has to bend by degrees before its composite is another one. What drives the joint, the residual tau - T^T K theta and the
// drag's moment, is worked out in full in every step, so the fixed point is the true one whatever is kept, and a step with kept
// coefficients is an exact step of a joint whose inertia, stiffness and damping are those of a moment ago.
//
// Kept. U, and of each mode E, B, E d + B (carry) and C + B d of q_new = q + E r + carry v, v_new = B r + C v, where the air's
// damping d' of drag.h has been multiplied in; so what holds w - w_0 is the same d' throughout, and the step is exact to first order
// (drag.h) however old d' is. The rates are carried in the modes, v = X^T w = U^T S omega; |v|^2 / 2 is the kinetic energy. The drag on
// them is (1 + h d U^T U)^-1 h U^T tau_drag, which is drag.h's form in the modes.
//
// Refreshed, joint by joint, before the step is taken, when since they were made
//   - an element of the composite's inertia about the joint, in the parent's axes, has changed by more than tolerance / 2 of its trace.
//     Of a rod that turns by an angle the largest change is 1/2 to 1/sqrt 2 of it, of the trace: so the tolerance is about that angle, in
//     radians, between the last refreshment and now. Bending, lengthening, symmetric folding (the trace) and twist (two elements change
//     places) are all changes of it. Direction and length of the first moment with the trace do not see a twisted cross; this does.
//   - or h^2 times the stiffness of gravity (g.h), or h times the damping and h^2 times the stiffness of the air's bounds, has changed by more
//     than frozen_load_share times the tolerance, measured against 1 + |lambda| h^2 + b h of the mode that feels it most: by as much
//     would B, C and E be wrong. A twig that a gust takes is refreshed, a trunk is not.
// The rate goes over as w: U U^T = M M^T with M upper triangular is L^-T of the S that was, so w = M^-1 U v, and v = X^T w anew: the energy
// stays what it was, and the change of S does no work (spring.h, "Carrying").
// Each joint decides by its own numbers alone: not its lane, block or thread.
//
// What it adds to the error, RMS over tips and 60 frames, of the RMS deflection, and joints refreshed a step; apple trees, analytic's own
// error at one step a frame is 46 % bare and 61 % in leaf:
//   tolerance                  0.01          0.05          0.1           0.2           0.5
//   bare, 973, gusty       0.19 %, 34 %  1.6 %, 6.6 %  3.5 %, 2.4 %  5.6 %, 0.5 %   9 %, 0 %
//   bare, 973, storm       0.13 %, 68 %  1.7 %, 20 %   3.5 %, 7 %    7.8 %, 1.5 %  14 %, 0 %
//   in leaf, 1001, gusty   0.18 %, 45 %  2.4 %, 15 %   6.4 %, 7 %    14 %, 2 %     29 %, 0 %
//   bare, 10 000, gusty    0.52 %, 24 %  3.3 %, 4 %    6.3 %, 1.5 %  8.8 %, 0.3 %   9 %, 0 %
//   in leaf, 10 000, gusty 0.69 %, 28 %  1.4 %, 10 %   4.0 %, 4 %    6.8 %, 0.9 %  14 %, 0 %
// At 0.05 it is below a tenth of the step's own in all of these. (A knock on one twig in still air: up to a quarter.) Every promised cell of
// `treeprofile stability` holds from `always` to 0.5. Buckling and bounded lambdas are counted in the steps that make coefficients.
// What it saves (lanes, float, 0.05): still air or none 42 to 48 % of a step; gusty wind 25 % at 1e4 and 1e5 bare bodies, nothing in leaf; of a million
// bodies the twigs are so fine that a gust makes them anew every few frames, one by one, which costs 25 % more than working all out side by side.
// Hence the tools keep coefficients at 0.05 where there is no wind, and in wind when asked to.
// A state set from outside (restart) keeps what coefficients there are, and the rates are the modes'; a joint that has none yet takes scaled_rate
// for w, as spring.h has it.
// What is not looked at: a roll of a level joint about its own axis, which leaves g.h and the composite in the parent's axes as they are and turns
// -sym(h g^T) of G; and the turn of a joint itself where its composite is as wide as it is long. K_b then changes to first order of the turn by
// half the difference of K's values, 12 % of K a radian in round wood.
// Not with a moved ground or joint limits: Plan::refresh_reason. Saved: what cannot be recomputed is the whole of it, as it was made of poses that
// are gone (saved_frozen).
#pragma once
#include "frozen_rule.h"
#include "plan.h"
#include "state.h"
#include <vector>

namespace bough {

// Whether a joint keeps its coefficients: not a leaf's or fruit's in wind, of which a gust would make it anew every few frames; those are worked
// out in full.
template <class T> bool keeps_coefficients(const Plan<T>& plan, std::size_t body) {
    return plan.refresh > 0 && (!plan.wind || plan.kind[body] == Kind::branch);
}

// Refreshes what is stale. Reads c_h_w, c_J_w, the air's rows, R_wb, theta, scaled_rate; writes frozen and scaled_rate.
// After   composite. O(n), joints in parallel. Errors none.
template <class T> void refresh_joints(const Plan<T>&, State<T>&);

// drag.h and spring.h with the coefficients that are kept, and in full where none are. Reads and writes as they do, and frozen.
// After   refresh_joints.
template <class T> void frozen_update(const Plan<T>&, State<T>&);

// All joints' coefficients in document order, FrozenJoint by FrozenJoint, of the plain path or the fast one; and back, after
// restart(). Throws std::invalid_argument for what is none of this plan's: another number of them, not finite, or no tolerance.
template <class T> std::vector<double> saved_frozen(const Plan<T>&, const State<T>&);
template <class T> void restore_frozen(const Plan<T>&, State<T>&, const std::vector<double>&);

} // namespace bough
