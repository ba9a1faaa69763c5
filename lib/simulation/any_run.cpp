#include "any_run.h"
#include "../base/hash_text.h"
#include "../base/parallel.h"
#include "../base/rotation_maps.h"
#include "../coupled/attachment.h"
#include "../coupled/coupled_lanes_stepper.h"
#include "../coupled/coupled_stepper.h"
#include "../free/world_step.h"
#include "../lanes/plan_lanes.h"
#include "../plan/change.h"
#include "../plan/expand.h"
#include "../plan/posed_tree.h"
#include "../plan/tip_position.h"
#include "driven_ground.h"
#include "explanation.h"
#include "fingerprint.h"
#include "hands.h"
#include "saved.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

StepChoice choice_of(const SimulationOptions& o) {
    StepChoice choice;
    choice.method = o.method;
    if (!o.portable) choice.simd = fast::best_target();
    choice.sleep = o.sleep;
    return choice;
}

template <class T> class RunOf final : public AnyRun {
public:
    RunOf(std::shared_ptr<Assembly> of, const RunChoice& c) : AnyRun(std::move(of), c) {
        fields_ = {true, options().velocities, options().torques, true, options().stresses};
        if (options().grounds) find_driven();
        if (choice_.saves) name_ = fingerprint(assembly_->tree, assembly_->scene);
        run_ = started();
    }
    std::unique_ptr<AnyRun> copy() const override { return std::make_unique<RunOf>(*this); }
    Run<float>* single() override { return as<float>(); }
    Run<double>* double_() override { return as<double>(); }

    StepReport step(int times) override {
        if (!broken_.finite()) return broken_;
        const ThreadLimit threads = limit();
        const StepFlags before = run_.state.flags;
        run_.world.events = {};
        StepReport report;
        for (int k = 0; k < times && report.finite(); ++k) {
            advance(nullptr);
            report.non_finite = non_finite();
        }
        report.fast_turns = run_.state.flags.fast_turns - before.fast_turns;
        report.guarded = run_.state.flags.energy_guard - before.energy_guard;
        report.limited = run_.state.flags.limited - before.limited;
        for (const std::string& what : run_.world.events.what) {
            report.broke += what == "broke";
            report.hits += what == "hit";
            report.landed += what == "landed";
        }
        if (!report.finite()) broken_ = report;
        return report;
    }
    void advance(StageClock* clock) override {
        shown_ = fresh_ = false;
        for (const Driven& driven : driven_) keep_going(spline_of(run_, driven), time(), options().step);
        if (run_.state.step < 0) return settle_on(clock);
        bough::advance(run_.plan, run_.state, run_.world, clock);
        if (!run_.world.on()) run_.state.loads.clear();
    }
    bool fresh() const override { return fresh_; }
    void set_back(std::int64_t steps) override {
        const ThreadLimit threads = limit();
        present(run_.plan, run_.state);
        run_.state.step = -steps;
        restart(run_.plan, run_.state);
        shown_ = fresh_ = false;
    }
    std::string non_finite() override { return bough::non_finite(run_, assembly_->tree); }
    void begin_again() override {
        const ThreadLimit threads = limit();
        if (run_.world.on()) {
            run_ = started();
        } else {
            for (const Driven& driven : driven_) make_driven(spline_of(run_, driven));
            run_.state = {};
            run_.state = make_state(run_.plan);
        }
        broken_ = {};
        shown_ = false;
        fresh_ = true;
    }

    std::size_t bodies() const override {
        return (assembly_->whole ? assembly_->whole->tree.size_bodies() : run_.plan.bodies) + run_.world.balls +
               run_.world.walkers.size();
    }
    std::int64_t steps() const override { return run_.state.step; }
    double time() const override { return time_of(run_.plan, run_.state); }
    const MotionEvents& events() const override { return run_.world.events; }
    const std::vector<std::uint32_t>& broken() const override { return run_.world.broken; }
    std::vector<Ball> balls() const override {
        return shown_balls(assembly_->tree, assembly_->scene, run_.world.walkers);
    }
    Scene& scene() override { return run_.plan.scene; }
    bool coupled() const override { return fast::coupled_plan(run_.plan) != nullptr; }

    const MotionFrame& frame() override {
        if (shown_) return frame_;
        const ThreadLimit threads = limit();
        frame_.frame = run_.state.step;
        frame_.time = time();
        fill(fields_, frame_);
        shown_ = true;
        return frame_;
    }
    std::optional<std::size_t> fill(const MotionFields& fields, MotionFrame& frame) override {
        present(run_.plan, run_.state);
        const std::optional<std::size_t> wrong = fill_frame(run_.plan, run_.state, fields, frame);
        show_all(*assembly_, run_, frame);
        return wrong;
    }

    Tree posed() override {
        const ThreadLimit threads = limit();
        present(run_.plan, run_.state);
        return posed_tree(run_.plan, run_.state, assembly_->tree);
    }
    void ends(const std::vector<std::size_t>& bodies, std::vector<Vec3>& to) override {
        const ThreadLimit threads = limit();
        present(run_.plan, run_.state);
        to.resize(bodies.size());
        for (std::size_t k = 0; k < bodies.size(); ++k) to[k] = end_position(run_.state, assembly_->tree, bodies[k]);
    }
    void shown_ends(const std::vector<std::size_t>& bodies, std::vector<Vec3>& to) override {
        if (!assembly_->whole) return ends(bodies, to);
        present(run_.plan, run_.state);
        to.resize(bodies.size());
        for (std::size_t k = 0; k < bodies.size(); ++k) {
            const WholePose pose = whole_pose(assembly_->whole->places, run_.plan, run_.state, bodies[k]);
            to[k] = pose.x + pose.R.col(2) * assembly_->whole->tree.size[bodies[k]][0];
        }
    }

    void scale_wood(double stiffness_factor, double damping_factor) override {
        bough::scale_wood(run_.plan, run_.state, stiffness_factor, damping_factor);
    }
    void set_step(double seconds) override {
        change_step(run_.plan, run_.state, seconds);
        choice_.options.step = seconds;
    }
    bool pushed() const override { return run_.plan.contact; }
    bool sleeps() const override {
        const fast::PlannedLanes<T>* const lanes = fast::planned_lanes(run_.plan);
        return lanes && lanes->sleep.on;
    }
    void wake() override { run_.plan.stepper->change(run_.plan, run_.state, {.wake = true}); }
    bool gone(std::size_t body) const override { return has_broken_off(run_, body); }
    void pull(std::size_t body, const Vec3& point, const Vec3& force) override {
        run_.state.loads.push_back({body, point.template cast<T>(), force.template cast<T>()});
    }

    std::uint64_t attach(std::size_t body, const Vec3& point, double k, double c) override {
        return attach_hand(run_, *assembly_, body, point, k, c);
    }
    Attached* attachment(std::uint64_t number) override {
        return coupled() ? attached(coupled_state(run_.state).attachments, number) : nullptr;
    }
    void release(std::uint64_t number) override { release_hand(run_, number); }
    std::vector<Attached> hands() const override { return hands_of(run_); }
    void adopt(const Attached& hand, std::size_t body) override { adopt_hand(run_, hand, body); }

    std::uint64_t hash() override { return state_hash(run_.plan, run_.state, run_.world); }

    void save(SavedState& saved) override {
        save_run(run_, run_.state.step, saved);
        name(saved);
        saved.source = assembly_->source;
    }

    void restore(const SavedState& saved) override {
        const ThreadLimit threads = limit();
        SavedState own;
        name(own);
        const auto refuse = [](const char* field, const std::string& found, const std::string& expected) {
            if (found != expected)
                throw SceneError("/" + std::string(field) + ": is " + found + ", but this run has " + expected);
        };
        refuse("precision", saved.precision, own.precision);
        refuse("solver", saved.solver, own.solver);
        refuse("scheme", saved.scheme, own.scheme);
        if (std::abs(saved.fps * options().step * saved.substeps - 1) > 1e-12)
            throw SceneError("/fps: differs from this run's step");
        refuse("theta", std::to_string(saved.theta.size()) + " bodies", std::to_string(run_.plan.bodies) + " bodies");
        refuse("fingerprint (of tree, wind, seed and scene)", hash_text(saved.fingerprint), hash_text(own.fingerprint));
        refuse("whole", saved.whole, own.whole);
        const std::int64_t step = saved.frame * saved.substeps;
        const auto stay = [&](Run<T>& run) { // grounds as they are by now
            for (const Driven& driven : driven_)
                put_ground(spline_of(run, driven), saved_time(saved, step, options().step),
                           ground_at(spline_of(run_, driven), time()));
        };
        const bool held = coupled() && coupled_state(run_.state).attachments.numbers > 0;
        if (fresh_ && !run_.world.on() && !held) { // a state that is refused would take hands with it
            stay(run_);
            run_.state.loads.clear(); // pulls of a step that is not taken
            try {
                restore_run(saved, step, run_);
            } catch (const SceneError&) {
                begin_again();
                throw;
            }
        } else {
            Run<T> run = started(); // what broke stands again before the saved state says what did
            run.plan.scene = run_.plan.scene;
            bough::scale_wood(run.plan, run.state, stiffness, damping);
            stay(run);
            restore_run(saved, step, run);
            for (const Attached& hand : hands())
                if (!has_broken_off(run, hand.body)) adopt_hand(run, hand, hand.body);
            if (held) // what was released keeps its number
                coupled_state(run.state).attachments.numbers = coupled_state(run_.state).attachments.numbers;
            run_ = std::move(run);
        }
        broken_ = {};
        shown_ = fresh_ = false;
    }

    std::string explain() const override { return explanation(run_.plan, assembly_->changes); }

    RunAccount account() const override {
        RunAccount a;
        const fast::PlannedLanes<T>* const lanes = fast::planned_lanes(run_.plan);
        a.bodies = run_.plan.bodies;
        a.solver = run_.plan.stepper->kind().name;
        a.simd = lanes ? fast::target_name(lanes->target) : "none";
        if (!sleeps()) a.awake = lanes ? lanes->sleep.reason : "plain path: " + run_.plan.stepper->kind().plainly;
        if (lanes) a.sleep = lanes->sleep.rate;
        for (std::size_t k = 0; k < stage_count; ++k) a.stages.push_back({stage_name(Stage(k)), run_.state.calls[k]});
        a.flags = run_.state.flags;
        const WorldCounts& counts = run_.world.counts;
        a.broke = counts.broke;
        a.hits = counts.hits;
        a.landed = counts.landed;
        a.imbalance = counts.imbalance;
        a.state_bytes = run_.state.bytes();
        a.free_bytes = run_.world.on() ? run_.world.bytes() : 0;
        return a;
    }

    bool drives(std::size_t tree) const override {
        return std::any_of(driven_.begin(), driven_.end(), [tree](const Driven& d) { return d.tree == tree; });
    }
    void set_ground(std::size_t tree, const GroundMotion& to, int steps) override {
        RootSpline& spline = spline_of(run_, driven(tree));
        const Ground there = ground_of(spline, to);
        if (steps > 0) return lead_ground(spline, time(), steps * options().step, there);
        put_ground(spline, time(), there);
        const ThreadLimit threads = limit();
        present(run_.plan, run_.state);
        bough::restart(run_.plan, run_.state);
        shown_ = false;
    }
    GroundMotion ground(std::size_t tree) const override {
        const RootSpline& spline = run_.plan.splines[driven(tree).spline];
        return motion_of(spline, ground_at(spline, time()));
    }

    std::vector<JointMotion> joints() override {
        const ThreadLimit threads = limit();
        present(run_.plan, run_.state);
        std::vector<JointMotion> joints;
        for (std::size_t i = 0; i < run_.plan.bodies; ++i) {
            const RotationMaps<double> maps = rotation_maps<double>(run_.state.theta[i].template cast<double>());
            const Mat3 R = run_.plan.R_pj[i].template cast<double>();
            joints.push_back({R * maps.R, R * (maps.J * run_.state.theta_dot[i].template cast<double>())});
        }
        return joints;
    }

    void go_on(const std::vector<JointMotion>& joints, const std::vector<std::uint8_t>& known, double time) override {
        const ThreadLimit threads = limit();
        fresh_ = false;
        present(run_.plan, run_.state);
        CoupledState<T>& own = coupled_state(run_.state); // as it is asked for with that method alone
        for (std::size_t i = 0; i < joints.size(); ++i) {
            if (!known[i]) continue;
            const Mat3 back = run_.plan.R_pj[i].template cast<double>().transpose();
            const Vec3 theta = vector_from_quaternion<double>(Quat(Mat3(back * joints[i].R)).normalized());
            const Vec3 eta = rotation_maps<double>(theta).J_inverse * (back * joints[i].omega);
            run_.state.theta[i] = theta.template cast<T>();
            run_.state.theta_dot[i] = eta.template cast<T>();
            own.theta_change[i] = (options().step * eta).template cast<T>(); // as a first step's
            own.theta_dot_change[i].setZero();
        }
        run_.state.step = std::llround(time / options().step);
        if (std::abs(this->time() - time) > 1e-9 * options().step) { // steps of another length
            run_.state.step_since = run_.state.step;
            run_.state.time_since = time;
        }
        restart(run_.plan, run_.state);
    }

private:
    ThreadLimit limit() const { return ThreadLimit(options().threads); }

    template <class Other> Run<Other>* as() {
        if constexpr (std::is_same_v<Other, T>)
            return &run_;
        else
            return nullptr;
    }

    std::unique_ptr<Stepper<T>> stepper() const {
        if constexpr (std::is_same_v<T, float>) {
            if (choice_.steppers.single) return choice_.steppers.single(*assembly_);
        } else {
            if (choice_.steppers.double_) return choice_.steppers.double_(*assembly_);
        }
        return stepper_of<T>(*assembly_, choice_of(options()));
    }

    // A step before time 0: of the trees alone, and forgotten by all counts.
    void settle_on(StageClock* clock) {
        bough::advance(run_.plan, run_.state, clock);
        run_.state.loads.clear();
        run_.state.calls = {};
        run_.state.flags = {};
    }

    struct Driven {
        std::size_t tree, spline; // of the plan's, one for each entry of the scene's root_motion
    };
    void find_driven() {
        Scene& scene = assembly_->scene;
        const std::size_t own = scene.root_motion.size();
        move_all_trees(scene, assembly_->ranges.size());
        for (std::size_t k = own; k < scene.root_motion.size(); ++k)
            driven_.push_back({std::size_t(scene.root_motion[k].tree), k});
    }
    const Driven& driven(std::size_t tree) const {
        return *std::find_if(driven_.begin(), driven_.end(), [tree](const Driven& d) { return d.tree == tree; });
    }
    static RootSpline& spline_of(Run<T>& run, const Driven& driven) { return run.plan.splines[driven.spline]; }

    Run<T> started() {
        const SimulationOptions& o = options();
        const Wishes wishes{o.velocities, o.torques, choice_.poses, o.stresses, o.pulls};
        const bool keeps = choice_.keeps_trees || has_free_bodies(assembly_->scene);
        Plan<T> plan = keeps ? plan_run<T>(*assembly_, wishes, options().step, stepper())
                             : plan_run<T>(std::move(*assembly_), wishes, options().step, stepper());
        for (const Driven& driven : driven_) make_driven(plan.splines[driven.spline]);
        return start_run(std::move(plan), *assembly_);
    }

    // What a saved state must have been saved by.
    void name(SavedState& saved) const {
        saved.fps = 1 / options().step;
        saved.precision = std::is_same_v<T, float> ? "float" : "double";
        saved.solver = run_.plan.stepper->kind().name;
        saved.scheme = run_.plan.stepper->kind().scheme;
        saved.fingerprint = name_;
        saved.part = assembly_->part.part;
        saved.parts = assembly_->part.parts;
        if (saved.parts > 1) saved.whole = hash_text(assembly_->part.whole);
    }

    Run<T> run_;
    std::vector<Driven> driven_;
    MotionFields fields_;
    MotionFrame frame_;
    bool shown_ = false;     // frame_ is of now
    bool fresh_ = true;      // no step was taken, nothing restored
    StepReport broken_;      // the step that became non-finite
    std::uint64_t name_ = 0; // fingerprint
};

} // namespace

AnyRun::AnyRun(std::shared_ptr<Assembly> of, RunChoice c) : choice_(std::move(c)), assembly_(std::move(of)) {}

std::unique_ptr<AnyRun> make_run(std::shared_ptr<Assembly> of, const RunChoice& choice) {
    const ThreadLimit threads(choice.options.threads);
    if (choice.options.precision == Precision::single) return std::make_unique<RunOf<float>>(std::move(of), choice);
    return std::make_unique<RunOf<double>>(std::move(of), choice);
}

} // namespace bough
