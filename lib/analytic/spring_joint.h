// spring_joint.h: one joint of spring.h at the start of its step, and its three oscillators.
#pragma once
#include "../base/oscillator.h"
#include "analytic_state.h"

namespace bough {

// One joint at the start of its step, in the axes of its body.
template <class T> struct SpringJoint {
    Matrix3<T> T_tb;       // rates of theta from the body's: J^-1
    Vector3<T> residual_b; // [N m] tau - T^T K theta
    Matrix3<T> K_b, KG_b;  // [N m/rad] T^T K T, and with gravity's gradient
    Vector3<T> held_b;     // [N m] of tau, what is held constant over the step: all but gravity
    Vector3<T> g_b, h_b;   // [m/s^2], [kg m] gravity and the composite's first moment
};

// Reads what spring_update does (spring.h).
template <class T>
SpringJoint<T> spring_joint(const Plan<T>&, const AnalyticPlan<T>&, const State<T>&, const AnalyticWork<T>&,
                            std::size_t body);

// q'' + b q' + lambda q = ratio (r + d v) in modes U: r the residual's, v the rates' when the step begins.
template <class T> struct SpringOscillators {
    Matrix3<T> L, X, U; // S = L L^T, U = L^-T X, U^T S U = 1
    Vector3<T> b, lambda, d,
        ratio; // [1/s], [1/s^2] as taken, with the air's bounds; d: the air's share of b; ratio: 1 but for bounded ones
    Vector3<T> row; // [1/(kg m^2)] what a multiple of 1 adds to each: sums of |U^T U| with wind, |u|^2 without
    Propagator<T> step[3];
    std::uint64_t buckling = 0, bounded = 0; // lambda below 0, and bounded
};
template <class T>
SpringOscillators<T> spring_oscillators(const Plan<T>&, const AnalyticPlan<T>&, const State<T>&, const AnalyticWork<T>&,
                                        const SpringJoint<T>&, std::size_t body);

// What the modes' rates keep, 1 but where a turn phi_b of more than guarded_turn to `next` has gained energy (spring.h, "Large turns"), counted.
// before, after: the rates, |.|^2 / 2 the kinetic energy.
template <class T>
T kept_of_rate(const Plan<T>&, const SpringJoint<T>&, std::size_t body, const Vector3<T>& theta, const Vector3<T>& next,
               const Vector3<T>& phi_b, const Vector3<T>& before, const Vector3<T>& after, StepFlags&);

} // namespace bough
