#include "simulation.h"
#include "../base/parallel.h"
#include "../free/shown_tree.h"
#include "../laws/wind.h"
#include "../model/check_parts.h"
#include "any_run.h"
#include <algorithm>
#include <cmath>
#include <tuple>

namespace bough {
namespace {

void require_finite(const Vec3& v, const char* name) {
    if (!v.allFinite()) throw SceneError(std::string(name) + ": is not finite, expected three finite numbers");
}

// What may change of a wind in a run: the rest is in the tables that a plan was made with. (Names, to be read or written: copies of a wind would
// allocate its grid.)
template <class W> auto changing(W& wind) {
    return std::tie(wind.velocity, wind.turbulence, wind.gust_factor, wind.gust_period, wind.seed,
                    wind.turbulence_ahead, wind.gust_ahead);
}

// value: an enum's, which a caller's cast may have made of any number.
[[noreturn]] void refuse_option(const char* name, int value, const char* expected) {
    throw SceneError(std::string(name) + " is " + shortest_text(value) + ", expected " + expected);
}

void check_options(const SimulationOptions& o) {
    if (o.precision != Precision::single && o.precision != Precision::double_)
        refuse_option("precision", int(o.precision), "Precision::single or Precision::double_");
    if (o.method != Method::coupled && o.method != Method::analytic)
        refuse_option("method", int(o.method), "Method::coupled or Method::analytic");
    if (!(o.step > 0) || !std::isfinite(o.step))
        throw SceneError("step is " + shortest_text(o.step) + " s, expected more than 0");
    if (!(o.sleep >= 0 && std::isfinite(o.sleep)))
        throw SceneError("sleep is " + shortest_text(o.sleep) + " rad/s, expected 0 or more");
    if (o.threads < 0) throw SceneError("threads is " + std::to_string(o.threads) + ", expected 0 or more");
}

} // namespace

Simulation::Simulation(std::unique_ptr<AnyRun> run) : run_(std::move(run)) {}

Simulation::Simulation(Scene scene, const SimulationOptions& o) {
    const ThreadLimit threads(std::max(o.threads, 0));
    auto assembly = std::make_shared<Assembly>(assemble(std::move(scene)));
    check_options(o);
    run_ = make_run(std::move(assembly), {o});
}

Simulation::Simulation(Scene scene, const SimulationOptions& o, const Simulation& before)
    : Simulation(std::move(scene), o) {
    if (!run_->coupled() || !before.run_->coupled())
        throw SceneError("a motion goes on in another run with the coupled method alone");
    const Assembly &was = before.run_->assembly(), &is = run_->assembly();
    const std::vector<JointMotion> there = before.run_->joints();
    std::vector<JointMotion> here(is.tree.size_bodies());
    std::vector<std::uint8_t> known(here.size(), 0);
    std::vector<std::pair<std::size_t, GroundMotion>> grounds;
    for (std::size_t k = 0; k < std::min(was.ranges.size(), is.ranges.size()); ++k) {
        const TreeRange &from = was.ranges[k], &to = is.ranges[k];
        bool alike = from.bodies == to.bodies;
        for (std::size_t i = 0; alike && i < from.bodies; ++i) {
            const std::int32_t a = was.tree.parent[from.first_body + i], b = is.tree.parent[to.first_body + i];
            alike = a < 0 ? b < 0 : b >= 0 && std::size_t(a) - from.first_body == std::size_t(b) - to.first_body;
        }
        for (std::size_t i = 0; alike && i < from.bodies; ++i) {
            here[to.first_body + i] = there[from.first_body + i];
            known[to.first_body + i] = !before.run_->gone(from.first_body + i);
        }
        if (alike)
            for (const Attached& hand : before.run_->hands())
                if (hand.body >= from.first_body && hand.body - from.first_body < from.bodies)
                    run_->adopt(hand, to.first_body + (hand.body - from.first_body));
        if (alike && run_->drives(k) && before.run_->drives(k)) grounds.emplace_back(k, before.run_->ground(k));
    }
    run_->go_on(here, known, before.time());
    for (const auto& [tree, motion] : grounds) run_->set_ground(tree, motion, 0);
}

Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Simulation Simulation::copy() const {
    return Simulation(run_->copy());
}

Simulation make_simulation(std::shared_ptr<Assembly> of, const RunChoice& choice) {
    check_options(choice.options);
    return Simulation(make_run(std::move(of), choice));
}

AnyRun& run_of(Simulation& simulation) {
    return *simulation.run_;
}

StepReport Simulation::step(int times) {
    if (times < 0) throw SceneError("step: is " + std::to_string(times) + " steps, expected 0 or more");
    return run_->step(times);
}
StepReport Simulation::settle(double seconds) {
    if (!(seconds >= 0 && seconds <= most_settled))
        throw SceneError("settle: is " + std::to_string(seconds) + " s, expected 0 to " +
                         std::to_string(int(most_settled)));
    if (!run_->fresh()) throw SceneError("settle: the run has begun, expected one at its start");
    const double steps = std::round(seconds / run_->options().step);
    if (!(steps < 1e9))
        throw SceneError("settle: is " + std::to_string(seconds) + " s, more steps than can be counted");
    begin_before(std::int64_t(steps));
    return run_->step(int(steps));
}
void Simulation::begin_before(std::int64_t steps) {
    constexpr std::int64_t most = 1'000'000'000;
    if (steps < 0 || steps > most)
        throw SceneError("begin_before: is " + std::to_string(steps) + " steps, expected 0 to " + std::to_string(most));
    if (!run_->fresh()) throw SceneError("begin_before: the run has begun, expected one at its start");
    if (steps > 0) run_->set_back(steps);
}
double Simulation::settling_time() const {
    return bough::settling_time(run_->assembly());
}
std::size_t Simulation::bodies() const {
    return run_->bodies();
}
std::int64_t Simulation::steps() const {
    return run_->steps();
}
double Simulation::time() const {
    return run_->time();
}
const SimulationOptions& Simulation::options() const {
    return run_->options();
}
bool Simulation::has_events() const {
    return has_free_bodies(run_->assembly().scene);
}
const Tree& Simulation::tree() const {
    return run_->whole_tree();
}
std::span<const TreeRange> Simulation::trees() const {
    return run_->whole_ranges();
}
std::span<const Vec3> Simulation::positions() const {
    return run_->frame().position;
}
std::span<const Quat> Simulation::rotations() const {
    return run_->frame().rotation;
}
std::span<const Vec3> Simulation::velocities() const {
    return run_->frame().velocity;
}
std::span<const Vec3> Simulation::angular_velocities() const {
    return run_->frame().angular_velocity;
}
std::span<const Vec3> Simulation::angles() const {
    return run_->frame().theta;
}
std::span<const Vec3> Simulation::rates() const {
    return run_->frame().theta_dot;
}
std::span<const Vec3> Simulation::torques() const {
    return run_->frame().torque;
}

std::span<const double> Simulation::stresses() const {
    return run_->frame().stress;
}
std::string Simulation::fill(const MotionFields& fields, MotionFrame& frame) const {
    const SimulationOptions& options = run_->options();
    if ((fields.velocity && !options.velocities) || (fields.torque && !options.torques && !options.stresses) ||
        (fields.stress && !options.stresses))
        throw SceneError("fill: asks for velocities, torques or stresses, which the run's options leave out");
    const std::optional<std::size_t> body = run_->fill(fields, frame);
    return body ? "stage state_update, body " + std::to_string(*body) : "";
}
const MotionEvents& Simulation::events() const {
    return run_->events();
}
std::span<const std::uint32_t> Simulation::broken() const {
    return run_->broken();
}
std::vector<Ball> Simulation::balls() const {
    return run_->balls();
}
Tree Simulation::shown_tree(std::span<const std::uint32_t> broken) const {
    for (const std::uint32_t body : broken)
        if (body >= bodies())
            throw SceneError("shown_tree: body " + std::to_string(body) + " is not there, expected 0 to " +
                             std::to_string(bodies() - 1));
    return bough::shown_tree(run_->whole_tree(), {broken.begin(), broken.end()}, run_->balls());
}

Tree Simulation::posed_tree() const {
    if (run_->assembly().whole) throw SceneError("not where joints are held (/simulate, /rigid)");
    if (const std::size_t broken = run_->broken().size())
        throw SceneError(std::to_string(broken) + " joints broke in this run, expected a whole tree");
    Tree tree = run_->posed();
    tree.source = run_->assembly().source;
    return tree;
}

void Simulation::set_wind(const Wind& wind) {
    std::optional<Wind>& own = run_->scene().wind;
    if (!own)
        throw SceneError(
            "/wind: the scene began without one; begin with still air, a wind of velocity 0, where it may rise");
    if (const std::optional<Defect> defect = check(wind)) throw SceneError("/" + defect->field + " " + defect->message);
    if (run_->sleeps() && (wind.turbulence > 0 || wind.gust_factor > 1))
        throw SceneError(
            "/wind: has gusts or turbulence, in which nothing sleeps; expected a steady one, or a run without "
            "SimulationOptions::sleep");
    Wind before; // of what go_on() reads
    changing(before) = changing(*own);
    changing(*own) = changing(wind);
    if (*own != wind) {
        changing(*own) = changing(before);
        throw SceneError(
            "/wind: only its velocity, turbulence, gusts and seed change in a run; all else of it stays as "
            "the run began");
    }
    go_on(before, time(), *own);
    run_->wake();
}

void Simulation::set_gravity(const Vec3& gravity) {
    require_finite(gravity, "/gravity");
    if (!run_->coupled()) throw SceneError("/gravity: changes in a run of the coupled method alone");
    Vec3& own = run_->scene().gravity;
    if (run_->assembly().scene.gravity.isZero() && !gravity.isZero())
        throw SceneError("/gravity: the scene began without; begin with some, and set it to zero");
    own = gravity;
    run_->wake();
}

void Simulation::set_step(double seconds) {
    if (!(seconds > 0) || !std::isfinite(seconds))
        throw SceneError("set_step: is " + std::to_string(seconds) + " s, expected more than 0");
    if (run_->steps() < 0)
        throw SceneError("set_step: the run is before time 0, which it reaches by steps of one length");
    if (!run_->coupled()) throw SceneError("set_step: the step changes in a run of the coupled method alone");
    run_->set_step(seconds);
}

void Simulation::set_wood(double stiffness, double damping) {
    if (!(stiffness > 0) || !std::isfinite(stiffness))
        throw SceneError("set_wood: stiffness is " + std::to_string(stiffness) + ", expected more than 0");
    if (!(damping >= 0) || !std::isfinite(damping))
        throw SceneError("set_wood: damping is " + std::to_string(damping) + ", expected 0 or more");
    if (!run_->coupled()) throw SceneError("set_wood: wood changes in a run of the coupled method alone");
    if (run_->pushed()) throw SceneError("set_wood: not with balls, or what breaks off, that meet the trees");
    if (run_->damping == 0 && damping > 0)
        throw SceneError("set_wood: damping is 0 by now, from which no factor leads back; keep it above");
    run_->scale_wood(stiffness / run_->stiffness, run_->damping > 0 ? damping / run_->damping : 1);
    run_->stiffness = stiffness;
    run_->damping = damping;
}

void Simulation::pull(std::size_t body, const Vec3& point, const Vec3& force) {
    if (!run_->options().pulls) throw SceneError("pull: SimulationOptions::pulls is not set");
    if (run_->assembly().whole) throw SceneError("pull: not where joints are held (/simulate, /rigid)");
    const std::size_t bodies = run_->assembly().tree.size_bodies();
    if (body >= bodies)
        throw SceneError("pull: body " + std::to_string(body) + " is not there, the trees have " +
                         std::to_string(bodies));
    if (run_->gone(body)) throw SceneError("pull: body " + std::to_string(body) + " has broken off");
    require_finite(point, "pull: point");
    require_finite(force, "pull: force");
    run_->pull(body, point, force);
}

std::uint64_t Simulation::attach(std::size_t body, const Vec3& point, double stiffness, double damping) {
    if (!run_->coupled()) throw SceneError("attach: with the coupled method alone");
    const std::size_t bodies = run_->whole_tree().size_bodies();
    if (body >= bodies)
        throw SceneError("attach: body " + std::to_string(body) + " is not there, the trees have " +
                         std::to_string(bodies));
    require_finite(point, "attach: point");
    for (const auto& [value, name] : {std::pair{stiffness, "stiffness"}, {damping, "damping"}})
        if (!(value >= 0) || !std::isfinite(value))
            throw SceneError(std::string("attach: ") + name + " is " + std::to_string(value) + ", expected 0 or more");
    if (stiffness == 0 && damping == 0)
        throw SceneError("attach: holds nothing, expected stiffness or damping above 0");
    const std::uint64_t number = run_->attach(body, point, stiffness, damping);
    run_->wake();
    return number;
}

namespace {

Attached& hand_of(AnyRun& run, std::uint64_t attachment, const char* call) {
    if (Attached* const hand = run.attachment(attachment)) return *hand;
    throw SceneError(std::string(call) + ": attachment " + std::to_string(attachment) +
                     " is not there: it was released, its body broke off, or it never was");
}

} // namespace

void Simulation::move_attachment(std::uint64_t attachment, const Vec3& target, int steps) {
    Attached& hand = hand_of(*run_, attachment, "move_attachment");
    require_finite(target, "move_attachment: target");
    if (steps < 0) throw SceneError("move_attachment: steps is " + std::to_string(steps) + ", expected 0 or more");
    hand.steps = steps;
    (steps > 0 ? hand.goal : hand.target) = target;
    run_->wake();
}

void Simulation::release(std::uint64_t attachment) {
    hand_of(*run_, attachment, "release");
    run_->release(attachment);
    run_->wake();
}

Vec3 Simulation::attachment_force(std::uint64_t attachment) const {
    return hand_of(*run_, attachment, "attachment_force").force;
}

void Simulation::set_ground(std::size_t tree, const GroundMotion& to, int steps) {
    if (!run_->options().grounds) throw SceneError("set_ground: SimulationOptions::grounds is not set");
    const std::size_t trees = run_->assembly().ranges.size();
    if (tree >= trees)
        throw SceneError("set_ground: tree " + std::to_string(tree) + " is not there, the scene has " +
                         std::to_string(trees));
    if (!run_->drives(tree))
        throw SceneError("set_ground: tree " + std::to_string(tree) + " has keys of its own (/root_motion)");
    if (steps < 0) throw SceneError("set_ground: steps is " + std::to_string(steps) + ", expected 0 or more");
    require_finite(to.position, "set_ground: position");
    require_finite(to.velocity, "set_ground: velocity");
    require_finite(to.angular_velocity, "set_ground: angular_velocity");
    if (!(to.rotation.norm() > 0.5) || !(to.rotation.norm() < 2))
        throw SceneError("set_ground: rotation is none, expected a quaternion of unit length");
    run_->set_ground(tree, to, steps);
}

std::uint64_t Simulation::hash() const {
    return run_->hash();
}

SavedState Simulation::save() const {
    SavedState saved;
    run_->save(saved);
    return saved;
}

void Simulation::restore(const SavedState& saved) {
    if (const std::optional<Defect> defect = check(saved)) throw SceneError(text_of(*defect));
    run_->restore(saved);
}

std::string Simulation::explain() const {
    const ThreadLimit threads(run_->options().threads);
    return run_->explain();
}
RunAccount Simulation::account() const {
    return run_->account();
}
std::size_t Simulation::bytes() const {
    const RunAccount made = account();
    return made.state_bytes + made.free_bytes;
}

} // namespace bough
