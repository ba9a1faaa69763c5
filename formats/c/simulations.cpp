#include "formats/documents/motion.h"
#include "handle.h"
#include "lib/base/shortest_text.h"
#include "lib/simulation/pick.h"
#include "wind.h"
#include "write.h"
#include <algorithm>
#include <cstring>

using namespace bough;
using namespace bough::c;

namespace {

SimulationOptions options_of(const bough_settings& s) {
    const auto fail = [](const char* field, const std::string& value, const char* expected) {
        throw WrongCall(std::string(field) + ": is " + value + ", expected " + expected);
    };
    if (!(s.step > 0) || !std::isfinite(s.step)) fail("step", shortest_text(s.step), "seconds, above 0");
    if (!(s.sleep >= 0)) fail("sleep", shortest_text(s.sleep), "rad/s, 0 or more");
    if (s.threads < 0) fail("threads", std::to_string(s.threads), "0 or more");
    if (s.precision != BOUGH_FLOAT && s.precision != BOUGH_DOUBLE)
        fail("precision", std::to_string(s.precision), "BOUGH_FLOAT or BOUGH_DOUBLE");
    if (s.method != BOUGH_COUPLED && s.method != BOUGH_ANALYTIC)
        fail("method", std::to_string(s.method), "BOUGH_COUPLED or BOUGH_ANALYTIC");
    SimulationOptions o;
    o.step = s.step;
    o.precision = s.precision == BOUGH_FLOAT ? Precision::single : Precision::double_;
    o.method = s.method == BOUGH_ANALYTIC ? Method::analytic : Method::coupled;
    o.sleep = s.sleep;
    o.threads = s.threads;
    o.velocities = s.velocities != 0;
    o.torques = s.torques != 0;
    o.stresses = s.stresses != 0;
    o.pulls = s.pulls != 0;
    o.grounds = s.grounds != 0;
    o.portable = s.portable != 0;
    return o;
}

// What the caller brings where the scene's document names files.
void require_trees(const Scene& scene) {
    for (std::size_t k = 0; k < scene.trees.size(); ++k)
        if (!scene.trees[k].tree)
            throw WrongCall("scene: place " + std::to_string(k) + " (" + scene.trees[k].file +
                            ") has no tree yet; bough_scene_put gives it one");
    if (scene.trees.empty()) throw WrongCall("scene: has no tree; bough_scene_add gives it one");
}

template <class Numbers> bough_array array_of(std::span<const Numbers> values) {
    constexpr std::size_t components = sizeof(Numbers) / sizeof(double);
    static_assert(components == 1 || components == 3 || components == 4);
    return {reinterpret_cast<const double*>(values.data()), values.size(), components, sizeof(Numbers)};
}

bough_array read(const Simulation& s, std::int32_t field) {
    const auto wanted = [](bool is, const char* setting) {
        if (!is) throw WrongCall(std::string("field: is not kept; settings.") + setting + " asks for it");
    };
    switch (field) {
    case BOUGH_POSITION:
        return array_of(s.positions());
    case BOUGH_ROTATION:
        return array_of(s.rotations());
    case BOUGH_VELOCITY:
        wanted(s.options().velocities, "velocities");
        return array_of(s.velocities());
    case BOUGH_ANGULAR_VELOCITY:
        wanted(s.options().velocities, "velocities");
        return array_of(s.angular_velocities());
    case BOUGH_ANGLE:
        return array_of(s.angles());
    case BOUGH_RATE:
        return array_of(s.rates());
    case BOUGH_TORQUE:
        wanted(s.options().torques, "torques");
        return array_of(s.torques());
    case BOUGH_STRESS:
        wanted(s.options().stresses, "stresses");
        return array_of(s.stresses());
    }
    throw WrongCall("field: is " + std::to_string(field) + ", expected BOUGH_POSITION to BOUGH_STRESS");
}

// Also of a run that was not stepped, but goes on with the motion of one (`before`) that is not finite.
bool has_finite_joints(const SavedState& state) {
    for (const std::vector<Vec3>* const joints :
         {&state.theta, &state.theta_dot, &state.theta_change, &state.theta_dot_change, &state.scaled_rate})
        if (!std::all_of(joints->begin(), joints->end(), [](const Vec3& v) { return v.allFinite(); })) return false;
    return true;
}

} // namespace

bough_settings bough_default_settings(void) {
    const SimulationOptions o;
    bough_settings s{};
    s.check = mark<bough_settings>(settings_mark);
    s.step = o.step;
    s.precision = o.precision == Precision::single ? BOUGH_FLOAT : BOUGH_DOUBLE;
    s.method = o.method == Method::analytic ? BOUGH_ANALYTIC : BOUGH_COUPLED;
    s.sleep = o.sleep;
    s.threads = o.threads;
    return s;
}

bough_result bough_simulate(const bough_scene* scene, const bough_settings* settings, const bough_simulation* before,
                            bough_simulation** simulation) {
    return call([&] {
        const Use<SceneObject> use(scene);
        const bough_settings defaults = bough_default_settings();
        const SimulationOptions options =
            options_of(settings ? marked(settings, settings_mark, "settings", "bough_default_settings()") : defaults);
        required(simulation, "simulation");
        const Scene& from = use->document.scene;
        require_trees(from);
        std::optional<Use<SimulationObject>> old;
        if (before) old.emplace(before);
        auto object = std::make_shared<SimulationObject>(old ? Simulation(from, options, (*old)->simulation)
                                                             : Simulation(from, options));
        object->wind = from.wind;
        object->first_body = {0};
        for (const TreeRange& tree : object->simulation.trees())
            object->first_body.push_back(tree.first_body + tree.bodies);
        *simulation = static_cast<bough_simulation*>(give(object));
    });
}

bough_result bough_settle(bough_simulation* simulation, double seconds) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        if (!(seconds >= 0 && seconds <= Simulation::most_settled))
            throw WrongCall("seconds: is " + shortest_text(seconds) + ", expected 0 to " +
                            std::to_string(int(Simulation::most_settled)));
        if (use->simulation.steps() != 0) throw WrongCall("simulation: has been stepped, expected one at its start");
        const StepReport made = use->simulation.settle(seconds);
        if (!made.finite())
            throw NonFinite(use->non_finite = "the simulation became non-finite before its start: " + made.non_finite);
    });
}

bough_result bough_settling_time(bough_simulation* simulation, double* seconds) {
    return call([&] {
        const Use<SimulationObject> use(simulation);
        required(seconds, "seconds");
        *seconds = use->simulation.settling_time();
    });
}

bough_result bough_time(const bough_simulation* simulation, double* seconds) {
    return call([&] {
        const Use<SimulationObject> use(simulation);
        required(seconds, "seconds") = use->simulation.time();
    });
}

bough_result bough_step(bough_simulation* simulation, bough_report* report) {
    return call([&] {
        const Use<SimulationObject> use(simulation);
        Simulation& own = use->simulation;
        if (use->error) use->error->lead();
        const StepReport made = own.step();
        if (use->error && made.finite()) use->error->follow();
        if (report)
            *report = {own.steps(),  own.time(), made.fast_turns, made.guarded,
                       made.limited, made.broke, made.hits,       made.landed};
        if (!made.finite())
            throw NonFinite(use->non_finite = "the simulation became non-finite in step " +
                                              std::to_string(own.steps()) + ": " + made.non_finite);
    });
}

bough_result bough_read(bough_simulation* simulation, bough_field field, bough_array* array) {
    return call([&] {
        const Use<SimulationObject> use(simulation);
        std::int32_t number; // which may be none of them: no enum is read
        static_assert(sizeof field == sizeof number);
        std::memcpy(&number, &field, sizeof number);
        required(array, "array") = read(use->simulation, number);
    });
}

bough_result bough_pick(bough_simulation* simulation, const double from[3], const double direction[3], double aperture,
                        bough_hit* hit, int32_t* found) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        const Ray ray{Vec3(required_vector(from, "from")), Vec3(required_vector(direction, "direction")), aperture};
        required(hit, "hit");
        required(found, "found");
        const std::optional<RayHit> met = pick(use->simulation, ray);
        *found = met ? 1 : 0;
        if (!met) return;
        hit->body = met->body;
        Eigen::Map<Vec3>(hit->point) = met->point;
        Eigen::Map<Vec3>(hit->world) = met->world;
        hit->distance = met->distance;
    });
}

bough_result bough_pull(bough_simulation* simulation, size_t body, const double point[3], const double force[3]) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        use->simulation.pull(body, Vec3(required_vector(point, "point")), Vec3(required_vector(force, "force")));
    });
}

bough_result bough_attach(bough_simulation* simulation, size_t body, const double point[3], double stiffness,
                          double damping, uint64_t* attachment) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        const Vec3 there(required_vector(point, "point"));
        required(attachment, "attachment");
        *attachment = use->simulation.attach(body, there, stiffness, damping);
    });
}

bough_result bough_move_attachment(bough_simulation* simulation, uint64_t attachment, const double target[3],
                                   int32_t steps) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        use->simulation.move_attachment(attachment, Vec3(required_vector(target, "target")), steps);
    });
}

bough_result bough_attachment_force(bough_simulation* simulation, uint64_t attachment, double force[3]) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        required(force, "force");
        Eigen::Map<Vec3>(force, 3) = use->simulation.attachment_force(attachment);
    });
}

bough_result bough_release(bough_simulation* simulation, uint64_t attachment) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        use->simulation.release(attachment);
    });
}

bough_result bough_set_wind(bough_simulation* simulation, const bough_wind* wind) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        Wind changed = use->wind ? *use->wind : Wind();
        change(changed, wind);
        use->simulation.set_wind(changed);
        use->wind = changed;
    });
}

bough_result bough_set_gravity(bough_simulation* simulation, const double gravity[3]) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        use->simulation.set_gravity(Vec3(required_vector(gravity, "gravity")));
    });
}

bough_result bough_set_wood(bough_simulation* simulation, double stiffness, double damping) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        use->simulation.set_wood(stiffness, damping);
    });
}

bough_result bough_set_step(bough_simulation* simulation, double step) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        use->simulation.set_step(step);
    });
}

bough_ground bough_default_ground(void) {
    bough_ground ground{};
    ground.check = mark<bough_ground>(ground_mark);
    ground.rotation[3] = 1;
    return ground;
}

bough_result bough_set_ground(bough_simulation* simulation, size_t tree, const bough_ground* ground, int32_t steps) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        const bough_ground& to = marked(ground, ground_mark, "ground", "bough_default_ground()");
        GroundMotion motion;
        motion.position = Vec3(to.position);
        motion.rotation = Quat(to.rotation);
        motion.velocity = Vec3(to.velocity);
        motion.angular_velocity = Vec3(to.angular_velocity);
        use->simulation.set_ground(tree, motion, steps);
    });
}

bough_result bough_watch_error(bough_simulation* simulation, int32_t on) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        if (on)
            use->error = RunError(use->simulation);
        else
            use->error.reset();
    });
}

bough_result bough_read_error(const bough_simulation* simulation, bough_step_error* error) {
    return call([&] {
        const Use<SimulationObject> use(simulation);
        required(error, "error");
        if (!use->error) throw WrongCall("error: is not watched; bough_watch_error() begins it");
        const TipError found = use->error->result();
        *error = {found.rms, found.worst, found.deflection, found.samples, found.known()};
    });
}

bough_result bough_save(const bough_simulation* simulation, void* buffer, size_t capacity, size_t* size) {
    return call([&] {
        const Use<SimulationObject> use(simulation);
        if (!use->non_finite.empty()) throw NonFinite(use->non_finite + "; its state is not saved");
        const SavedState state = use->simulation.save();
        if (!has_finite_joints(state))
            throw NonFinite("the simulation is not finite, and states hold finite numbers only");
        write_to(buffer, capacity, size, [&](Output& to) { write_state(to, state, Form::safetensors); });
    });
}

bough_result bough_restore(bough_simulation* simulation, const void* bytes, size_t size, const char* name) {
    return call([&] {
        const Use<SimulationObject> use(simulation);
        const std::string place = name_or_memory(name);
        const SavedState state = read_state(content(bytes, size), place);
        try {
            use->simulation.restore(state);
            use->non_finite.clear();
            if (use->error) use->error = RunError(use->simulation);
        } catch (const SceneError& error) {
            throw InputError(place, error.what());
        }
    });
}

bough_result bough_hash(const bough_simulation* simulation, uint64_t* hash) {
    return call([&] {
        const Use<SimulationObject> use(simulation);
        required(hash, "hash") = use->simulation.hash();
    });
}
