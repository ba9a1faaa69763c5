// What a run says of itself through bough_c.h: its plan, what broke, what is thrown, its trees as they stand. Against the scene's document and the door.
#include "formats/files.h"
#include "tests/support/c_misuse.h"
#include "tests/support/c_support.h"

using namespace bough;
using namespace bough::test;

namespace {

// A birch of 300 bodies in a scene's document, which names one file.
bough_simulation* birch_in(const std::string& document) {
    bough_tree* const tree = birch();
    bough_scene* const scene = scene_of(document);
    OK(bough_scene_put(scene, 0, tree));
    bough_simulation* const simulation = simulation_of(scene);
    OK(bough_free(tree));
    OK(bough_free(scene));
    return simulation;
}

constexpr const char* thrown_at = R"({"format": "bough-scene", "version": 1, "trees": [{"file": "t"}], "wind": "breeze",
    "fracture": {"leaf": 1e-9}, "balls": [{"position": [3, 9, 0], "radius": 0.2, "mass": 2},
    {"position": [0, 8, 4], "velocity": [0, 1, -2], "radius": 0.1, "mass": 0.5}]})";

} // namespace

TEST_CASE("a run's plan is told to C as to C++, with the step that it has by now") {
    bough_simulation* const simulation = in_wind("gusty", bough_default_settings());
    Scene scene;
    scene.add(convert(grow("birch", {.bodies = 300, .seed = 2, .age = 8, .leaves = true})));
    scene.wind = wind_preset("gusty");
    Simulation own(scene, {});
    const std::string before = bough_explain(simulation);
    CHECK(before == own.explain());
    CHECK(before.find("solver coupled") != std::string::npos);
    OK(bough_set_step(simulation, 0.01));
    own.set_step(0.01);
    CHECK(bough_explain(simulation) == own.explain());
    CHECK(bough_explain(simulation) != before);
    OK(bough_free(simulation));
}

TEST_CASE("what is thrown at trees is what the document throws, and stands behind their bodies") {
    bough_simulation* const simulation = birch_in(thrown_at);
    bough_balls balls;
    bough_bodies bodies;
    OK(bough_simulation_balls(simulation, &balls));
    OK(bough_simulation_bodies(simulation, &bodies));
    REQUIRE(balls.count == 2);
    CHECK(balls.first == bodies.count);
    CHECK(balls.radius[0] == 0.2);
    CHECK(balls.radius[1] == 0.1);
    CHECK(balls.mass[0] == 2);
    CHECK(balls.mass[1] == 0.5);
    bough_array x = array(simulation, BOUGH_POSITION);
    REQUIRE(x.count == balls.first + balls.count);
    CHECK(Vec3(x.data + 3 * balls.first) == Vec3(3, 9, 0));
    CHECK(Vec3(x.data + 3 * balls.first + 3) == Vec3(0, 8, 4));
    const double* const radius = balls.radius;
    steps(simulation, 3);
    x = array(simulation, BOUGH_POSITION);
    CHECK(x.data[3 * balls.first + 1] < 9); // it falls
    OK(bough_simulation_balls(simulation, &balls));
    CHECK(balls.radius == radius); // as long as the simulation
    OK(bough_free(simulation));

    bough_simulation* const none = in_wind("calm", bough_default_settings());
    OK(bough_simulation_balls(none, &balls));
    CHECK(balls.count == 0);
    OK(bough_free(none));
}

TEST_CASE("what broke since the start is what the steps' events said, in their order") {
    bough_simulation* const simulation = birch_in(thrown_at);
    const std::uint32_t* broken = nullptr;
    std::size_t count = 9;
    OK(bough_read_broken(simulation, &broken, &count));
    CHECK(count == 0);
    std::vector<std::uint32_t> said;
    for (int k = 0; k < 8; ++k) {
        steps(simulation, 1);
        bough_events events;
        OK(bough_read_events(simulation, &events));
        for (std::size_t i = 0; i < events.count; ++i)
            if (events.what[i] == BOUGH_BROKE) said.push_back(std::uint32_t(events.body[i]));
    }
    OK(bough_read_broken(simulation, &broken, &count));
    REQUIRE(!said.empty());
    CHECK(std::vector(broken, broken + count) == said);
    bough_tree* tree = nullptr;
    refused(bough_posed_tree(simulation, &tree), BOUGH_USAGE, "joints broke in this run");
    CHECK(tree == nullptr);
    OK(bough_free(simulation));
}

TEST_CASE("a tree as it stands is drawn so, and stays so") {
    bough_simulation* const simulation = in_wind("storm", bough_default_settings());
    const bough_array drawn = array(simulation, BOUGH_POSITION);
    const std::vector<double> first(drawn.data, drawn.data + 3 * drawn.count);
    steps(simulation, 25);
    const bough_array x = array(simulation, BOUGH_POSITION);
    const std::vector<double> stands(x.data, x.data + 3 * x.count);
    const auto off = [](const std::vector<double>& a, const double* b) {
        double most = 0;
        for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
        return most;
    };
    CHECK(off(first, x.data) > 0.01); // it does bend
    bough_tree* tree = nullptr;
    OK(bough_posed_tree(simulation, &tree));
    bough_scene* const still = scene_of("");
    OK(bough_scene_add(still, tree, nullptr, 0));
    bough_simulation* const again = simulation_of(still);
    REQUIRE(array(again, BOUGH_POSITION).count == x.count);
    CHECK(off(stands, array(again, BOUGH_POSITION).data) < 1e-9);
    steps(again, 30);
    CHECK(off(stands, array(again, BOUGH_POSITION).data) < 1e-6);
    for (void* handle : {(void*)simulation, (void*)tree, (void*)still, (void*)again}) OK(bough_free(handle));
}
