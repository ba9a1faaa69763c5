// ring_down.h: the first frequency and decay rate that a solver gives a tree, from a free ring-down.
//
// The tree stands without wind, pulls and root motion in the equilibrium under gravity of its drawn (or settled) pose, every
// joint turned by what a steady sideways acceleration along x would turn it: nearly the first mode's shape, small (tips
// 1 % of the height on average). Let go, the signal is the projection on that shape,
//   y(t) = sum m (x(t) - x_rest).(x(0) - x_rest), scaled by its first value,
// over three periods, and e^(-d t) (a cos 2 pi f t + b sin 2 pi f t) is fitted to it by least squares: a, b linearly, f and d by
// a search from 0.3 to 8 times the estimate of sway.h (above which the samples of a step cannot tell). Other modes are
// left in the signal; the reference's has them too.
// Reads a Variant's solver and step; cost three periods of it. f = d = NAN where nothing can ring: a joint without
// stiffness, a pose that does not hold, a run that becomes non-finite, fewer than 8 steps.
#pragma once
#include "trajectory.h"

namespace bough {

struct RingDown {
    double frequency = NAN; // [Hz]
    double decay = NAN;     // [1/s]
};

// dt [s]: step; Variant::steps_per_frame is not read.
RingDown ring_down(const Problem&, const Variant&, double dt, const std::function<void()>& tick);

// Frequency [Hz] and decay [1/s] of samples dt [s] apart, searched around `about` [Hz].
RingDown fit_damped_sinusoid(const std::vector<double>& y, double dt, double about);

} // namespace bough
