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
    OK(bough_free(simulation));
}
