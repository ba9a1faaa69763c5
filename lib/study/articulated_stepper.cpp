#include "articulated_stepper.h"
#include "../plan/carried.h"
#include "../plan/explain.h"
#include "../plan/ground.h"
#include "../plan/spring_torque.h"
#include "../plan/state_update.h"
#include "articulated_step.h"
#include "extrapolation.h"
#include <stdexcept>

namespace bough {
namespace {

// The solvers' own arrays hold a joint's rotation vector and rate while the pass runs.
void euler(const Plan<double>& plan, const ArticulatedPlan& own, State<double>& state, ArticulatedState& work,
           double time) {
    ArticulatedPass& pass = work.pass[0];
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        pass.body[i].theta = state.theta[i];
        pass.body[i].rate = work.rate[i];
    }
    if (own.method == ArticulatedMethod::explicit_euler)
        explicit_euler(plan, pass, time, plan.dt);
    else
        implicit_euler(plan, pass, time, plan.dt);
    state.flags.fast_turns += pass.fast;
    pass.fast = 0;
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        state.theta[i] = pass.body[i].theta;
        work.rate[i] = pass.body[i].rate;
    }
}

void articulated(const Plan<double>& plan, const ArticulatedPlan& own, State<double>& state, ArticulatedState& work) {
    const double time = time_of(plan, state);
    if (own.method == ArticulatedMethod::extrapolation)
        extrapolated_step(plan, own, state, work, time);
    else
        euler(plan, own, state, work, time);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        if (shorten_rotation(state.theta[i])) ++state.flags.half_turns; // as the analytic step does (spring.h)
        state.theta_dot[i] = body_rate_jacobian_inverse(state.theta[i]) * work.rate[i];
    }
}

std::size_t passes(const ArticulatedPlan& own) {
    return own.method == ArticulatedMethod::extrapolation ? std::size_t(extrapolation_rows) : 1;
}

// Where the points of the plan's attachments are at the run's start, as seen from what they are attached to.
std::vector<Vec3> attached_at(const Plan<double>& plan) {
    std::vector<Vec3> at;
    if (plan.attachments.empty()) return at;
    std::vector<Vec3> x(plan.bodies);
    std::vector<Mat3> R(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const std::int64_t spline = plan.root_motion ? spline_under(plan.moved, i) : -1;
        const Ground ground = spline < 0 ? Ground() : ground_at(plan.splines[std::size_t(spline)], 0);
        const bool root = plan.parent[i] < 0;
        const auto p = std::size_t(plan.parent[i]);
        const Mat3& carrier = root ? ground.R : R[p];
        x[i] = (root ? ground.x : x[p]) + carrier * plan.joint_position[i];
        R[i] = carrier * plan.R_pj[i] * rotation_from_vector(plan.theta_start[i]);
    }
    for (const PlannedAttachment& held : plan.attachments) {
        at.push_back(x[held.body] + R[held.body] * held.point_b);
        if (held.far) at.back() -= x[held.far->body] + R[held.far->body] * held.far->point_b;
    }
    return at;
}

} // namespace

ArticulatedStepper::ArticulatedStepper(ArticulatedMethod method, const char* name, std::string plainly)
    : Cloned<ArticulatedStepper, PlainStepper<double>, Stepper<double>>(
          StepperKind{.name = name, .plainly = std::move(plainly), .stage = Stage::articulated}) {
    own.method = method;
}

void ArticulatedStepper::refuse(const Scene& scene) const {
    if (has_free_bodies(scene))
        throw std::domain_error(std::string(free_part(scene) + 1) +
                                ": only the coupled and the analytic solver meet free bodies and walkers, not " +
                                kind().name);
    if (scene.joint_limit)
        throw std::domain_error("joint_limit: only the coupled and the analytic solver keep limits, not " +
                                std::string(kind().name));
    if (scene.fictitious)
        throw std::domain_error("fictitious: only for solver analytic; solver " + std::string(kind().name) +
                                " has these terms by nature, whole and in time");
}

void ArticulatedStepper::take_constants(const Plan<double>& plan, const Tree& tree) {
    if (plan.wind && own.method == ArticulatedMethod::implicit_euler) own.carried_drag = carried_drag(plan, tree);
}

void ArticulatedStepper::explain(const Plan<double>& plan, PlanAccount& account) const {
    const std::string solver = std::string("solver ") + kind().name;
    account.stage(Stage::articulated, true,
                  solver + (plan.forces ? "; " + forces_reason(plan) + wind_parts(plan) : "") + moved_roots(plan));
    account.array("scaled_rate", plan.bodies * sizeof(Vec3), true, "every scene");
    account.array("articulated", plan.bodies * passes(own) * sizeof(ArticulatedBody), true, solver);
}

void ArticulatedStepper::allocate(const Plan<double>& plan, State<double>& state) const {
    auto work = std::make_unique<ArticulatedState>();
    work->rate.assign(plan.bodies, Vec3::Zero());
    work->attached_at = attached_at(plan);
    work->pass.resize(passes(own));
    for (ArticulatedPass& pass : work->pass) {
        pass.body.resize(plan.bodies);
        pass.ground.resize(plan.splines.size());
        if (plan.wind) pass.wind = make_wind_table<double>(*plan.scene.wind, plan.top, plan.reach, plan.clocks);
    }
    state.own = Copied<StepperState>(std::move(work));
}

void ArticulatedStepper::advance(const Plan<double>& plan, State<double>& state, StageClock* clock) const {
    ArticulatedState& work = articulated_state(state);
    work.pass[0].carried_drag = own.carried_drag;
    for (ArticulatedPass& pass : work.pass) pass.attached_at = work.attached_at;
    run_stage(Stage::articulated, state, clock, [&] { articulated(plan, own, state, work); });
    run_stage(Stage::state_update, state, clock, [&] {
        move_ground(plan, state, time_of(plan, state, 1));
        state_update(plan, state);
    });
    if (plan.torque) spring_torque(plan, state);
    ++state.step;
}

std::vector<CarriedArray<double>> ArticulatedStepper::carried(State<double>& state) const {
    return {{"scaled_rate", &articulated_state(state).rate}};
}

void ArticulatedStepper::save(const State<double>& state, SavedState& saved) const {
    saved.articulated_step = articulated_state(state).inner_step;
}

void ArticulatedStepper::restore(State<double>& state, const SavedState& saved) const {
    articulated_state(state).inner_step = saved.articulated_step;
}

void ArticulatedStepper::drop(Plan<double>&, State<double>&, const std::vector<std::size_t>&,
                              const std::vector<CarriedMoment>&) {
    throw std::logic_error(std::string("drop: nothing breaks with solver ") + kind().name);
}

} // namespace bough
