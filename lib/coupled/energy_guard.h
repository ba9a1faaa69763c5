// energy_guard.h: no step of the coupled solver gives a tree more energy than was put into it.
//
// The step is accurate where bodies turn by a small part of a radian in it. It does not resolve what turns faster. The nonlinear terms of that, taken
// at one point for the whole step, can bring in energy for which nothing did work. Such a gain is taken back where it was gained, and never from what
// carries it.
// Ends are leaves, clumps and fruit, each on its one joint. An end that turns by more than a radian in a step is weighed by itself, as seen from what
// carries it, whose motion is given:
//   excess = (kinetic + elastic)_1 - (...)_0 - (f + m (g - a)) . (c_1 - b_1) - (I (Omega_1 - Omega_0)) . w_1
// kinetic is that of the joint's own rate w, c the centre of mass from the joint, b where it would be with the joint fixed, a that point's mean
// acceleration, Omega the carrier's angular velocity. A positive excess is taken from the joint's rate. Ends that are pulled or attached are left
// out.
// Wood. Only where a piece of a tree's wood turns by more than 0.3 rad in a step, the tree's balance over the step is drawn up:
//   excess = (kinetic + elastic + potential)_1 - (...)_0 - work of the air, the pulls and, where that is positive, the attachments
// It uses what the tree's ends have kept, the bodies' true kinetic energy, gravity's potential and the air's force of the step, at the mean velocity
// that the bodies had: (f(y*) - D (v_mean - v*)) . (x_1 - x_0). A positive excess is taken from the rates of the wood that turns that fast, by one
// factor in [0, 1]. Where that is not enough, it is taken from all of the tree; in a wind on leaves only where that wood has a hundredth of the
// tree's kinetic energy. So what turns slowly and carries flailing leaves and twigs keeps its rates whatever the excess: a guard that took from all
// of the tree braked a birch in a storm to a standstill.
// Both act on an excess from 1/1000 of the kinetic energy on, which is the balance's own error. Damping only ever makes an excess smaller, so the
// guard never takes what damping took. On a ground that is carried along, all of it is as seen from the ground, and gravity is less by the ground's
// acceleration. A tree on a ground that turns or jumps is not watched, since that work is not booked. Each scaled joint is counted
// (StepFlags::energy_guard), and its last change is dropped.
// Cost: only a comparison a body where nothing turns fast, else two sweeps over the watched trees.
#pragma once
#include "coupled_state.h"

namespace bough {

// Weighs what the balance needs of y0, when the step is known but not yet taken. Returns false where no tree is watched.
template <class T> bool weigh_start(const Plan<T>&, State<T>&, CoupledWork<T>&, double time);

// Scales rates after the step. Kinematics (poses) must be up to date.
template <class T> void guard_energy(const Plan<T>&, State<T>&, CoupledWork<T>&, double time);

// True for what hangs at the end of a branch and is none: a leaf, a clump, fruit. It is known with wind alone; without wind nothing flutters.
template <class T> bool is_end(const Plan<T>& plan, std::size_t i) {
    return plan.wind && plan.kind[i] != Kind::branch;
}

// True for a ground that turns or jumps.
template <class T> bool turns(const GroundStep<T>* g) {
    return g && (g->jumps || !(g->omega.isZero(0) && g->omega_0.isZero(0)));
}

// [m] Returns how far a ground that does not turn goes in the step (ground_course.h).
template <class T> Vector3<T> carried_by(const GroundStep<T>& g, T h) {
    return h * (g.v_0 + h * (g.a / 2 - g.slope_a / 12));
}

// Finds the account's factors, which leave as much kinetic energy as there may be.
void settle(EnergyAccount&, bool foliage);

} // namespace bough
