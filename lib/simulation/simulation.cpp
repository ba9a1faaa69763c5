#include "simulation.h"
#include "../base/parallel.h"
#include "../base/rotation_maps.h"
#include "../coupled/coupled_stepper.h"
#include "../model/check_parts.h"
#include "explanation.h"
#include "fingerprint.h"
#include "saved.h"
#include <cmath>

namespace bough {
namespace {

SimulationOptions checked(const SimulationOptions& o) {
    if (!(o.step > 0) || !std::isfinite(o.step))
        throw SceneError("step is " + std::to_string(o.step) + " s, expected more than 0");
    if (!(o.sleep >= 0)) throw SceneError("sleep is " + std::to_string(o.sleep) + " rad/s, expected 0 or more");
    if (o.threads < 0) throw SceneError("threads is " + std::to_string(o.threads) + ", expected 0 or more");
    return o;
}

StepChoice choice_of(const SimulationOptions& o) {
    StepChoice choice;
    choice.dt = o.step;
    choice.method = o.method;
    if (!o.portable) choice.simd = fast::best_target();
    choice.sleep = o.sleep;
    return choice;
}

void require_finite(const Vec3& v, const char* name) {
    if (!v.allFinite()) throw SceneError(std::string(name) + ": is not finite, expected three finite numbers");
}

template <class T> void scale(Plan<T>& plan, double stiffness, double damping) {
    for (Vector3<T>& K : plan.K) K *= T(stiffness);
    for (T& beta : plan.beta) beta *= T(damping);
    plan.stepper->scale_wood(plan, T(stiffness), T(damping));
}

// What of a wind is in the tables that a plan was made with.
bool same_tables(const Wind& a, const Wind& b) {
    const auto same_grid = [](const WindGrid& x, const WindGrid& y) {
        return x.x == y.x && x.z == y.z && x.cell == y.cell && x.columns == y.columns && x.rows == y.rows &&
               x.velocity == y.velocity && x.octaves == y.octaves && x.persistence == y.persistence &&
               x.phase == y.phase && x.frequency == y.frequency;
    };
    const auto same_swirl = [](const WindSwirl& x, const WindSwirl& y) {
        return x.x == y.x && x.z == y.z && x.radius == y.radius && x.angle == y.angle && x.period == y.period &&
               x.wavelength == y.wavelength;
    };
    const auto same = [](const auto& x, const auto& y, auto equal) {
        return x.has_value() == y.has_value() && (!x || equal(*x, *y));
    };
    return a.reference_height == b.reference_height && a.profile == b.profile && a.period == b.period &&
           same(a.grid, b.grid, same_grid) && same(a.swirl, b.swirl, same_swirl) &&
           same(a.shelter, b.shelter, [](const WindShelter& x, const WindShelter& y) { return x.cell == y.cell; });
}

// How a joint stands and turns, whatever its spring's rest is: in the axes of the body that carries it.
struct JointMotion {
    Mat3 R = Mat3::Identity();
    Vec3 omega = Vec3::Zero(); // [rad/s]
};

} // namespace

// What is the same for both precisions' runs.
class Simulation::Inside {
public:
    Inside(Scene scene, const SimulationOptions& o) : options(checked(o)), assembly(assemble(std::move(scene))) {}
    virtual ~Inside() = default;

    virtual StepReport step() = 0;
    virtual std::size_t bodies() const = 0;
    virtual std::int64_t steps() const = 0;
    virtual const MotionFrame& frame() = 0;
    virtual const MotionEvents& events() const = 0;
    virtual Scene& scene() = 0;                                    // the plan's
    virtual void scale_wood(double stiffness, double damping) = 0; // factors on what they are now
    virtual bool pushed() const = 0;                               // free bodies may push the trees
    virtual bool sleeps() const = 0;                               // trees may
    virtual void wake() = 0;
    virtual bool gone(std::size_t body) const = 0; // has broken off
    virtual void pull(std::size_t body, const Vec3& point, const Vec3& force) = 0;
    virtual std::uint64_t hash() = 0;
    virtual void save(SavedState&) = 0;
    virtual void restore(const SavedState&) = 0;
    virtual std::string explain() const = 0;
    virtual std::size_t bytes() const = 0;
    virtual std::vector<JointMotion> joints() = 0;
    virtual void go_on(const std::vector<JointMotion>&, const std::vector<std::uint8_t>& known, double time) = 0;

    const Tree& whole_tree() const { return assembly.whole ? assembly.whole->tree : assembly.tree; }
    const std::vector<TreeRange>& whole_ranges() const {
        return assembly.whole ? assembly.whole->places.whole : assembly.ranges;
    }

    SimulationOptions options;
    double stiffness = 1, damping = 1; // set_wood
    Assembly assembly;                 // stays where it is: the run refers to its tree
};

template <class T> class Simulation::InsideOf final : public Inside {
public:
    InsideOf(Scene scene, const SimulationOptions& o) : Inside(std::move(scene), o) {
        run_ = started();
        fields_ = {true, options.velocities, options.torques, true};
        name_ = fingerprint(assembly.tree, assembly.scene);
    }

    StepReport step() override {
        if (!broken_.finite()) return broken_;
        const ThreadLimit threads(options.threads);
        const StepFlags before = run_.state.flags;
        run_.world.events = {};
        shown_ = false;
        StepReport report;
        report.non_finite = advance_run(run_, assembly.tree);
        if (!run_.world.on()) run_.state.loads.clear();
        const StepFlags& now = run_.state.flags;
        report.fast_turns = now.fast_turns - before.fast_turns;
        report.guarded = now.energy_guard - before.energy_guard;
        report.limited = now.limited - before.limited;
        for (const std::string& what : run_.world.events.what)
            ++(what == "broke" ? report.broke : what == "hit" ? report.hits : report.landed);
        if (!report.finite()) broken_ = report;
        return report;
    }

    std::size_t bodies() const override {
        return whole_tree().size_bodies() + run_.world.balls + run_.world.walkers.size();
    }
    std::int64_t steps() const override { return run_.state.step; }
    const MotionEvents& events() const override { return run_.world.events; }
    Scene& scene() override { return run_.plan.scene; }

    const MotionFrame& frame() override {
        if (shown_) return frame_;
        const ThreadLimit threads(options.threads);
        present(run_.plan, run_.state);
        fill_frame(run_.state, fields_, frame_);
        show_all(assembly, run_, frame_);
        shown_ = true;
        return frame_;
    }

    void scale_wood(double stiffness_factor, double damping_factor) override {
        scale(run_.plan, stiffness_factor, damping_factor);
    }
    bool pushed() const override { return run_.plan.contact; }
    bool sleeps() const override { return run_.plan.stepper->sleeps(); }
    void wake() override { run_.plan.stepper->wake(run_.plan, run_.state); }
    bool gone(std::size_t body) const override {
        const std::vector<std::uint8_t>& gone = run_.world.remaining.gone;
        return body < gone.size() && gone[body];
    }

    void pull(std::size_t body, const Vec3& point, const Vec3& force) override {
        run_.state.loads.push_back({body, point.template cast<T>(), force.template cast<T>()});
    }

    std::uint64_t hash() override { return state_hash(run_.plan, run_.state, run_.world); }

    void save(SavedState& saved) override {
        save_run(run_, run_.state.step, saved);
        name(saved);
        saved.source = assembly.source;
    }

    void restore(const SavedState& saved) override {
        SavedState own;
        name(own);
        const auto refuse = [](const char* field, const std::string& found, const std::string& expected) {
            if (found != expected)
                throw SceneError("/" + std::string(field) + ": is " + found + ", but this run has " + expected);
        };
        refuse("precision", saved.precision, own.precision);
        refuse("solver", saved.solver, own.solver);
        refuse("scheme", saved.scheme, own.scheme);
        if (std::abs(saved.fps * options.step * saved.substeps - 1) > 1e-12)
            throw SceneError("/fps: differs from this run's step");
        refuse("fingerprint", hash_text(saved.fingerprint), hash_text(own.fingerprint));
        Run<T> run = started(); // what broke stands again before the saved state says what did
        run.plan.scene = run_.plan.scene;
        scale(run.plan, stiffness, damping);
        restore_run(saved, saved.frame * saved.substeps, run);
        run_ = std::move(run);
        broken_ = {};
        shown_ = false;
    }

    std::string explain() const override { return explanation(run_.plan, assembly.changes); }
    std::size_t bytes() const override { return run_.state.bytes() + (run_.world.on() ? run_.world.bytes() : 0); }

    std::vector<JointMotion> joints() override {
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
        present(run_.plan, run_.state);
        CoupledState<T>& own = coupled_state(run_.state); // as it is asked for with that method alone
        for (std::size_t i = 0; i < joints.size(); ++i) {
            if (!known[i]) continue;
            const Mat3 back = run_.plan.R_pj[i].template cast<double>().transpose();
            const Vec3 theta = vector_from_quaternion<double>(Quat(Mat3(back * joints[i].R)).normalized());
            const Vec3 eta = rotation_maps<double>(theta).J_inverse * (back * joints[i].omega);
            run_.state.theta[i] = theta.template cast<T>();
            run_.state.theta_dot[i] = eta.template cast<T>();
            own.theta_change[i] = (options.step * eta).template cast<T>(); // as a first step's
            own.theta_dot_change[i].setZero();
        }
        run_.state.step = std::llround(time / options.step);
        restart(run_.plan, run_.state);
    }

private:
    Run<T> started() const {
        Wishes wishes;
        wishes.velocity = options.velocities;
        wishes.torque = options.torques;
        wishes.loads = options.pulls;
        return start_run(plan_run<T>(assembly, wishes, choice_of(options)), assembly);
    }

    // What a saved state must have been saved by.
    void name(SavedState& saved) const {
        saved.fps = 1 / options.step;
        saved.precision = options.precision == Precision::single ? "float" : "double";
        saved.solver = run_.plan.stepper->name();
        saved.scheme = run_.plan.stepper->scheme();
        saved.fingerprint = name_;
    }

    Run<T> run_;
    MotionFields fields_;
    MotionFrame frame_;
    bool shown_ = false;
    StepReport broken_;      // the step that became non-finite
    std::uint64_t name_ = 0; // fingerprint
};

Simulation::Simulation(Scene scene, const SimulationOptions& o) {
    const ThreadLimit threads(o.threads < 0 ? 1 : o.threads);
    if (o.precision == Precision::single)
        inside_ = std::make_unique<InsideOf<float>>(std::move(scene), o);
    else
        inside_ = std::make_unique<InsideOf<double>>(std::move(scene), o);
}

Simulation::Simulation(Scene scene, const SimulationOptions& o, const Simulation& before)
    : Simulation(std::move(scene), o) {
    if (o.method != Method::coupled || before.inside_->options.method != Method::coupled)
        throw SceneError("a motion goes on in another run with the coupled method alone");
    const Assembly &was = before.inside_->assembly, &is = inside_->assembly;
    const std::vector<JointMotion> there = before.inside_->joints();
    std::vector<JointMotion> here(is.tree.size_bodies());
    std::vector<std::uint8_t> known(here.size(), 0);
    for (std::size_t k = 0; k < std::min(was.ranges.size(), is.ranges.size()); ++k) {
        const TreeRange &from = was.ranges[k], &to = is.ranges[k];
        bool alike = from.bodies == to.bodies;
        for (std::size_t i = 0; alike && i < from.bodies; ++i) {
            const std::int32_t a = was.tree.parent[from.first_body + i], b = is.tree.parent[to.first_body + i];
            alike = a < 0 ? b < 0 : b >= 0 && std::size_t(a) - from.first_body == std::size_t(b) - to.first_body;
        }
        for (std::size_t i = 0; alike && i < from.bodies; ++i) {
            here[to.first_body + i] = there[from.first_body + i];
            known[to.first_body + i] = !before.inside_->gone(from.first_body + i);
        }
    }
    inside_->go_on(here, known, before.time());
}

Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

StepReport Simulation::step() {
    return inside_->step();
}
std::size_t Simulation::bodies() const {
    return inside_->bodies();
}
std::int64_t Simulation::steps() const {
    return inside_->steps();
}
double Simulation::time() const {
    return double(inside_->steps()) * inside_->options.step;
}
const SimulationOptions& Simulation::options() const {
    return inside_->options;
}
bool Simulation::has_events() const {
    return has_free_bodies(inside_->assembly.scene);
}
const Tree& Simulation::tree() const {
    return inside_->whole_tree();
}
std::span<const TreeRange> Simulation::trees() const {
    return inside_->whole_ranges();
}
std::span<const Vec3> Simulation::positions() const {
    return inside_->frame().position;
}
std::span<const Quat> Simulation::rotations() const {
    return inside_->frame().rotation;
}
std::span<const Vec3> Simulation::velocities() const {
    return inside_->frame().velocity;
}
std::span<const Vec3> Simulation::angular_velocities() const {
    return inside_->frame().angular_velocity;
}
std::span<const Vec3> Simulation::angles() const {
    return inside_->frame().theta;
}
std::span<const Vec3> Simulation::rates() const {
    return inside_->frame().theta_dot;
}
std::span<const Vec3> Simulation::torques() const {
    return inside_->frame().torque;
}
const MotionEvents& Simulation::events() const {
    return inside_->events();
}

void Simulation::set_wind(const Wind& wind) {
    std::optional<Wind>& own = inside_->scene().wind;
    if (!own)
        throw SceneError(
            "/wind: the scene began without one; begin with still air, a wind of velocity 0, where it may rise");
    if (const std::optional<Defect> defect = check(wind)) throw SceneError("/" + defect->field + " " + defect->message);
    if (!same_tables(*own, wind))
        throw SceneError("/wind: its reference_height, profile, period, grid, swirl and shelter stay as the run began; "
                         "expected changes of velocity, turbulence, gusts and seed");
    if (inside_->sleeps() && (wind.turbulence > 0 || wind.gust_factor > 1))
        throw SceneError(
            "/wind: has gusts or turbulence, in which nothing sleeps; expected a steady one, or a run without "
            "SimulationOptions::sleep");
    own = wind;
    inside_->wake();
}

void Simulation::set_gravity(const Vec3& gravity) {
    require_finite(gravity, "/gravity");
    if (inside_->options.method != Method::coupled)
        throw SceneError("/gravity: changes in a run of the coupled method alone");
    Vec3& own = inside_->scene().gravity;
    if (inside_->assembly.scene.gravity.isZero() && !gravity.isZero())
        throw SceneError("/gravity: the scene began without; begin with some, and set it to zero");
    own = gravity;
    inside_->wake();
}

void Simulation::set_wood(double stiffness, double damping) {
    if (!(stiffness > 0) || !std::isfinite(stiffness))
        throw SceneError("set_wood: stiffness is " + std::to_string(stiffness) + ", expected more than 0");
    if (!(damping >= 0) || !std::isfinite(damping))
        throw SceneError("set_wood: damping is " + std::to_string(damping) + ", expected 0 or more");
    if (inside_->options.method != Method::coupled)
        throw SceneError("set_wood: wood changes in a run of the coupled method alone");
    if (inside_->pushed()) throw SceneError("set_wood: not with balls, or what breaks off, that meet the trees");
    if (inside_->damping == 0 && damping > 0)
        throw SceneError("set_wood: damping is 0 by now, from which no factor leads back; keep it above");
    inside_->scale_wood(stiffness / inside_->stiffness, inside_->damping > 0 ? damping / inside_->damping : 1);
    inside_->stiffness = stiffness;
    inside_->damping = damping;
    inside_->wake();
}

void Simulation::pull(std::size_t body, const Vec3& point, const Vec3& force) {
    if (!inside_->options.pulls) throw SceneError("pull: SimulationOptions::pulls is not set");
    if (inside_->assembly.whole) throw SceneError("pull: not where joints are held (/simulate, /rigid)");
    const std::size_t bodies = inside_->assembly.tree.size_bodies();
    if (body >= bodies)
        throw SceneError("pull: body " + std::to_string(body) + " is not there, the trees have " +
                         std::to_string(bodies));
    if (inside_->gone(body)) throw SceneError("pull: body " + std::to_string(body) + " has broken off");
    require_finite(point, "pull: point");
    require_finite(force, "pull: force");
    inside_->pull(body, point, force);
}

std::uint64_t Simulation::hash() const {
    return inside_->hash();
}

SavedState Simulation::save() const {
    SavedState saved;
    inside_->save(saved);
    return saved;
}

void Simulation::restore(const SavedState& saved) {
    inside_->restore(saved);
}

std::string Simulation::explain() const {
    return inside_->explain();
}
std::size_t Simulation::bytes() const {
    return inside_->bytes();
}

} // namespace bough
