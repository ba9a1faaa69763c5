// files.h: the door's files.
#include "formats/files.h"
#include "formats/documents/motion.h"
#include "formats/error.h"
#include "formats/open.h"
#include "tests/support/make_tree.h"
#include "tests/support/random_documents.h"
#include "tests/support/simulations.h"
#include <catch2/catch.hpp>

using namespace bough;
using namespace simulations;
using bough::test::Folder;

TEST_CASE("a motion file holds what the simulation shows, and does not appear before it is whole") {
    const Folder folder;
    Simulation simulation(one(make_tree::branched(), "gusty"));
    const std::string file = folder / "motion.json";
    {
        MotionFile motion(file, simulation);
        simulation.step();
        motion.write(simulation);
    }
    CHECK_THROWS_AS(read_state(file), InputError); // nothing there
    std::vector<Vec3> shown;
    {
        MotionFile motion(file, simulation);
        for (int k = 0; k < 4; ++k) {
            simulation.step();
            motion.write(simulation);
            shown.assign(simulation.positions().begin(), simulation.positions().end());
        }
        motion.finish();
    }
    const Motion motion = read_motion(read_input(file), file);
    REQUIRE(motion.frame.size() == 4);
    CHECK(motion.header.fps == Approx(30));
    CHECK(apart(motion.frame[3].position, shown) < 1e-12);
    CHECK_THROWS_AS(MotionFile(folder / "motion.xyz", simulation), OutputError);
    CHECK_THROWS_WITH(grow("elm"), Catch::Contains("expected one of") && Catch::Contains("apple"));
    CHECK_THROWS_AS(read_scene(folder / "none.json"), InputError);
}

TEST_CASE("a motion file takes frames of its own run's bodies and fields alone") {
    const Folder folder;
    SimulationOptions fast;
    fast.velocities = true;
    Simulation written(one(make_tree::branched()), fast), slow(one(make_tree::branched()));
    Scene two = one(make_tree::branched());
    two.add(make_tree::branched(), Vec3(2, 0, 0));
    Simulation other(two, fast);
    const std::string file = folder / "motion.jsonl";
    MotionFile motion(file, written);
    motion.write(written);
    CHECK_THROWS_WITH(motion.write(other), Catch::Contains("bodies: the simulation has"));
    CHECK_THROWS_WITH(motion.write(slow), Catch::Contains("velocities: "));
    motion.finish();
    CHECK(read_motion(read_input(file), file).frame.size() == 1);
}

TEST_CASE("a scene that a program made moves as before, once written and read again") {
    const Folder folder;
    Scene made = one(make_tree::branched(), "gusty");
    made.add(made.trees[0].tree, Vec3(3, 0, 1), 90);
    for (const char* name : {"park.json", "park.safetensors"}) {
        for (Placement& place : made.trees) place.file.clear();
        CHECK_THROWS_WITH(write_scene(folder / name, made), Catch::Contains("/trees/0/file is empty, expected"));
        CHECK_THROWS_AS(read_scene(folder / name), InputError); // nothing there
        write_tree(folder / "tree.json", *made.trees[0].tree);
        for (Placement& place : made.trees) place.file = "tree.json";
        write_scene(folder / name, made);
        const Scene read = read_scene(folder / name);
        REQUIRE(read.trees.size() == 2);
        CHECK(read.trees[0].tree == read.trees[1].tree); // each file once
        Simulation before(made), after(read);
        CHECK(run(before, 5) == run(after, 5));
    }
}

TEST_CASE("a scene whose document changed the wood is not written as of the files that it was read from") {
    const Folder folder;
    write_tree(folder / "birch.json", convert(grow("birch", {.bodies = 300, .seed = 2})));
    {
        Output output(folder / "park.json");
        output.write(R"({"format": "bough-scene", "version": 1, "wind": "gusty", "material": {"E": 5e9},
            "trees": [{"file": "birch.json"}, {"file": "birch.json", "position": [3, 0, 1]}]})");
        output.finish();
    }
    Scene soft = read_scene(folder / "park.json");
    CHECK(soft.trees[0].tree == soft.trees[1].tree);
    soft.wind = wind_preset("storm");
    CHECK_THROWS_AS(write_scene(folder / "storm.json", soft), OutputError);
    CHECK_THROWS_WITH(write_scene(folder / "storm.json", soft), Catch::Contains("/trees/0/file is empty, expected"));
    write_tree(folder / "soft_birch.json", *soft.trees[0].tree);
    for (Placement& place : soft.trees) place.file = "soft_birch.json";
    write_scene(folder / "storm.json", soft);
    Simulation before(soft), after(read_scene(folder / "storm.json"));
    CHECK(run(before, 5) == run(after, 5));
}

TEST_CASE("a scene is not written where two trees have one file's name") {
    const Folder folder;
    Scene made = one(make_tree::branched());
    made.add(make_tree::chain(4, 2, 0.03, 0.01), Vec3(3, 0, 1));
    made.add(made.trees[0].tree, Vec3(6, 0, 1));
    for (Placement& place : made.trees) place.file = "tree.json";
    CHECK_THROWS_AS(write_scene(folder / "park.json", made), OutputError);
    CHECK_THROWS_WITH(write_scene(folder / "park.json", made),
                      Catch::Contains("/trees/1/file is 'tree.json', which /trees/0 names for another tree, expected"));
    made.trees[1].file = "chain.json";
    CHECK_NOTHROW(write_scene(folder / "park.json", made));
}

TEST_CASE("a motion file's rate is a number above 0, or 0 for that of the steps") {
    const Folder folder;
    Simulation simulation(one(make_tree::branched()));
    const std::string file = folder / "motion.json";
    for (const double fps : {-1.0, double(NAN), double(INFINITY), -double(INFINITY)}) {
        CHECK_THROWS_AS(MotionFile(file, simulation, fps), SceneError);
        CHECK_THROWS_WITH(MotionFile(file, simulation, fps),
                          Catch::StartsWith("fps: is ") &&
                              Catch::EndsWith("expected frames a second above 0, or 0 for one a step"));
    }
    MotionFile motion(file, simulation, 7.5);
    motion.write(simulation);
    motion.write(simulation);
    motion.finish();
    const Motion read = read_motion(read_input(file), file);
    CHECK(read.header.fps == 7.5);
    CHECK(read.frame[1].time == 1 / 7.5);
}

TEST_CASE("a motion file does not take what no float can say, as treesim does not") {
    const Folder folder;
    Scene scene = one(make_tree::branched()); // and a ball that flies away, in steps of aeons
    scene.gravity.setZero();
    Ball& ball = scene.balls.emplace_back();
    ball.position = Vec3(9, 9, 0);
    ball.velocity = Vec3(0, 1e15, 0);
    ball.radius = 0.1;
    ball.mass = 1;
    SimulationOptions o;
    o.step = 1e25;
    Simulation simulation(scene, o);
    const std::size_t body = simulation.bodies() - 1;
    const std::string file = folder / "motion.json";
    MotionFile motion(file, simulation, 30);
    motion.write(simulation);
    const Simulation begun = simulation.copy();
    REQUIRE(simulation.step().finite());
    REQUIRE(simulation.positions()[body].y() > 1e39);
    CHECK_THROWS_AS(motion.write(simulation), OutputError);
    CHECK_THROWS_WITH(motion.write(simulation),
                      Catch::StartsWith(file + ": frame 1: the position of body 14 comes to ") &&
                          Catch::EndsWith("expected at most 3.4e38, as a float can say"));
    motion.write(begun); // what was refused is not there
    motion.finish();
    CHECK(read_motion(read_input(file), file).frame.size() == 2);
}

TEST_CASE("splines that a program made and that hold no tree are refused before they are cut") {
    const Splines good = grow("apple", {.bodies = 60});
    CHECK(convert(good).size_bodies() > 0);
    const auto refusal = [&](const auto& change) {
        Splines bad = good;
        change(bad);
        try {
            convert(bad);
        } catch (const SceneError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(refusal([](Splines& s) { s.parent[1] = 99999; }).find("splines: /parent/1: is 99999") == 0);
    CHECK(refusal([](Splines& s) { s.radius[2] = NAN; }).find("splines: /radius/2: ") == 0);
    CHECK(refusal([](Splines& s) { s.first_point[1] = 1000000; }).find("splines: /first_point/2: ") == 0);
    CHECK(refusal([](Splines& s) { s = Splines(); }).find("splines: /parent: is empty") == 0);
}
