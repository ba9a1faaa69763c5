#include "error_estimate.h"
#include "advance.h"
#include "trajectory.h"
#include <algorithm>
#include <cassert>
#include <cmath>

namespace bough {
namespace {

template <class T> Plan<T> at_twice_the_step(Plan<T> plan) {
    assert(plan.solver == Solver::coupled);
    plan.dt *= 2;
    plan.lanes.sleep.on = false; // depends on the step; and what it loses is a part of the error
    plan.torque = false;
    return plan;
}

template <class T> std::vector<Vector3<T>> twice(const std::vector<Vector3<T>>& from) {
    std::vector<Vector3<T>> to = from;
    for (Vector3<T>& v : to) v *= 2;
    return to;
}

} // namespace

template <class T>
ErrorEstimate<T>::ErrorEstimate(const Tree& tree, const Plan<T>& plan, const State<T>& start)
    : tree_(tree), plan_(at_twice_the_step(plan)), state_(make_state(plan_)), tips_(tip_bodies(tree)) {
    found_.tips = tips_.size();
    for (const std::size_t i : tips_) {
        start_tips_.push_back(tip_position(plan_, state_, tree, i));
        found_.extent = std::max(found_.extent, start_tips_.back().norm());
    }
    if (start.step % 2 == 0) begin(start);
}

template <class T> void ErrorEstimate<T>::begin(const State<T>& run) {
    state_.theta = run.theta;
    state_.theta_dot = run.theta_dot;
    // The last changes stand for the motion's rates: over twice the step they are twice as large.
    state_.theta_change = twice(run.theta_change);
    state_.theta_dot_change = twice(run.theta_dot_change);
    state_.step = run.step / 2;
    restart(plan_, state_);
    begun_ = true;
}

template <class T> void ErrorEstimate<T>::follow(const State<T>& run) {
    if (!begun_) {
        if (run.step % 2 == 0) begin(run);
        return;
    }
    while (found_.finite && 2 * state_.step + 2 <= run.step) {
        advance(plan_, state_);
        present(plan_, state_);
        found_.finite = !first_non_finite(state_);
    }
    if (found_.finite && 2 * state_.step == run.step) compare(run);
}

template <class T> void ErrorEstimate<T>::compare(const State<T>& run) {
    for (std::size_t k = 0; k < tips_.size(); ++k) {
        const Vec3 x = tip_position(plan_, run, tree_, tips_[k]);
        const double off = (tip_position(plan_, state_, tree_, tips_[k]) - x).squaredNorm();
        squares_ += off;
        worst_ = std::max(worst_, off);
        deflection_squares_ += (x - start_tips_[k]).squaredNorm();
    }
    ++found_.samples;
}

template <class T> TipError ErrorEstimate<T>::result() const {
    TipError result = found_;
    const double count = double(found_.samples) * double(found_.tips);
    if (count > 0) {
        result.rms = std::sqrt(squares_ / count);
        result.worst = std::sqrt(worst_);
        result.deflection = std::sqrt(deflection_squares_ / count);
    }
    return result;
}

template class ErrorEstimate<float>;
template class ErrorEstimate<double>;

} // namespace bough
