#include "error_estimate.h"
#include "../coupled/attachment.h"
#include "../coupled/coupled_lanes_stepper.h"
#include "../coupled/coupled_stepper.h"
#include "../lanes/plan_lanes.h"
#include "../model/tips.h"
#include "../plan/change.h"
#include "../plan/tip_position.h"
#include "any_run.h"
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
ErrorEstimate<T>::ErrorEstimate(const Tree& tree, const Plan<T>& plan, const State<T>& start, const WoodScale& wood)
    : tree_(tree), plan_(at_finer_steps(plan)), state_(make_state(plan_)), wood_(wood), tips_(tip_bodies(tree)) {
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
    state_.step_since = finer * start.step_since;
    state_.time_since = start.time_since;
    own.attachments = from.attachments;
    for (Attached& held : own.attachments.all) held.steps *= finer;
    plan_.stepper->change(plan_, state_, {.attachments = true});
    restart(plan_, state_);
    past_.resize(4 * tips_.size());
    note_roughness();
}

// Those that a program holds by hand (Simulation::attach); the scene's own go by their times.
template <class T> void ErrorEstimate<T>::lead_hands(const State<T>& run) {
    CoupledState<T>& own = coupled_state(state_);
    const std::vector<Attached>& there = coupled_state(run).attachments.all;
    bool came_or_went = false;
    for (std::size_t k = own.attachments.all.size(); k-- > 0;) {
        const Attached& held = own.attachments.all[k];
        if (held.planned >= 0 ||
            std::any_of(there.begin(), there.end(), [&](const Attached& other) { return other.number == held.number; }))
            continue;
        release(plan_, own, held.number);
        came_or_went = true;
    }
    for (const Attached& led : there) {
        if (led.planned >= 0) continue;
        if (!attached(own.attachments, led.number)) {
            adopt(plan_, own, led, led.body);
            came_or_went = true;
        }
        Attached& held = *attached(own.attachments, led.number);
        held.target = led.target;
        held.goal = led.goal;
        held.steps = finer * led.steps;
    }
    if (came_or_went) plan_.stepper->change(plan_, state_, {.attachments = true});
}

template <class T> void ErrorEstimate<T>::lead(const Plan<T>& plan, const State<T>& run, const WoodScale& wood) {
    if (plan.wind) plan_.scene.wind = plan.scene.wind;
    plan_.scene.gravity = plan.scene.gravity;
    if (plan.root_motion) plan_.splines = plan.splines;
    if (wood.stiffness != wood_.stiffness || wood.damping != wood_.damping)
        scale_wood(plan_, state_, wood.stiffness / wood_.stiffness,
                   wood_.damping > 0 ? wood.damping / wood_.damping : 1);
    wood_ = wood;
    if (plan.dt / finer != plan_.dt) change_step(plan_, state_, plan.dt / finer);
    state_.loads = run.loads;
    lead_hands(run);
}

template <class T> void ErrorEstimate<T>::follow(const State<T>& run) {
    while (found_.finite && state_.step < finer * run.step) {
        advance(plan_, state_);
        present(plan_, state_);
        found_.finite = !first_non_finite(state_);
        if (found_.finite) note_roughness();
    }
    state_.loads.clear(); // of that step alone
    if (found_.finite) compare(run);
}

template <class T> void ErrorEstimate<T>::note_roughness() {
    const auto of_step = [&](std::int64_t step) { return past_.data() + std::size_t(step & 3) * tips_.size(); };
    const std::int64_t now = state_.step;
    for (std::size_t k = 0; k < tips_.size(); ++k) {
        const Vec3 x = tip_position(plan_, state_, tree_, tips_[k]);
        Vec3& oldest = of_step(now)[k]; // of four steps before
        if (steps_ >= 4) {
            const Vec3 even = x + 6 * of_step(now - 2)[k] + oldest, odd = of_step(now - 1)[k] + of_step(now - 3)[k];
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

struct RunError::Own {
    explicit Own(AnyRun& of) : run(of) {
        if (!run.coupled()) throw SceneError("error: is estimated with the coupled method alone");
        if (const char* const free = free_part(run.scene()))
            throw SceneError(std::string(free) + ": no error is estimated where something is free");
        visit_run(run, [this](auto& r) {
            present(r.plan, r.state); // what has run already may have its state in lanes
            estimate(r).emplace(run.assembly().tree, r.plan, r.state, wood());
        });
    }
    std::optional<ErrorEstimate<float>>& estimate(Run<float>&) { return single; }
    std::optional<ErrorEstimate<double>>& estimate(Run<double>&) { return double_; }
    WoodScale wood() const { return {run.stiffness, run.damping}; }

    AnyRun& run;
    std::optional<ErrorEstimate<float>> single;
    std::optional<ErrorEstimate<double>> double_;
};

RunError::RunError(Simulation& simulation) : own_(std::make_unique<Own>(run_of(simulation))) {}
RunError::RunError(RunError&&) noexcept = default;
RunError& RunError::operator=(RunError&&) noexcept = default;
RunError::~RunError() = default;

void RunError::lead() {
    visit_run(own_->run, [this](auto& run) { own_->estimate(run)->lead(run.plan, run.state, own_->wood()); });
}

void RunError::follow() {
    visit_run(own_->run, [this](auto& run) {
        present(run.plan, run.state);
        own_->estimate(run)->follow(run.state);
    });
}

TipError RunError::result() const {
    return own_->single ? own_->single->result() : own_->double_->result();
}

#define BOUGH_INSTANTIATE(T) template class ErrorEstimate<T>;
#include "../base/instantiate.inc"

} // namespace bough
