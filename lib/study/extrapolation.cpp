#include "extrapolation.h"
#include "../base/parallel.h"
#include "articulated_step.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace bough {
namespace {

constexpr int rows = extrapolation_rows;
constexpr double smallest = 1e-9;                                          // of the plan's step
constexpr double rounding = 4096 * std::numeric_limits<double>::epsilon(); // the table's weights sum to 3400

// Row j (from 0): j + 1 implicit steps over H from the state.
void run_row(const Plan<double>& plan, const State<double>& state, const std::vector<Vec3>& rate, ArticulatedPass& pass,
             int steps, double time, double H) {
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        pass.body[i].theta = state.theta[i];
        pass.body[i].rate = rate[i];
    }
    const double h = H / steps;
    for (int k = 0; k < steps; ++k) implicit_euler(plan, pass, time + k * h, h);
}

// From `start` to the next key of a moving ground's curves that is further than `least` away.
double way_to_key(const Plan<double>& plan, double start, double least) {
    double way = std::numeric_limits<double>::infinity();
    for (const RootSpline& spline : plan.splines)
        for (const auto* curve : {&spline.position, &spline.rotation}) {
            if (!*curve) continue;
            const std::vector<double>& keys = (*curve)->time;
            const auto next = std::upper_bound(keys.begin(), keys.end(), start + least);
            if (next != keys.end()) way = std::min(way, *next - start);
        }
    return way;
}

// The table's last row for one quantity, in place; returns the last correction.
Vec3 extrapolate(std::array<Vec3, rows>& T) {
    Vec3 correction = Vec3::Zero();
    for (int column = 1; column < rows; ++column)
        for (int j = rows - 1; j >= column; --j) {
            const double ratio = double(j + 1) / double(j + 1 - column);
            const auto k = std::size_t(j);
            correction = (T[k] - T[k - 1]) / (ratio - 1);
            T[k] += correction;
        }
    return correction;
}

} // namespace

void extrapolated_step(const Plan<double>& plan, const ArticulatedPlan& own, State<double>& state,
                       ArticulatedState& own_state, double time) {
    const double dt = plan.dt, least = smallest * dt;
    double done = 0, H = own_state.inner_step > 0 ? own_state.inner_step : dt;
    while (done < dt) {
        const double start = time + done, rest = dt - done;
        const double key = way_to_key(plan, start, least), left = key < rest - least ? key : rest;
        // What is left in one step or in two even ones: no sliver at the end.
        const double taken = H >= left ? left : H > left / 2 ? left / 2 : H;
        for (ArticulatedPass& pass : own_state.pass) pass.fast = 0;
        parallel_blocks(rows, rows / 2 * 1000. * double(plan.bodies), [&](std::size_t k, int) { // the longest first
            const std::size_t j = rows - k;
            run_row(plan, state, own_state.rate, own_state.pass[j - 1], int(j), start, taken);
        });
        double squares = 0, size = 0;
        for (std::size_t i = 0; i < plan.bodies; ++i) {
            std::array<Vec3, rows> theta, rate;
            for (std::size_t j = 0; j < rows; ++j) {
                theta[j] = own_state.pass[j].body[i].theta;
                rate[j] = own_state.pass[j].body[i].rate;
            }
            const double e = std::max(extrapolate(theta).norm(), taken * extrapolate(rate).norm());
            squares += e * e;
            size = std::max(size, theta[rows - 1].norm() + taken * rate[rows - 1].norm());
            ArticulatedBody& result = own_state.pass[0].body[i]; // the first row's end is spent
            result.theta = theta[rows - 1];
            result.rate = rate[rows - 1];
        }
        const double error = std::sqrt(squares / double(plan.bodies));
        const bool finite = std::isfinite(error);
        const bool accepted = finite && error <= own.tolerance, rounded = finite && error <= rounding * size;
        double growth = 0.25;
        if (finite) growth = std::clamp(0.8 * std::pow(own.tolerance / std::max(error, 1e-300), 1.0 / rows), 0.25, 2.5);
        if (rounded) growth = std::max(growth, 1.0); // a smaller H would not do better
        if (!accepted && !rounded && taken > least) {
            H = std::max(taken * std::min(growth, 0.8), least);
            continue;
        }
        if (!accepted) ++state.flags.unresolved;
        for (std::size_t i = 0; i < plan.bodies; ++i) {
            state.theta[i] = own_state.pass[0].body[i].theta;
            own_state.rate[i] = own_state.pass[0].body[i].rate;
            if (shorten_rotation(state.theta[i])) ++state.flags.half_turns;
        }
        ++state.flags.inner_steps;
        for (ArticulatedPass& pass : own_state.pass) state.flags.fast_turns += pass.fast;
        done = taken == rest ? dt : done + taken;
        // A last step shortened by the frame or a key says little about the length that would do.
        H = taken < H ? std::max(H * std::min(growth, 1.0), taken * growth) : taken * growth;
    }
    own_state.inner_step = std::min(H, 1e3 * dt);
}

} // namespace bough
