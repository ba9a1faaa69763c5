// live_runs.cpp: scenes and runs, with numbers in place of structs.
#include "lib/simulation/run_error.h"
#include "live.h"
#include <malloc.h>

using namespace bough;
using namespace bough::c;
using namespace bough::live;

namespace bough::live {

Scene scene_of(const bough_scene* scene) {
    const Use<SceneObject> use(scene);
    for (const Placement& place : use->document.scene.trees)
        if (!place.tree) throw WrongCall("scene: a place has no tree yet");
    return use->document.scene;
}

} // namespace bough::live

LIVE bough_scene* live_scene(const char* json, std::size_t size, const char* name) {
    bough_scene* scene = nullptr;
    return bough_read_scene(json, size, name, &scene) == BOUGH_OK ? scene : nullptr;
}
LIVE bough_result live_put(bough_scene* scene, std::size_t place, const bough_tree* tree) {
    return bough_scene_put(scene, place, tree);
}

LIVE bough_simulation* live_simulate(const bough_scene* scene, double step, int precision,
                                     const bough_simulation* before) {
    bough_settings settings = bough_default_settings();
    settings.step = step;
    settings.precision = precision;
    settings.threads = 1;
    bough_simulation* simulation = nullptr;
    return bough_simulate(scene, &settings, before, &simulation) == BOUGH_OK ? simulation : nullptr;
}

// report: steps, time [s], bodies that turned fast, were guarded, broke, landed.
LIVE bough_result live_step(bough_simulation* simulation, double* report) {
    bough_report made{};
    const bough_result result = bough_step(simulation, &made);
    const double all[] = {double(made.steps),   made.time,          double(made.fast_turns),
                          double(made.guarded), double(made.broke), double(made.landed)};
    std::copy(std::begin(all), std::end(all), report);
    return result;
}

// given: address of the bodies' places (3 f64 each), how many.
LIVE bough_result live_positions(bough_simulation* simulation, std::size_t* given) {
    bough_array x;
    if (const bough_result result = bough_read(simulation, BOUGH_POSITION, &x)) return result;
    given[0] = std::size_t(x.data), given[1] = x.count;
    return BOUGH_OK;
}

LIVE bough_result live_set_wind(bough_simulation* simulation, double x, double y, double z, double turbulence,
                                double gust_factor, double gust_period, double seed) {
    return call_of_running([&] {
        const Use<SimulationObject> use(simulation);
        Wind wind = use->wind ? *use->wind : Wind(); // what the scene says and cannot change stays
        wind.velocity = Vec3(x, y, z);
        wind.turbulence = turbulence;
        wind.gust_factor = gust_factor;
        wind.gust_period = gust_period;
        wind.seed = std::uint64_t(seed);
        use->simulation.set_wind(wind);
        use->wind = wind;
    });
}
// preset: speed [m/s], turbulence, gust factor, gust period [s].
LIVE bough_result live_wind_preset(const char* name, double* preset) {
    bough_wind wind;
    if (const bough_result result = bough_wind_preset(name, &wind)) return result;
    preset[0] = Vec3(wind.velocity[0], wind.velocity[1], wind.velocity[2]).norm();
    preset[1] = wind.turbulence, preset[2] = wind.gust_factor, preset[3] = wind.gust_period;
    return BOUGH_OK;
}

LIVE bough_result live_set_gravity(bough_simulation* simulation, double down) {
    const double gravity[] = {0, -down, 0};
    return bough_set_gravity(simulation, gravity);
}

// ray: from x y z, direction x y z. found: body, point in its frame x y z, world x y z, distance. 0 none, 1 found, -1 failed.
LIVE int live_pick(bough_simulation* simulation, const double* ray, double aperture, double* found) {
    bough_hit hit;
    std::int32_t any = 0;
    if (bough_pick(simulation, ray, ray + 3, aperture, &hit, &any) != BOUGH_OK) return -1;
    if (!any) return 0;
    found[0] = double(hit.body);
    std::copy(hit.point, hit.point + 3, found + 1);
    std::copy(hit.world, hit.world + 3, found + 4);
    found[7] = hit.distance;
    return 1;
}

// What a hand at a point of a body, at rest, has to do with: reach[0] its compliance [m/N], sum over the joints that bear it of lever^2 / K;
// reach[1] the force [N] that turns no joint by more than half a radian and all of them by no more than 2; reach[2..4] the point in the world.
LIVE bough_result live_reach(bough_simulation* simulation, std::size_t body, const double* point, double stiffness,
                             double* reach) {
    return call([&] {
        const Use<SimulationObject> use(simulation);
        const Simulation& run = use->simulation;
        const Tree& tree = run.tree();
        if (body >= tree.size_bodies()) throw WrongCall("body: is not there");
        const auto x = run.positions();
        const Vec3 p = x[body] + run.rotations()[body] * Vec3(point[0], point[1], point[2]);
        double compliance = 0, turns = 0, most = 0; // turn of a joint per newton: lever / K
        for (std::int32_t j = std::int32_t(body); j >= 0; j = tree.parent[std::size_t(j)]) {
            const Vec3& own = tree.stiffness[std::size_t(j)];
            const double k = stiffness * std::min(own.x(), own.y()), lever = (p - x[std::size_t(j)]).norm();
            if (!(k > 0)) continue;
            compliance += lever * lever / k;
            turns += lever / k;
            most = std::max(most, lever / k);
        }
        reach[0] = compliance;
        reach[1] = turns > 0 ? std::min(0.5 / most, 2 / turns) : 0;
        Eigen::Map<Vec3>(reach + 2) = p;
    });
}
// Attachments by numbers that a page has: exact up to 2^53. attach: 0 where it failed.
LIVE double live_attach(bough_simulation* simulation, std::size_t body, const double* point, double stiffness,
                        double damping) {
    std::uint64_t attachment = 0;
    bough_attach(simulation, body, point, stiffness, damping, &attachment);
    return double(attachment);
}
LIVE bough_result live_move(bough_simulation* simulation, double attachment, const double* target, int steps) {
    return bough_move_attachment(simulation, std::uint64_t(attachment), target, steps);
}
LIVE bough_result live_attachment_force(bough_simulation* simulation, double attachment, double* force) {
    return bough_attachment_force(simulation, std::uint64_t(attachment), force);
}
LIVE bough_result live_let_go(bough_simulation* simulation, double attachment) {
    return bough_release(simulation, std::uint64_t(attachment));
}

namespace {

// A copy of a run, to be taken on beside it with its companion of finer steps.
struct EstimateObject final : Object {
    static constexpr const char* name = "estimate";
    const char* kind() const override { return name; }
    explicit EstimateObject(const Simulation& from) : run(from.copy()), error(run) {}
    Simulation run;
    RunError error;
};

} // namespace

LIVE void* live_estimate(const bough_simulation* simulation) {
    return handle_of([&] {
        const Use<SimulationObject> use(simulation);
        return std::make_shared<EstimateObject>(use->simulation);
    });
}
// One step more of it. found: RMS error of the tips [m], the worst tip's, their deflection [m], whether known, steps so far.
LIVE bough_result live_estimate_step(void* estimate, double* found) {
    return call([&] {
        const auto own = find<EstimateObject>(estimate);
        if (!own->run.step().finite()) throw c::NonFinite("the estimate's run became non-finite");
        own->error.follow();
        const TipError error = own->error.result();
        found[0] = error.rms, found[1] = error.worst, found[2] = error.deflection, found[3] = error.known();
        found[4] = double(error.samples);
    });
}

// [B] What has been taken of the memory and not been given back.
LIVE double live_memory() {
    return double(std::size_t(mallinfo().uordblks));
}
