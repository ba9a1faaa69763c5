#include "stability.h"
#include "../laws/air_load.h"
#include "../plan/body_air.h"
#include "../plan/ground.h"
#include "body_poses.h"
#include "energy.h"
#include "ring_down.h"
#include "solvers.h"
#include "stability_free.h"
#include "stability_motion.h"
#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace bough {
namespace {

constexpr double energy_tolerance = 0.01, growth_tolerance = 1.05, small_angle = 1; // [rad]

// Moments [N m, body axes] of the air's forces on each joint's composite.
template <class T> std::vector<Vec3> air_moments(const Plan<T>& plan, const State<T>& s, double time) {
    WindTable<double> wind = make_wind_table<double>(*plan.scene.wind, plan.top, plan.reach, plan.clocks);
    evaluate_wind(*plan.scene.wind, time, wind);
    const LeafTerms<double> leaf = leaf_terms<double>(plan.scene);
    const std::vector<BodyMotion> motion = body_motions(plan, s);
    std::vector<Vec3> f(plan.bodies), tau(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        const BodyMotion& b = motion[i];
        const Vec3 c = b.R * plan.com[i].template cast<double>();
        const Vec3 u = wind_on_body_at(plan, i, wind, Vec3(b.x + c)) - b.v - b.omega.cross(c);
        const AirLoad<double> air = air_load(air_body<double>(plan, i), leaf, b.R, u);
        const Mat3 J = b.R * plan.inertia_joint[i].template cast<double>() * b.R.transpose();
        f[i] = air.force;
        tau[i] = air.torque - air.spin * (central_inertia<double>(double(plan.mass[i]), J, c) * b.omega);
        tau[i] += c.cross(f[i]);
    }
    for (std::size_t i = plan.bodies; i-- > 0;) {
        if (plan.parent[i] >= 0) {
            const auto p = std::size_t(plan.parent[i]);
            f[p] += f[i];
            tau[p] += tau[i] + (motion[i].x - motion[p].x).cross(f[i]);
        }
        tau[i] = motion[i].R.transpose() * tau[i];
    }
    return tau;
}

// What is kept of a run, step by step.
template <class T> struct Audit {
    const Plan<T>& plan;
    const std::vector<std::size_t> tips;
    std::int64_t frames;
    std::vector<Vector3<T>> start, theta, rate;
    std::vector<Vec3> air;
    double initial = 0, work = 0, scale = 0, excess = 0;
    double squares[4] = {0, 0, 0, 0};
    std::int64_t counts[4] = {0, 0, 0, 0}, signs = 0, steps = 0;
    double max_angle = 0, largest = 0; // [rad], [rad/s]
    bool booked = true;                // all work is: nothing moves the ground

    Audit(const Plan<T>& p, const State<T>& s, const Tree& tree, std::int64_t n)
        : plan(p), tips(tip_bodies(tree)), frames(n), start(s.x_w), theta(s.theta), rate(s.theta_dot),
          booked(!p.root_motion) {
        const Energy e = energy(plan, s);
        initial = e.kinetic + e.elastic + e.potential;
        if (plan.wind) air = air_moments(plan, s, 0);
    }
    void after_step(const State<T>& s) {
        const Energy e = energy(plan, s);
        if (plan.wind) {
            std::vector<Vec3> now = air_moments(plan, s, time_of(plan, s));
            double before = 0, after = 0;
            for (std::size_t i = 0; i < plan.bodies; ++i) {
                Vec3 turned = (s.theta[i] - theta[i]).template cast<double>();
                turned = body_rate_jacobian(Vec3(s.theta[i].template cast<double>())) * turned;
                before += air[i].dot(turned);
                after += now[i].dot(turned);
            }
            work += std::max({0.0, before, after});
            air = std::move(now);
        }
        scale = std::max(scale, e.kinetic + e.elastic);
        const double above = e.kinetic + e.elastic + e.potential - initial - work;
        // Potential energies are differences of large numbers: what rounding leaves of them is no gain.
        const double rounding =
            64 * double(std::numeric_limits<T>::epsilon()) * (std::abs(e.potential) + std::abs(initial));
        if (scale > 0) excess = std::max(excess, (above - rounding) / scale);
        const auto quarter = std::size_t(4 * steps / frames);
        for (const std::size_t i : tips)
            squares[quarter] += double((s.x_w[i] - start[i]).squaredNorm()) / double(tips.size());
        ++counts[quarter];
        ++steps;
        for (std::size_t i = 0; i < plan.bodies; ++i) {
            max_angle = std::max(max_angle, double(s.theta[i].norm()));
            largest = std::max(largest, double(s.theta_dot[i].cwiseAbs().maxCoeff()));
            for (int k = 0; k < 3; ++k) {
                const double a = double(rate[i][k]), b = double(s.theta_dot[i][k]), small = 1e-6 * largest;
                signs += a * b < 0 && std::abs(a) > small && std::abs(b) > small;
            }
        }
        rate = s.theta_dot;
        theta = s.theta;
    }
    double growth() const {
        if (counts[2] == 0 || counts[3] == 0 || !(squares[2] > 0)) return NAN;
        return std::sqrt(squares[3] / double(counts[3]) / (squares[2] / double(counts[2])));
    }
};

// Whether the tips' RMS must have settled: a steady wind, damping, and a quarter of the run as long as a period.
template <class T> bool must_settle(const Plan<T>& plan, const StabilitySetup& setup, std::int64_t frames) {
    if (!plan.wind || !steady(*setup.scene.wind)) return false;
    for (std::size_t i = 0; i < plan.bodies; ++i)
        if (!(setup.tree.stiffness[i].minCoeff() > 0) || !(setup.tree.damping[i] > 0)) return false;
    Scene bare;
    bare.gravity.setZero();
    bare.pose = Pose::rest;
    const Plan<double> still = make_plan<double>(setup.tree, setup.ranges, bare, {}, setup.dt, Solver::analytic);
    return first_mode(still).frequency * setup.dt * double(frames) / 4 >= 1;
}

std::string failures(const StabilityCell& cell, bool booked, bool settles) {
    std::string text;
    const auto add = [&text](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
    if (booked && !(cell.energy_drift <= energy_tolerance)) add("energy grows beyond the work done");
    if (settles && cell.rms_growth > growth_tolerance) add("deflection grows under a steady load");
    return text;
}

template <class T>
StabilityCell run(const StabilitySetup& setup, const StabilityCase& what, Solver solver, std::int64_t frames,
                  const std::function<void()>& tick, const MotionTruth* truth) {
    StabilityCell cell;
    cell.group = what.group;
    cell.name = what.name;
    cell.solver = solver_name(solver);
    cell.precision = sizeof(T) == 4 ? "float" : "double";
    cell.promised = what.promised && !is_articulated(solver);
    if (has_free_bodies(setup.scene)) {
        run_free_cell(setup, solver, sizeof(T) == 4, frames, tick, cell);
        return cell;
    }
    const Plan<T> plan = make_plan<T>(setup.tree, setup.ranges, for_solver(setup.scene, solver), {}, setup.dt, solver,
                                      Scheme::p12, setup.simd);
    State<T> state = make_state(plan);
    Audit<T> audit(plan, state, setup.tree, frames);
    MotionStatistics statistics(setup.tree, 1 / setup.dt);
    const auto add_frame = [&] {
        if (!truth) return;
        const BodyPoses poses = body_poses(plan, state, setup.tree);
        statistics.add(poses.x, poses.R, poses.theta, poses.v);
    };
    add_frame();
    cell.finite = true;
    for (std::int64_t k = 0; k < frames && cell.finite; ++k) {
        tick();
        advance(plan, state);
        present(plan, state);
        cell.frames = k + 1;
        cell.finite = !first_non_finite(state);
        if (!cell.finite) break;
        audit.after_step(state);
        add_frame();
    }
    cell.guards = state.flags.bounded_lambda + state.flags.half_turns + state.flags.energy_guard +
                  state.flags.fast_turns + state.flags.unresolved;
    cell.max_angle = audit.max_angle;
    cell.energy_drift = audit.booked ? audit.excess : NAN;
    cell.ringing = double(audit.signs) / double(3 * plan.bodies) / double(std::max<std::int64_t>(1, audit.steps));
    cell.rms_growth = audit.growth();
    cell.outside = cell.max_angle > small_angle;
    if (!cell.finite) {
        cell.note = "non-finite after " + std::to_string(cell.frames) + " steps";
        return cell;
    }
    cell.note = failures(cell, audit.booked, must_settle(plan, setup, frames));
    cell.bounded = cell.note.empty();
    if (truth) {
        const std::string wrong = judge_motion(statistics.result(), *truth, cell);
        if (!wrong.empty()) cell.note += (cell.note.empty() ? "" : "; ") + wrong;
    }
    if (cell.outside) cell.note += std::string(cell.note.empty() ? "" : "; ") + "joints past 1 rad";
    if (state.flags.half_turns > 0) cell.note += ", past half a turn";
    return cell;
}

} // namespace

StabilityCell run_cell(const StabilitySetup& setup, const StabilityCase& what, Solver solver, bool single,
                       std::int64_t frames, const std::function<void()>& tick, const MotionTruth* truth) {
    return single ? run<float>(setup, what, solver, frames, tick, truth)
                  : run<double>(setup, what, solver, frames, tick, truth);
}

StabilityReport measure_stability(const StabilitySetup& given, const StabilityOptions& options,
                                  const std::function<void(std::int64_t, std::int64_t)>& progress) {
    StabilityReport report;
    report.bodies = std::int64_t(given.tree.size_bodies());
    report.fps = 1 / given.dt;
    std::vector<StabilityCase> cases = stability_cases();
    std::erase_if(cases, [&](const StabilityCase& c) {
        const auto named = [](const std::string& text, const std::string& part) {
            return text.find(part) != std::string::npos;
        };
        return (!named(c.group, options.only) && !named(c.name, options.only)) ||
               std::any_of(options.without.begin(), options.without.end(),
                           [&](const std::string& word) { return named(c.group, word) || named(c.name, word); });
    });
    const std::int64_t total = std::int64_t(cases.size()) * (options.with_implicit ? 5 : 4);
    std::int64_t done = 0;
    for (const StabilityCase& what : cases) {
        StabilitySetup setup = given;
        setup.scene.pose = Pose::rest;
        setup.scene.wind.reset();
        setup.scene.pulls.clear();
        setup.scene.attachments.clear();
        setup.scene.walkers.clear();
        setup.scene.root_motion.clear();
        setup.scene.fracture.reset();
        setup.scene.balls.clear();
        setup.scene.contact.reset();
        what.apply(setup);
        const auto tick = [&] { progress(done, total); };
        std::optional<MotionTruth> truth;
        if (what.compared && options.with_truth) truth = motion_truth(setup, options.frames, tick);
        const auto cell = [&](Solver solver, bool single) {
            const MotionTruth* const held_against = truth && solver == Solver::coupled ? &*truth : nullptr;
            report.cells.push_back(run_cell(setup, what, solver, single, options.frames, tick, held_against));
            progress(++done, total);
        };
        cell(Solver::coupled, false);
        cell(Solver::coupled, true);
        cell(Solver::analytic, false);
        cell(Solver::analytic, true);
        if (options.with_implicit && !has_free_bodies(setup.scene)) cell(Solver::articulated_implicit, false);
    }
    return report;
}

} // namespace bough
