// ring_down.h: the first frequency and decay rate that a solver gives a tree, from a free ring-down.
//
// The tree stands unloaded: without gravity, wind, pulls and root motion, so that one shape can ring by itself. That is the
// first mode of K phi = omega^2 M phi, found by iterating phi <- K^-1 M phi (K diagonal, M phi by inverse dynamics: O(n) each).
// Let go from 0.01 rad of it in the joint that turns most, the signal is its modal coordinate, to which no other mode adds,
//   y(t) = phi^T M theta(t) / y(0),
// over three periods, and e^(-d t) (a cos 2 pi f t + b sin 2 pi f t) is fitted to it by least squares: a, b linearly, f and d by
// a search from 0.3 to 8 times the mode's frequency (above half the sampling rate a step cannot tell).
// Reads a Variant's solver, scheme and inertia; cost three periods of it. f = d = NAN where nothing can ring: a joint without
// stiffness, a run that becomes non-finite, fewer than 8 steps in three periods.
#pragma once
#include "trajectory.h"

namespace bough {

struct RingDown {
    double frequency = NAN; // [Hz]
    double decay = NAN;     // [1/s]
};

struct Mode {
    double frequency = 0;            // [Hz] undamped
    std::vector<Vec3> shape, moment; // phi (turns of the joints), M phi, body axes; phi^T M phi = 1
};

// The tree's first mode at the plan's start pose, gravity's stiffness left out. K > 0. O(bodies) an iteration, to 1e-10 of the
// frequency's square or 1000 of them.
Mode first_mode(const Plan<double>&);

// dt [s]: step; Variant::steps_per_frame is not read.
RingDown ring_down(const Problem&, const Variant&, double dt, const std::function<void()>& tick);

// Frequency [Hz] and decay [1/s] of samples dt [s] apart, searched around `about` [Hz].
RingDown fit_damped_sinusoid(const std::vector<double>& y, double dt, double about);

} // namespace bough
