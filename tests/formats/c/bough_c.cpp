// bough_c.h against the C++ door: the same trees, the same motion, what was written read by the other.
#include "formats/documents/motion.h"
#include "formats/documents/tree.h"
#include "formats/files.h"
#include "lib/simulation/pick.h"
#include "tests/support/c_support.h"
#include "tests/support/random_documents.h"
#include <cstring>

using namespace bough;
using namespace bough::test;

namespace {

Tree own_birch() {
    return convert(grow("birch", {.bodies = 300, .seed = 2, .age = 8, .leaves = true}));
}

Scene own_scene(const char* wind) {
    Scene scene;
    scene.add(own_birch());
    scene.wind = wind ? *wind_preset(wind) : Wind();
    return scene;
}

template <class Numbers> bool same(const bough_array& a, std::span<const Numbers> b) {
    return a.count == b.size() && a.components * sizeof(double) == sizeof(Numbers) && a.stride == sizeof(Numbers) &&
           std::memcmp(a.data, b.data(), b.size() * sizeof(Numbers)) == 0;
}

} // namespace

TEST_CASE("a run through C is that of the C++ door, bit by bit, in all fields") {
    const std::int32_t precision = GENERATE(0, 1);
    const std::int32_t method = GENERATE(0, 1);
    bough_settings settings = bough_default_settings();
    settings.step = 1 / 24.;
    settings.precision = precision;
    settings.method = method;
    settings.velocities = settings.torques = settings.stresses = 1;
    bough_simulation* const simulation = in_wind("gusty", settings);

    SimulationOptions o;
    o.step = 1 / 24.;
    o.precision = precision == BOUGH_FLOAT ? Precision::single : Precision::double_;
    o.method = method == BOUGH_COUPLED ? Method::coupled : Method::analytic;
    o.velocities = o.torques = o.stresses = true;
    Simulation own(own_scene("gusty"), o);
    const double* const at = array(simulation, BOUGH_POSITION).data;
    for (int k = 1; k <= 12; ++k) {
        bough_report report;
        OK(bough_step(simulation, &report));
        const StepReport said = own.step();
        CHECK(report.steps == k);
        CHECK(report.time == Approx(k / 24.));
        CHECK(report.fast_turns == said.fast_turns);
        CHECK(report.guarded == said.guarded);
        CHECK(same(array(simulation, BOUGH_POSITION), own.positions()));
        CHECK(same(array(simulation, BOUGH_ROTATION), own.rotations()));
        CHECK(same(array(simulation, BOUGH_VELOCITY), own.velocities()));
        CHECK(same(array(simulation, BOUGH_ANGULAR_VELOCITY), own.angular_velocities()));
        CHECK(same(array(simulation, BOUGH_ANGLE), own.angles()));
        CHECK(same(array(simulation, BOUGH_RATE), own.rates()));
        CHECK(same(array(simulation, BOUGH_TORQUE), own.torques()));
        CHECK(same(array(simulation, BOUGH_STRESS), own.stresses()));
    }
    CHECK(array(simulation, BOUGH_POSITION).data == at); // stays where it is
    CHECK(hash(simulation) == own.hash());
    OK(bough_free(simulation));
}

TEST_CASE("a run through C settles into the wind as the door's does, and only at its start") {
    bough_simulation* const simulation = in_wind("gusty", bough_default_settings());
    Simulation own(own_scene("gusty"), {});
    double seconds = -1;
    OK(bough_settling_time(simulation, &seconds));
    CHECK(seconds == own.settling_time());
    CHECK(seconds >= 2);
    OK(bough_settle(simulation, seconds));
    REQUIRE(own.settle(seconds).finite());
    CHECK(hash(simulation) == own.hash());
    OK(bough_step(simulation, nullptr));
    CHECK(bough_settle(simulation, 1) == BOUGH_USAGE);
    CHECK(bough_settle(simulation, -1) == BOUGH_USAGE);
    OK(bough_free(simulation));
}

TEST_CASE("bodies and documents are those of the C++ door") {
    const Tree own = own_birch();
    bough_tree* const tree = birch();
    bough_bodies bodies;
    OK(bough_tree_bodies(tree, &bodies));
    REQUIRE(bodies.count == own.size_bodies());
    CHECK(bodies.trees == 1);
    CHECK(bodies.first_body[1] == bodies.count);
    for (std::size_t i = 0; i < bodies.count; ++i) {
        CHECK(bodies.parent[i] == own.parent[i]);
        CHECK(bodies.kind[i] == (own.kind[i] == Kind::branch ? BOUGH_BRANCH : BOUGH_LEAF));
        CHECK(Vec3(bodies.size[i]) == own.size[i]);
        CHECK(bodies.mass[i] == own.mass[i]);
        CHECK(Vec3(bodies.com[i]) == own.com[i]);
        CHECK(Vec3(bodies.stiffness[i]) == own.stiffness[i]);
        CHECK(bodies.damping[i] == own.damping[i]);
        CHECK(bodies.branch[i] == own.branch[i]);
        CHECK(bodies.level[i] == own.level[i]);
    }
    // Written here and read there; a buffer that is one byte short keeps to its length.
    std::size_t size = 0, needed = 0;
    OK(bough_write_tree(tree, nullptr, 0, &size));
    std::string bytes(size, 0);
    bytes.back() = 7;
    CHECK(bough_write_tree(tree, bytes.data(), size - 1, &needed) == BOUGH_OUTPUT);
    CHECK(needed == size);
    CHECK(bytes.back() == 7);
    CHECK(std::string(bough_error()).find("takes " + std::to_string(size) + " bytes") != std::string::npos);
    OK(bough_write_tree(tree, bytes.data(), size, &size));
    const test::Folder folder;
    write_tree(folder / "own.safetensors", own);
    CHECK(bytes == read_input(folder / "own.safetensors"));
    bough_tree* again = nullptr;
    OK(bough_read_tree(bytes.data(), bytes.size(), nullptr, &again));
    bough_bodies read;
    OK(bough_tree_bodies(again, &read));
    CHECK(read.count == bodies.count);
    CHECK(std::memcmp(read.size, bodies.size, bodies.count * sizeof *bodies.size) == 0);

    // Other wood, longer pieces: as segment() makes them.
    const Splines splines = grow("birch", {.bodies = 300, .seed = 2, .age = 8, .leaves = true});
    write_splines(folder / "s.safetensors", splines);
    const std::string document = read_input(folder / "s.safetensors");
    bough_splines* read_back = nullptr;
    OK(bough_read_splines(document.data(), document.size(), "s", &read_back));
    bough_conversion conversion = bough_default_conversion();
    conversion.material = "northern-red-oak";
    conversion.segment_length = 0.5;
    conversion.max_bend = 0.6;
    bough_tree* oak = nullptr;
    OK(bough_convert(read_back, &conversion, &oak));
    SegmentOptions options;
    options.segment_length = 0.5;
    options.max_bend = 0.6;
    const Tree same = segment(splines, *find_wood("northern-red-oak"), options);
    OK(bough_tree_bodies(oak, &bodies));
    REQUIRE(bodies.count == same.size_bodies());
    CHECK(std::memcmp(bodies.stiffness, same.stiffness.data(), bodies.count * sizeof(Vec3)) == 0);
    for (void* handle : {(void*)tree, (void*)again, (void*)read_back, (void*)oak}) OK(bough_free(handle));
}

TEST_CASE("a scene document's places take trees, and what it says acts") {
    const std::string document = R"({"format": "bough-scene", "version": 1, "wind": "gusty", "material": {"E": 5e9},
        "trees": [{"file": "birch.tree.json"}, {"file": "other.tree.json", "position": [20, 0, 0], "yaw": 90}],
        "fracture": {"leaf": 1e-9, "seed": 3}})";
    bough_scene* const scene = scene_of(document);
    CHECK(std::string(bough_scene_file(scene, 0)) == "birch.tree.json");
    CHECK(std::string(bough_scene_file(scene, 1)) == "other.tree.json");
    CHECK(bough_scene_file(scene, 2) == nullptr);
    bough_tree* const tree = birch();
    OK(bough_scene_put(scene, 0, tree));
    bough_simulation* simulation = nullptr;
    CHECK(bough_simulate(scene, nullptr, nullptr, &simulation) == BOUGH_USAGE);
    CHECK(std::string(bough_error()).find("place 1 (other.tree.json) has no tree yet") != std::string::npos);
    OK(bough_scene_put(scene, 1, tree));
    const double place[3] = {0, 0, 15};
    OK(bough_scene_add(scene, tree, place, 45));
    simulation = simulation_of(scene);

    const test::Folder folder;
    write_tree(folder / "birch.tree.json", own_birch());
    write_tree(folder / "other.tree.json", own_birch());
    {
        Output output(folder / "scene.json");
        output.write(document);
        output.finish();
    }
    Scene own = read_scene(folder / "scene.json");
    own.add(own.trees[0].tree, {0, 0, 15}, 45);
    Simulation there(own);
    bough_bodies bodies;
    OK(bough_simulation_bodies(simulation, &bodies));
    REQUIRE(bodies.trees == 3);
    CHECK(bodies.count == there.tree().size_bodies());
    for (std::size_t k = 0; k < 3; ++k) CHECK(bodies.first_body[k] == there.trees()[k].first_body);
    CHECK(bodies.first_body[3] == bodies.count);
    std::uint64_t broke = 0;
    for (int k = 0; k < 5; ++k) {
        bough_report report;
        bough_events events;
        OK(bough_step(simulation, &report));
        there.step();
        OK(bough_read_events(simulation, &events));
        const MotionEvents& own_events = there.events();
        REQUIRE(events.count == own_events.what.size());
        for (std::size_t i = 0; i < events.count; ++i) {
            CHECK(own_events.what[i] == std::array{"broke", "hit", "landed", "leapt"}[std::size_t(events.what[i])]);
            CHECK(events.body[i] == own_events.body[i]);
            CHECK(events.on[i] == own_events.on[i]);
            CHECK(events.value[i] == own_events.value[i]);
        }
        broke += report.broke;
    }
    CHECK(broke > 0);
    CHECK(hash(simulation) == there.hash());
    for (void* handle : {(void*)tree, (void*)scene, (void*)simulation}) OK(bough_free(handle));
}

TEST_CASE("what changes in a run changes it as the C++ door does") {
    bough_settings settings = bough_default_settings();
    settings.pulls = 1;
    bough_simulation* const simulation = in_wind(nullptr, settings);
    SimulationOptions o;
    o.pulls = true;
    Simulation own(own_scene(nullptr), o);
    bough_wind wind;
    OK(bough_wind_preset("storm", &wind));
    wind.velocity[2] = 3;
    wind.seed = 9;
    OK(bough_set_wind(simulation, &wind));
    Wind same = *wind_preset("storm");
    same.velocity.z() = 3;
    same.seed = 9;
    own.set_wind(same);
    const double gravity[3] = {1, -8, 0};
    OK(bough_set_gravity(simulation, gravity));
    own.set_gravity({1, -8, 0});
    OK(bough_set_wood(simulation, 0.7, 1.5));
    own.set_wood(0.7, 1.5);
    steps(simulation, 3);
    for (int k = 0; k < 3; ++k) own.step();
    const double eye[3] = {0, 1, 30}, ahead[3] = {0, 0, -2};
    bough_hit hit;
    std::int32_t found = 0;
    OK(bough_pick(simulation, eye, ahead, 0.3, &hit, &found));
    const std::optional<RayHit> own_hit = pick(own, {{0, 1, 30}, {0, 0, -2}, 0.3});
    REQUIRE(found == 1);
    REQUIRE(own_hit);
    CHECK(hit.body == own_hit->body);
    CHECK(Vec3(hit.point) == own_hit->point);
    CHECK(Vec3(hit.world) == own_hit->world);
    CHECK(hit.distance == own_hit->distance);
    const double force[3] = {40, 0, 5}, behind[3] = {0, 0, 2};
    hit.distance = -5;
    OK(bough_pick(simulation, eye, behind, 0, &hit, &found));
    CHECK(found == 0);
    CHECK(hit.distance == -5); // as it was
    for (int k = 0; k < 4; ++k) {
        OK(bough_pull(simulation, hit.body, hit.point, force));
        own.pull(hit.body, own_hit->point, {40, 0, 5});
        steps(simulation, 1);
        own.step();
    }
    CHECK(hash(simulation) == own.hash());
    std::uint64_t hand = 0;
    OK(bough_attach(simulation, hit.body, hit.point, 300, 2, &hand));
    CHECK(hand == own.attach(hit.body, own_hit->point, 300, 2));
    for (int k = 1; k < 5; ++k) {
        const double target[3] = {hit.world[0] + 0.1 * k, hit.world[1], hit.world[2]};
        OK(bough_move_attachment(simulation, hand, target, 1));
        own.move_attachment(hand, Vec3(target), 1);
        steps(simulation, 1);
        own.step();
    }
    double held[3];
    OK(bough_attachment_force(simulation, hand, held));
    CHECK(Vec3(held) == own.attachment_force(hand));
    CHECK(Vec3(held).norm() > 0);
    CHECK(hash(simulation) == own.hash());
    OK(bough_release(simulation, hand));
    own.release(hand);
    steps(simulation, 2);
    own.step(2);
    CHECK(hash(simulation) == own.hash());
    OK(bough_free(simulation));
}

TEST_CASE("a state goes on bit by bit, and is treesim's document; another run's is refused") {
    bough_settings settings = bough_default_settings();
    settings.precision = BOUGH_FLOAT;
    bough_simulation* const whole = in_wind("gusty", settings);
    bough_simulation* const second = in_wind("gusty", settings);
    steps(whole, 10);
    const std::string state = saved(whole);
    steps(whole, 10);
    OK(bough_restore(second, state.data(), state.size(), "state"));
    steps(second, 10);
    CHECK(hash(second) == hash(whole));

    SimulationOptions o;
    o.precision = Precision::single;
    Simulation own(own_scene("gusty"), o);
    own.restore(read_state(state, "state"));
    for (int k = 0; k < 10; ++k) own.step();
    CHECK(hash(second) == own.hash());

    bough_simulation* const other = in_wind("breeze", settings);
    const std::uint64_t before = hash(other);
    CHECK(bough_restore(other, state.data(), state.size(), "a state") == BOUGH_INPUT);
    CHECK(std::string(bough_error()).rfind("a state: /fingerprint", 0) == 0);
    CHECK(bough_restore(other, state.data(), state.size() / 2, nullptr) == BOUGH_INPUT);
    CHECK(std::string(bough_error()).rfind("<memory>: ", 0) == 0);
    CHECK(hash(other) == before);

    // A run begun again in other wind goes on with the motion.
    bough_scene* const scene = scene_of("");
    bough_tree* const tree = birch();
    OK(bough_scene_add(scene, tree, nullptr, 0));
    bough_simulation* const after = simulation_of(scene, &settings, whole);
    Scene still;
    still.add(own_birch());
    const Simulation own_after(still, o, own);
    CHECK(hash(after) == own_after.hash());
    CHECK(same(array(after, BOUGH_ANGLE), own_after.angles()));
    for (void* handle : {(void*)whole, (void*)second, (void*)other, (void*)scene, (void*)tree, (void*)after})
        OK(bough_free(handle));
}
