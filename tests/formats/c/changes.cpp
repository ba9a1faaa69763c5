// What bough_c.h changes in a run, ground and step, and the step's error: against the C++ door, and what is refused without its setting.
#include "formats/files.h"
#include "lib/simulation/run_error.h"
#include "tests/support/c_support.h"

using namespace bough;
using namespace bough::test;

namespace {

Simulation own_in_wind(const char* wind, const SimulationOptions& options) {
    Scene scene;
    scene.add(convert(grow("birch", {.bodies = 300, .seed = 2, .age = 8, .leaves = true})));
    scene.wind = wind_preset(wind);
    return Simulation(scene, options);
}

} // namespace

TEST_CASE("a ground that C moves is the door's, and one that was not asked for is refused") {
    bough_settings settings = bough_default_settings();
    settings.grounds = 1;
    bough_simulation* const simulation = in_wind("breeze", settings);
    Simulation own = own_in_wind("breeze", {.grounds = true});
    for (int k = 0; k < 8; ++k) {
        bough_ground to = bough_default_ground();
        to.position[0] = 0.02 * k;
        to.rotation[2] = std::sin(0.01 * k);
        to.rotation[3] = std::cos(0.01 * k);
        to.velocity[0] = 0.6;
        to.angular_velocity[2] = 0.6;
        OK(bough_set_ground(simulation, 0, &to, 2));
        own.set_ground(
            0, {{0.02 * k, 0, 0}, Quat(std::cos(0.01 * k), 0, 0, std::sin(0.01 * k)), {0.6, 0, 0}, {0, 0, 0.6}}, 2);
        OK(bough_step(simulation, nullptr));
        own.step();
    }
    CHECK(hash(simulation) == own.hash());
    bough_array x;
    OK(bough_read(simulation, BOUGH_POSITION, &x));
    CHECK(Vec3(x.data) == own.positions()[0]);
    CHECK(x.data[0] > 0.05); // the root goes along
    OK(bough_free(simulation));

    bough_simulation* const fixed = in_wind("breeze", bough_default_settings());
    const bough_ground ground = bough_default_ground();
    CHECK(bough_set_ground(fixed, 0, &ground, 1) == BOUGH_USAGE);
    CHECK(std::string(bough_error()).find("grounds is not set") != std::string::npos);
    OK(bough_free(fixed));
}

TEST_CASE("steps that C changes are the door's, and their time goes on") {
    bough_simulation* const simulation = in_wind("gusty", bough_default_settings());
    Simulation own = own_in_wind("gusty", {});
    bough_report report;
    for (const double step : {1 / 60.0, 0.02, 1 / 60.0}) {
        OK(bough_set_step(simulation, step));
        own.set_step(step);
        OK(bough_step(simulation, &report));
        own.step();
    }
    CHECK(report.steps == 3);
    CHECK(report.time == Approx(1 / 30.0 + 0.02));
    CHECK(hash(simulation) == own.hash());
    OK(bough_free(simulation));
}

TEST_CASE("the error that C reads is the door's, from where it is watched on") {
    bough_simulation* const simulation = in_wind("storm", bough_default_settings());
    Simulation own = own_in_wind("storm", {});
    OK(bough_step(simulation, nullptr));
    own.step();
    OK(bough_watch_error(simulation, 1));
    RunError error(own);
    const double down[3] = {0.5, -9, 0};
    for (int k = 0; k < 10; ++k) {
        if (k == 4) { // what is changed on the way the companion has too
            OK(bough_set_gravity(simulation, down));
            OK(bough_set_wood(simulation, 0.8, 1.1));
            own.set_gravity(Vec3(down));
            own.set_wood(0.8, 1.1);
        }
        OK(bough_step(simulation, nullptr));
        error.lead();
        own.step();
        error.follow();
    }
    bough_step_error found;
    OK(bough_read_error(simulation, &found));
    const TipError wanted = error.result();
    CHECK(found.rms == wanted.rms);
    CHECK(found.worst == wanted.worst);
    CHECK(found.deflection == wanted.deflection);
    CHECK(found.steps == 10);
    CHECK((found.known != 0) == wanted.known());
    CHECK(found.rms > 0);
    CHECK(found.worst > found.rms);
    CHECK(hash(simulation) == own.hash()); // the run is none the worse

    std::size_t size = 0;
    OK(bough_save(simulation, nullptr, 0, &size));
    std::string state(size, 0);
    OK(bough_save(simulation, state.data(), size, &size));
    OK(bough_restore(simulation, state.data(), size, nullptr));
    OK(bough_read_error(simulation, &found));
    CHECK(found.steps == 0); // begun anew
    OK(bough_watch_error(simulation, 0));
    CHECK(bough_read_error(simulation, &found) == BOUGH_USAGE);
    OK(bough_free(simulation));

    bough_settings settings = bough_default_settings();
    settings.method = BOUGH_ANALYTIC;
    bough_simulation* const analytic = in_wind("gusty", settings);
    CHECK(bough_watch_error(analytic, 1) == BOUGH_USAGE);
    CHECK(std::string(bough_error()).find("coupled method") != std::string::npos);
    OK(bough_free(analytic));
}
