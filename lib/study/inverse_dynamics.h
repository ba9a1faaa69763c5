// inverse_dynamics.h: how well accelerations solve the equations of motion: the check that an articulated-body pass needs,
// because it can lose its digits on trees with extreme ratios of mass and stiffness and still look sane.
//
// The recursive Newton-Euler algorithm: outward the accelerations of all bodies from those of the joints, inward the wrenches
// they need; what the joint's spring does not provide of the moment is the residual, N_j - tau_j [N m].
// It has no elimination in it: an independent O(n) answer, backward stable.
#pragma once
#include "../plan/plan.h"
#include "../plan/state.h"

namespace bough {

struct Residual {
    double rms = 0, worst = 0; // [N m] over the joints
    double moment_rms = 0; // [N m] of the terms that cancel: own inertia, weight, air, spring, what hangs further out
    double relative() const { return moment_rms > 0 ? rms / moment_rms : 0; }
};

// Of `acceleration` (d rate / dt, body axes) at theta, rate (body axes), time. O(n).
Residual inverse_dynamics(const Plan<double>&, const std::vector<Vec3>& theta, const std::vector<Vec3>& rate,
                          const std::vector<Vec3>& acceleration, double time);

} // namespace bough
