// bough_c.h: what stays where it is, and whose a message and a simulation are.
#include "tests/support/c_support.h"
#include <atomic>
#include <thread>

using namespace bough::test;

TEST_CASE("arrays stay where they are, with balls and held joints too") {
    bough_tree* const tree = birch(false);
    for (
        const char* const document :
        {R"({"format": "bough-scene", "version": 1, "trees": [{"file": "t"}], "balls": [{"position": [0, 9, 0], "radius": 0.2, "mass": 2}]})",
         R"({"format": "bough-scene", "version": 1, "trees": [{"file": "t"}], "wind": "gusty", "simulate": {"radius": 0.01}})"}) {
        bough_scene* const scene = scene_of(document);
        OK(bough_scene_put(scene, 0, tree));
        bough_settings settings = bough_default_settings();
        settings.velocities = 1;
        bough_simulation* const simulation = simulation_of(scene, &settings);
        std::vector<const double*> first;
        for (int k = 0; k < 20; ++k) {
            std::vector<const double*> now;
            for (const bough_field field : {BOUGH_POSITION, BOUGH_ROTATION, BOUGH_VELOCITY, BOUGH_ANGULAR_VELOCITY})
                now.push_back(array(simulation, field).data);
            if (k == 0) first = now;
            CHECK(now == first);
            if (k == 10) {
                const std::string state = saved(simulation);
                OK(bough_restore(simulation, state.data(), state.size(), nullptr));
            }
            steps(simulation, 1);
        }
        OK(bough_free(scene));
        OK(bough_free(simulation));
    }
    OK(bough_free(tree));
}

TEST_CASE("each thread has its own message, and one simulation one caller") {
    CHECK(bough_free(reinterpret_cast<void*>(std::uintptr_t(2))) == BOUGH_USAGE);
    const std::string here = bough_error();
    bough_settings settings = bough_default_settings();
    bough_simulation* const simulation = in_wind("gusty", settings);
    std::string there;
    std::thread([&] { there = bough_error(); }).join();
    CHECK(there.empty());
    // While one thread does nothing but step, another asks until it comes in between: that is sooner or later, and then it is refused.
    std::atomic<bool> enough = false;
    std::int64_t taken = 0;
    std::thread stepping([&] {
        for (; !enough; ++taken)
            if (bough_step(simulation, nullptr) != BOUGH_OK) --taken;
    });
    bough_result result = BOUGH_OK;
    for (int k = 0; k < 1'000'000 && result == BOUGH_OK; ++k) {
        std::uint64_t value;
        result = bough_hash(simulation, &value);
    }
    enough = true;
    stepping.join();
    CHECK(result == BOUGH_USAGE);
    CHECK(bough_error() == std::string("simulation: another call is using it; one thread at a time may"));
    bough_report report;
    OK(bough_step(simulation, &report));
    CHECK(report.steps == taken + 1);
    CHECK(bough_free(reinterpret_cast<void*>(std::uintptr_t(2))) == BOUGH_USAGE);
    CHECK(here == bough_error());
    CHECK(bough_abi() == BOUGH_ABI);
    CHECK_THAT(bough_version(), Catch::Matches("[0-9]+\\.[0-9]+\\.[0-9]+"));
    OK(bough_free(simulation));
}

TEST_CASE("an attachment's number is its simulation's, which never gives it twice") {
    bough_simulation* const one = in_wind("breeze", bough_default_settings());
    bough_simulation* const other = in_wind("breeze", bough_default_settings());
    const double point[3] = {0, 0, 0}, target[3] = {0, 1, 0};
    double force[3];
    std::uint64_t first = 0, second = 0, third = 0;
    steps(one, 2);
    const std::string state = saved(one);
    OK(bough_attach(one, 5, point, 10, 1, &first));
    OK(bough_attach(one, 6, point, 10, 1, &second));
    CHECK(bough_move_attachment(other, first, target, 1) == BOUGH_USAGE);
    CHECK(std::string(bough_error()).find("is not there") != std::string::npos);
    CHECK(bough_attachment_force(other, second, force) == BOUGH_USAGE);
    CHECK(bough_release(other, second) == BOUGH_USAGE);
    OK(bough_attachment_force(one, first, force)); // as it was
    OK(bough_release(one, second));
    OK(bough_restore(one, state.data(), state.size(), nullptr));
    OK(bough_attach(one, 6, point, 10, 1, &third));
    CHECK(third != first);
    CHECK(third != second);
    CHECK(bough_release(one, second) == BOUGH_USAGE);
    OK(bough_free(one));
    OK(bough_free(other));
}
