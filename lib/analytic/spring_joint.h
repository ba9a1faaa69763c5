// spring_joint.h: one joint of spring.h at the start of its step, and its three oscillators.
#pragma once
#include "../base/oscillator.h"
#include "analytic_state.h"
#include "spring_load.h"

namespace bough {

// Reads what spring_update does (spring.h).
template <class T>
SpringJoint<T> spring_joint(const Plan<T>&, const AnalyticPlan<T>&, const State<T>&, const AnalyticWork<T>&,
                            std::size_t body);

// q'' + b q' + lambda q = ratio (r + d v) in modes U, with r the residual's and v the rates' components when the step begins.
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

// Finds what the modes turn by in the step, and their rates at its end. r, v: the residual and the rates in modes.
template <class T> struct SpringTurn { Vector3<T> dq, v; };
template <class T>
SpringTurn<T> turn_of_modes(const SpringOscillators<T>& o, const Vector3<T>& r, const Vector3<T>& v) {
    SpringTurn<T> turn;
    for (int k = 0; k < 3; ++k) {
        const T residual = o.ratio[k] * (r[k] + o.d[k] * v[k]);
        turn.dq[k] = o.step[k].E * residual + o.step[k].B * v[k];
        turn.v[k] = o.step[k].B * residual + o.step[k].C * v[k];
    }
    return turn;
}

// Returns what the modes' rates keep: 1, except where a turn phi_b of more than guarded_turn to `next` has gained energy (spring.h, "Large turns");
// this is counted. before, after: the rates; |.|^2 / 2 is the kinetic energy.
template <class T>
T kept_of_rate(const Plan<T>&, const SpringJoint<T>&, std::size_t body, const Vector3<T>& theta, const Vector3<T>& next,
               const Vector3<T>& phi_b, const Vector3<T>& before, const Vector3<T>& after, StepFlags&);

} // namespace bough
