// Every function of bough_c.h called wrongly: a result and one line that names what is wrong, never more. (With the address sanitizer, tests/run.)
#include "tests/support/c_misuse.h"
#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

using namespace bough::test;

namespace {

constexpr double not_a_number = NAN, infinity = INFINITY;

// `call` with each handle that is none of its kind. Foreign: addresses of ours, of memory, numbers near handles.
template <class Handle> void wrong_handles(const Handles& all, const std::function<bough_result(Handle*)>& call) {
    const int here = 0;
    const auto memory = std::make_unique<double[]>(4);
    const std::string kind = std::is_same_v<Handle, bough_splines> ? "splines"
                             : std::is_same_v<Handle, bough_tree>  ? "tree"
                             : std::is_same_v<Handle, bough_scene> ? "scene"
                                                                   : "simulation";
    refused(call(nullptr), BOUGH_USAGE, kind + ": is NULL");
    for (const void* other :
         {(const void*)&here, (const void*)memory.get(), (const void*)std::uintptr_t(2),
          (const void*)~std::uintptr_t(0), (const void*)(std::uintptr_t(all.tree) + 1), (const void*)"text"})
        refused(call(static_cast<Handle*>(const_cast<void*>(other))), BOUGH_USAGE, kind + ": is no handle");
    for (const void* freed : {(const void*)all.freed_splines, (const void*)all.freed_tree, (const void*)all.freed_scene,
                              (const void*)all.freed_simulation})
        refused(call(static_cast<Handle*>(const_cast<void*>(freed))), BOUGH_USAGE,
                kind + ": is no handle; it was freed");
    for (const auto& [other, name] : {std::pair<const void*, std::string>(all.splines, "splines"),
                                      {all.tree, "tree"},
                                      {all.scene, "scene"},
                                      {all.simulation, "simulation"}})
        if (name != kind)
            refused(call(static_cast<Handle*>(const_cast<void*>(other))), BOUGH_USAGE,
                    kind + ": is a handle of " + name);
}

template <class Settings> Settings unmade() {
    Settings s;
    std::memset(&s, 0x5a, sizeof s);
    return s;
}

} // namespace

TEST_CASE("handles that are none, of another kind or freed are refused by every function") {
    const Handles h;
    const double v[3] = {0, 0, 1};
    wrong_handles<bough_splines>(h, [](auto* s) {
        bough_tree* tree;
        return bough_convert(s, nullptr, &tree);
    });
    wrong_handles<bough_tree>(h, [](auto* t) {
        std::size_t size;
        return bough_write_tree(t, nullptr, 0, &size);
    });
    wrong_handles<bough_tree>(h, [](auto* t) {
        bough_bodies bodies;
        return bough_tree_bodies(t, &bodies);
    });
    wrong_handles<bough_tree>(h, [&](auto* t) { return bough_scene_add(h.scene, t, nullptr, 0); });
    wrong_handles<bough_tree>(h, [&](auto* t) { return bough_scene_put(h.scene, 0, t); });
    wrong_handles<bough_scene>(h, [&](auto* c) { return bough_scene_add(c, h.tree, nullptr, 0); });
    wrong_handles<bough_scene>(h, [&](auto* c) { return bough_scene_put(c, 0, h.tree); });
    wrong_handles<bough_scene>(h, [](auto* c) { return bough_scene_set_wind(c, nullptr); });
    wrong_handles<bough_scene>(h, [](auto* c) {
        CHECK(bough_scene_file(c, 0) == nullptr);
        bough_simulation* simulation;
        return bough_simulate(c, nullptr, nullptr, &simulation);
    });
    using Call = std::function<bough_result(bough_simulation*)>;
    const std::vector<Call> calls = {
        [](auto* s) { return bough_step(s, nullptr); },
        [](auto* s) { return bough_settle(s, 0.1); },
        [](auto* s) {
            double seconds;
            return bough_settling_time(s, &seconds);
        },
        [](auto* s) {
            double seconds;
            return bough_time(s, &seconds);
        },
        [](auto* s) {
            bough_array a;
            return bough_read(s, BOUGH_POSITION, &a);
        },
        [](auto* s) {
            bough_events e;
            return bough_read_events(s, &e);
        },
        [](auto* s) {
            const std::uint32_t* bodies;
            std::size_t count;
            return bough_read_broken(s, &bodies, &count);
        },
        [](auto* s) {
            bough_balls b;
            return bough_simulation_balls(s, &b);
        },
        [](auto* s) {
            bough_bodies b;
            return bough_simulation_bodies(s, &b);
        },
        [&](auto* s) {
            bough_hit hit;
            std::int32_t found;
            return bough_pick(s, v, v, 0, &hit, &found);
        },
        [&](auto* s) { return bough_pull(s, 0, v, v); },
        [&](auto* s) {
            std::uint64_t hand;
            return bough_attach(s, 0, v, 1, 1, &hand);
        },
        [&](auto* s) { return bough_move_attachment(s, 1, v, 1); },
        [](auto* s) {
            double force[3];
            return bough_attachment_force(s, 1, force);
        },
        [](auto* s) { return bough_release(s, 1); },
        [](auto* s) {
            bough_wind wind;
            bough_wind_preset("gusty", &wind);
            return bough_set_wind(s, &wind);
        },
        [&](auto* s) { return bough_set_gravity(s, v); },
        [](auto* s) { return bough_set_wood(s, 1, 1); },
        [](auto* s) { return bough_set_step(s, 0.01); },
        [](auto* s) {
            const bough_ground ground = bough_default_ground();
            return bough_set_ground(s, 0, &ground, 1);
        },
        [](auto* s) { return bough_watch_error(s, 1); },
        [](auto* s) {
            bough_step_error error;
            return bough_read_error(s, &error);
        },
        [](auto* s) {
            bough_tree* tree;
            return bough_posed_tree(s, &tree);
        },
        [](auto* s) {
            std::uint64_t hash;
            CHECK(bough_explain(s) == nullptr);
            return bough_hash(s, &hash);
        },
        [](auto* s) {
            std::size_t size;
            return bough_save(s, nullptr, 0, &size);
        },
        [](auto* s) { return bough_restore(s, "{}", 2, nullptr); },
        [](auto* s) {
            std::uint64_t hash;
            return bough_hash(s, &hash);
        },
    };
    for (const Call& call : calls) wrong_handles<bough_simulation>(h, call);
    wrong_handles<bough_simulation>(h, [&](auto* before) {
        bough_simulation* simulation = nullptr;
        if (!before) { // means something there
            bough_step(nullptr, nullptr);
            return BOUGH_USAGE;
        }
        return bough_simulate(h.scene, nullptr, before, &simulation);
    });
    CHECK(bough_free(nullptr) == BOUGH_OK);
    refused(bough_free(h.freed_tree), BOUGH_USAGE, "it was freed");
    refused(bough_free(const_cast<double*>(v)), BOUGH_USAGE, "handle: is no handle");
}

TEST_CASE("NULL for what must be there is refused by every function, and outputs stay as they were") {
    const Handles h;
    const double v[3] = {0, 0, 1};
    const bough_growth growth = bough_default_growth();
    bough_hit hit;
    std::int32_t found = 5;
    bough_splines* splines;
    std::size_t size;
    refused(bough_grow(nullptr, &splines), BOUGH_USAGE, "growth: is NULL");
    refused(bough_grow(&growth, nullptr), BOUGH_USAGE, "splines: is NULL");
    refused(bough_read_splines(nullptr, 3, nullptr, &splines), BOUGH_USAGE, "bytes: is NULL");
    refused(bough_read_splines("{}", 2, nullptr, nullptr), BOUGH_USAGE, "splines: is NULL");
    refused(bough_convert(h.splines, nullptr, nullptr), BOUGH_USAGE, "tree: is NULL");
    refused(bough_read_tree(nullptr, 3, nullptr, nullptr), BOUGH_USAGE, "tree: is NULL");
    refused(bough_write_tree(h.tree, nullptr, 9, &size), BOUGH_USAGE, "buffer: is NULL");
    refused(bough_write_tree(h.tree, nullptr, 0, nullptr), BOUGH_USAGE, "size: is NULL");
    refused(bough_tree_bodies(h.tree, nullptr), BOUGH_USAGE, "bodies: is NULL");
    refused(bough_read_scene(nullptr, 0, nullptr, nullptr), BOUGH_USAGE, "scene: is NULL");
    refused(bough_wind_preset("gusty", nullptr), BOUGH_USAGE, "wind: is NULL");
    refused(bough_simulate(h.scene, nullptr, nullptr, nullptr), BOUGH_USAGE, "simulation: is NULL");
    refused(bough_settling_time(h.simulation, nullptr), BOUGH_USAGE, "seconds: is NULL");
    refused(bough_time(h.simulation, nullptr), BOUGH_USAGE, "seconds: is NULL");
    refused(bough_read(h.simulation, BOUGH_POSITION, nullptr), BOUGH_USAGE, "array: is NULL");
    refused(bough_read_events(h.simulation, nullptr), BOUGH_USAGE, "events: is NULL");
    const std::uint32_t* broken;
    refused(bough_read_broken(h.simulation, nullptr, &size), BOUGH_USAGE, "bodies: is NULL");
    refused(bough_read_broken(h.simulation, &broken, nullptr), BOUGH_USAGE, "count: is NULL");
    refused(bough_simulation_balls(h.simulation, nullptr), BOUGH_USAGE, "balls: is NULL");
    refused(bough_posed_tree(h.simulation, nullptr), BOUGH_USAGE, "tree: is NULL");
    refused(bough_simulation_bodies(h.simulation, nullptr), BOUGH_USAGE, "bodies: is NULL");
    refused(bough_pick(h.simulation, nullptr, v, 0, &hit, &found), BOUGH_USAGE, "from: is NULL");
    refused(bough_pick(h.simulation, v, nullptr, 0, &hit, &found), BOUGH_USAGE, "direction: is NULL");
    refused(bough_pick(h.simulation, v, v, 0, nullptr, &found), BOUGH_USAGE, "hit: is NULL");
    refused(bough_pick(h.simulation, v, v, 0, &hit, nullptr), BOUGH_USAGE, "found: is NULL");
    CHECK(found == 5);
    std::uint64_t hand = 77;
    refused(bough_attach(h.simulation, 0, nullptr, 1, 1, &hand), BOUGH_USAGE, "point: is NULL");
    refused(bough_attach(h.simulation, 0, v, 1, 1, nullptr), BOUGH_USAGE, "attachment: is NULL");
    refused(bough_move_attachment(h.simulation, 1, nullptr, 1), BOUGH_USAGE, "target: is NULL");
    refused(bough_attachment_force(h.simulation, 1, nullptr), BOUGH_USAGE, "force: is NULL");
    refused(bough_pull(h.simulation, 0, nullptr, v), BOUGH_USAGE, "point: is NULL");
    refused(bough_pull(h.simulation, 0, v, nullptr), BOUGH_USAGE, "force: is NULL");
    refused(bough_set_wind(h.simulation, nullptr), BOUGH_USAGE, "wind: is NULL");
    refused(bough_set_gravity(h.simulation, nullptr), BOUGH_USAGE, "gravity: is NULL");
    refused(bough_set_ground(h.simulation, 0, nullptr, 1), BOUGH_USAGE, "ground: is NULL");
    refused(bough_read_error(h.simulation, nullptr), BOUGH_USAGE, "error: is NULL");
    refused(bough_save(h.simulation, nullptr, 0, nullptr), BOUGH_USAGE, "size: is NULL");
    refused(bough_save(h.simulation, nullptr, 4, &size), BOUGH_USAGE, "buffer: is NULL");
    refused(bough_restore(h.simulation, nullptr, 4, nullptr), BOUGH_USAGE, "bytes: is NULL");
    refused(bough_hash(h.simulation, nullptr), BOUGH_USAGE, "hash: is NULL");
    CHECK(bough_species(std::size_t(-1)) == nullptr);
    CHECK(bough_scene_file(h.scene, std::size_t(-1)) == nullptr);
}

TEST_CASE("settings that no default function made are refused") {
    const Handles h;
    bough_splines* splines;
    bough_tree* tree;
    bough_simulation* simulation;
    const auto growth = unmade<bough_growth>();
    const auto conversion = unmade<bough_conversion>();
    const auto wind = unmade<bough_wind>();
    const auto settings = unmade<bough_settings>();
    refused(bough_grow(&growth, &splines), BOUGH_USAGE, "growth: was not made by bough_default_growth()");
    refused(bough_convert(h.splines, &conversion, &tree), BOUGH_USAGE, "bough_default_conversion()");
    refused(bough_scene_set_wind(h.scene, &wind), BOUGH_USAGE, "bough_wind_preset()");
    refused(bough_set_wind(h.simulation, &wind), BOUGH_USAGE, "bough_wind_preset()");
    refused(bough_simulate(h.scene, &settings, nullptr, &simulation), BOUGH_USAGE, "bough_default_settings()");
    const auto ground = unmade<bough_ground>();
    refused(bough_set_ground(h.simulation, 0, &ground, 1), BOUGH_USAGE,
            "ground: was not made by bough_default_ground()");
    const bough_settings zero = {}; // one that was never filled
    refused(bough_simulate(h.scene, &zero, nullptr, &simulation), BOUGH_USAGE, "bough_default_settings()");
    bough_settings other = bough_default_settings();
    other.check = bough_default_conversion().check; // another struct's, or an older version's
    refused(bough_simulate(h.scene, &other, nullptr, &simulation), BOUGH_USAGE, "bough_default_settings()");
}

TEST_CASE("numbers out of range are refused with the number") {
    const Handles h;
    const double v[3] = {0, 0, 1}, bad[3] = {0, not_a_number, 0}, zero[3] = {0, 0, 0}, huge[3] = {0, infinity, 0};
    const auto growing = [](auto change) {
        bough_growth g = bough_default_growth();
        change(g);
        bough_splines* splines = nullptr;
        const bough_result result = bough_grow(&g, &splines);
        CHECK(splines == nullptr);
        return result;
    };
    refused(growing([](auto& g) { g.species = "yggdrasil"; }), BOUGH_USAGE, "is 'yggdrasil', expected one of");
    refused(growing([](auto& g) { g.species = nullptr; }), BOUGH_USAGE, "species: is NULL");
    refused(growing([](auto& g) { g.bodies = -1; }), BOUGH_USAGE, "bodies: is -1");
    refused(growing([](auto& g) { g.bodies = INT64_MAX; }), BOUGH_USAGE, "");
    for (const double age : {-1.0, 0.01, not_a_number, infinity})
        refused(growing([age](auto& g) { g.age = age; }), BOUGH_USAGE, "age: is");
    const auto converting = [&](auto change) {
        bough_conversion c = bough_default_conversion();
        change(c);
        bough_tree* tree = nullptr;
        const bough_result result = bough_convert(h.splines, &c, &tree);
        CHECK(tree == nullptr);
        return result;
    };
    refused(converting([](auto& c) { c.material = "iron"; }), BOUGH_USAGE, "material: is 'iron', expected one of");
    refused(converting([](auto& c) { c.segment_length = not_a_number; }), BOUGH_USAGE, "segment_length: is nan");
    refused(converting([](auto& c) { c.segment_length = -1; }), BOUGH_USAGE, "segment_length: is -1");
    refused(converting([](auto& c) { c.segment_length = 1e-300; }), BOUGH_USAGE, "");
    for (const double bend : {0.0, 9e-4, not_a_number})
        refused(converting([=](auto& c) { c.max_bend = bend; }), BOUGH_USAGE, "expected radians, 0.001 or more");
    refused(converting([](auto& c) { c.max_bodies = -3; }), BOUGH_USAGE, "max_bodies: is -3");
    const auto running = [&](auto change) {
        bough_settings s = bough_default_settings();
        change(s);
        bough_simulation* simulation = nullptr;
        const bough_result result = bough_simulate(h.scene, &s, nullptr, &simulation);
        CHECK(simulation == nullptr);
        return result;
    };
    for (const double step : {not_a_number, infinity, 0.0, -1.0})
        refused(running([&](auto& s) { s.step = step; }), BOUGH_USAGE, "step: is ");
    refused(running([](auto& s) { s.sleep = not_a_number; }), BOUGH_USAGE, "sleep: is nan");
    refused(running([](auto& s) { s.threads = -2; }), BOUGH_USAGE, "threads: is -2");
    refused(running([](auto& s) { s.precision = 2; }), BOUGH_USAGE, "precision: is 2");
    refused(running([](auto& s) { s.method = -1; }), BOUGH_USAGE, "method: is -1");

    refused(bough_scene_add(h.scene, h.tree, bad, 0), BOUGH_USAGE, "position: is not finite");
    refused(bough_scene_add(h.scene, h.tree, nullptr, not_a_number), BOUGH_USAGE, "yaw: is not finite");
    refused(bough_scene_put(h.scene, 1, h.tree), BOUGH_USAGE, "place: is 1, the scene has 1");
    bough_wind wind;
    refused(bough_wind_preset("hurricane", &wind), BOUGH_USAGE, "is 'hurricane', expected calm");
    const auto blowing = [&](auto change) {
        REQUIRE(bough_wind_preset("gusty", &wind) == BOUGH_OK);
        change(wind);
        return bough_scene_set_wind(h.scene, &wind);
    };
    refused(blowing([](auto& w) { w.velocity[1] = not_a_number; }), BOUGH_USAGE, "velocity");
    refused(blowing([](auto& w) { w.reference_height = 0; }), BOUGH_USAGE, "reference_height");
    refused(blowing([](auto& w) { w.profile = infinity; }), BOUGH_USAGE, "profile");
    refused(blowing([](auto& w) { w.turbulence = -1; }), BOUGH_USAGE, "turbulence");
    refused(blowing([](auto& w) { w.gust_factor = 0.5; }), BOUGH_USAGE, "gust_factor");
    refused(blowing([](auto& w) { w.gust_period = 0; }), BOUGH_USAGE, "gust_period");

    for (const double seconds : {not_a_number, infinity, -1.0, 1e12}) // the last would run for a lifetime
        refused(bough_settle(h.simulation, seconds), BOUGH_USAGE, "seconds: is ");
    refused(bough_settle(h.simulation, 600.1), BOUGH_USAGE, "expected 0 to 600");
    CHECK(bough_settle(h.simulation, 0.1) == BOUGH_OK);
    refused(bough_settle(h.simulation, 0.1), BOUGH_USAGE, "the run has begun");
    bough_array a;
    const volatile int beyond = -1; // as C programs may pass it
    refused(bough_read(h.simulation, bough_field(beyond), &a), BOUGH_USAGE, "field: is -1, expected");
    refused(bough_read(h.simulation, bough_field(8), &a), BOUGH_USAGE, "field: is 8");
    refused(bough_read(h.simulation, BOUGH_VELOCITY, &a), BOUGH_USAGE, "settings.velocities");
    refused(bough_read(h.simulation, BOUGH_ANGULAR_VELOCITY, &a), BOUGH_USAGE, "settings.velocities");
    refused(bough_read(h.simulation, BOUGH_TORQUE, &a), BOUGH_USAGE, "settings.torques");
    refused(bough_read(h.simulation, BOUGH_STRESS, &a), BOUGH_USAGE, "settings.stresses");
    bough_hit hit;
    std::int32_t found;
    refused(bough_pick(h.simulation, bad, v, 0, &hit, &found), BOUGH_USAGE, "from: is not finite");
    refused(bough_pick(h.simulation, v, huge, 0, &hit, &found), BOUGH_USAGE, "direction: is not finite");
    refused(bough_pick(h.simulation, v, zero, 0, &hit, &found), BOUGH_USAGE, "direction is 0");
    refused(bough_pick(h.simulation, v, v, not_a_number, &hit, &found), BOUGH_USAGE, "aperture is nan");
    refused(bough_pick(h.simulation, v, v, -1, &hit, &found), BOUGH_USAGE, "aperture is -1");
    std::uint64_t hand = 77;
    refused(bough_attach(h.simulation, 100000, v, 1, 1, &hand), BOUGH_USAGE, "body 100000 is not there");
    refused(bough_attach(h.simulation, 0, bad, 1, 1, &hand), BOUGH_USAGE, "point: is not finite");
    refused(bough_attach(h.simulation, 0, v, -1, 1, &hand), BOUGH_USAGE, "stiffness is -1");
    refused(bough_attach(h.simulation, 0, v, NAN, 1, &hand), BOUGH_USAGE, "stiffness is");
    refused(bough_attach(h.simulation, 0, v, 1, INFINITY, &hand), BOUGH_USAGE, "damping is");
    refused(bough_attach(h.simulation, 0, v, 0, 0, &hand), BOUGH_USAGE, "holds nothing");
    CHECK(hand == 77); // as it was
    for (const std::uint64_t none : {std::uint64_t(0), std::uint64_t(1), ~std::uint64_t(0)}) {
        refused(bough_move_attachment(h.simulation, none, v, 1), BOUGH_USAGE, "is not there");
        refused(bough_release(h.simulation, none), BOUGH_USAGE, "is not there");
    }
    REQUIRE(bough_attach(h.simulation, 0, v, 1, 1, &hand) == BOUGH_OK);
    refused(bough_move_attachment(h.simulation, hand, bad, 1), BOUGH_USAGE, "target: is not finite");
    refused(bough_move_attachment(h.simulation, hand, v, -1), BOUGH_USAGE, "steps is -1");
    REQUIRE(bough_release(h.simulation, hand) == BOUGH_OK);
    refused(bough_release(h.simulation, hand), BOUGH_USAGE, "was released");
    refused(bough_pull(h.simulation, 100000, v, v), BOUGH_USAGE, "body 100000 is not there");
    refused(bough_pull(h.simulation, std::size_t(-1), v, v), BOUGH_USAGE, "is not there");
    refused(bough_pull(h.simulation, 0, bad, v), BOUGH_USAGE, "point: is not finite");
    refused(bough_pull(h.simulation, 0, v, huge), BOUGH_USAGE, "force: is not finite");
    REQUIRE(bough_wind_preset("gusty", &wind) == BOUGH_OK);
    refused(bough_set_wind(h.simulation, &wind), BOUGH_USAGE, "the scene began without one");
    refused(bough_set_gravity(h.simulation, bad), BOUGH_USAGE, "gravity: is not finite");
    refused(bough_set_wood(h.simulation, 0, 1), BOUGH_USAGE, "stiffness is 0");
    refused(bough_set_wood(h.simulation, not_a_number, 1), BOUGH_USAGE, "stiffness is nan");
    refused(bough_set_wood(h.simulation, 1, infinity), BOUGH_USAGE, "damping is inf");
    for (const double step : {not_a_number, infinity, 0.0, -1.0})
        refused(bough_set_step(h.simulation, step), BOUGH_USAGE, "set_step: is ");
    const auto standing = [&](auto change, std::size_t tree = 0, std::int32_t steps = 1) {
        bough_ground g = bough_default_ground();
        change(g);
        return bough_set_ground(h.simulation, tree, &g, steps);
    };
    refused(standing([](auto&) {}, 1), BOUGH_USAGE, "tree 1 is not there, the scene has 1");
    refused(standing([](auto&) {}, 0, -1), BOUGH_USAGE, "steps is -1");
    refused(standing([](auto& g) { g.position[0] = not_a_number; }), BOUGH_USAGE, "position: is not finite");
    refused(standing([](auto& g) { g.velocity[2] = infinity; }), BOUGH_USAGE, "velocity: is not finite");
    refused(standing([](auto& g) { g.angular_velocity[1] = not_a_number; }), BOUGH_USAGE,
            "angular_velocity: is not finite");
    refused(standing([](auto& g) { g.rotation[3] = 0; }), BOUGH_USAGE, "rotation is none");
    refused(standing([](auto& g) { g.rotation[0] = not_a_number; }), BOUGH_USAGE, "rotation is none");
    bough_step_error error;
    error.rms = -5;
    refused(bough_read_error(h.simulation, &error), BOUGH_USAGE, "is not watched");
    CHECK(error.rms == -5);                               // as it was
    CHECK(bough_step(h.simulation, nullptr) == BOUGH_OK); // unharmed
}
