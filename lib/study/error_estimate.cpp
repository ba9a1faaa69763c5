#include "error_estimate.h"
#include "../coupled/coupled_lanes_stepper.h"
#include "../coupled/coupled_stepper.h"
#include "../lanes/plan_lanes.h"
#include "../simulation/any_run.h"
#include "trajectory.h"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace bough {
namespace {

constexpr int finer = TipError::finer;
constexpr double of_difference = 1.5;

template <class T> Plan<T> at_finer_steps(Plan<T> plan) {
    CoupledPlan<T>* const own = fast::coupled_plan(plan);
    assert(own);
    plan.dt /= finer;
    if (own->scheme == Scheme::lie) own->scheme = Scheme::p12; // what LIE damps away it does at either step
    if (auto* lanes = fast::planned_lanes(plan))
        lanes->sleep.on = false; // depends on the step; and what it loses is a part of the error
    plan.torque = false;
    return plan;
}

template <class T> std::vector<Vector3<T>> in_finer_steps(const std::vector<Vector3<T>>& change) {
    std::vector<Vector3<T>> part = change;
    for (Vector3<T>& v : part) v /= T(finer);
    return part;
}

double rms(double squares, double count) {
    return count > 0 ? std::sqrt(squares / count) : 0;
}

} // namespace

template <class T>
ErrorEstimate<T>::ErrorEstimate(const Tree& tree, const Plan<T>& plan, const State<T>& start)
    : tree_(tree), plan_(at_finer_steps(plan)), state_(make_state(plan_)), tips_(tip_bodies(tree)) {
    found_.tips = tips_.size();
    double extent = 0;
    for (const std::size_t i : tips_) {
        start_tips_.push_back(tip_position(plan_, state_, tree, i));
        extent = std::max(extent, start_tips_.back().norm());
    }
    found_.rounding = extent * double(std::numeric_limits<T>::epsilon());
    state_.theta = start.theta;
    state_.theta_dot = start.theta_dot;
    CoupledState<T>& own = coupled_state(state_);
    const CoupledState<T>& from = coupled_state(start);
    own.theta_change = in_finer_steps(from.theta_change); // of the last step: they stand for the motion's rates
    own.theta_dot_change = in_finer_steps(from.theta_dot_change);
    state_.step = finer * start.step;
    restart(plan_, state_);
    past_.resize(4 * tips_.size());
    note_roughness();
}

template <class T> void ErrorEstimate<T>::follow(const State<T>& run) {
    while (found_.finite && state_.step < finer * run.step) {
        advance(plan_, state_);
        present(plan_, state_);
        found_.finite = !first_non_finite(state_);
        if (found_.finite) note_roughness();
    }
    if (found_.finite) compare(run);
}

template <class T> void ErrorEstimate<T>::note_roughness() {
    const auto of_step = [&](std::int64_t step) { return past_.begin() + (step & 3) * std::int64_t(tips_.size()); };
    const std::int64_t now = state_.step;
    for (std::size_t k = 0; k < tips_.size(); ++k) {
        const auto at = std::int64_t(k);
        const Vec3 x = tip_position(plan_, state_, tree_, tips_[k]);
        Vec3& oldest = of_step(now)[at]; // of four steps before
        if (steps_ >= 4) {
            const Vec3 even = x + 6 * of_step(now - 2)[at] + oldest, odd = of_step(now - 1)[at] + of_step(now - 3)[at];
            rough_squares_ += (even - 4 * odd).squaredNorm();
        }
        oldest = x;
    }
    ++steps_;
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
    result.rms = of_difference * rms(squares_, count);
    result.worst = of_difference * std::sqrt(worst_);
    result.deflection = rms(deflection_squares_, count);
    if (scheme_of(fast::coupled_plan(plan_)->scheme).poles == 1)
        result.rough = rms(rough_squares_, double(steps_ - 4) * double(found_.tips));
    return result;
}

RunError::RunError(Simulation& simulation) : run_(run_of(simulation)) {
    visit_run(run_,
              [](auto& run) { present(run.plan, run.state); }); // what has run already may have its state in lanes
    const Tree& tree = run_.assembly().tree;
    if (const Run<float>* const run = run_.single())
        single_.emplace(tree, run->plan, run->state);
    else
        double_.emplace(tree, run_.double_()->plan, run_.double_()->state);
}

void RunError::follow() {
    visit_run(run_, [this](auto& run) {
        present(run.plan, run.state);
        if constexpr (std::is_same_v<decltype(run), Run<float>&>)
            single_->follow(run.state);
        else
            double_->follow(run.state);
    });
}

TipError RunError::result() const {
    return single_ ? single_->result() : double_->result();
}

template class ErrorEstimate<float>;
template class ErrorEstimate<double>;

} // namespace bough
