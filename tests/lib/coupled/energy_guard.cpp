// The energy guard (energy_guard.h): no step gives what flails energy, its factors leave what there may be, and lanes take what the plain path takes.
// (In a wind that varies over the ground: tests/lib/laws/wind_field_steps.cpp. What it leaves of true motion: tests/lib/study/stability.cpp.)
#include "lib/coupled/energy_guard.h"
#include "lib/study/energy.h"
#include "tests/support/lanes_support.h"

using namespace bough;
using namespace lanes;

TEST_CASE(
    "a tree that flails without a load has no more energy after a step than before, but for the balance's error") {
    for (const Scheme scheme : {Scheme::p12, Scheme::p34})
        for (const Simd& simd : {Simd(), Simd(fast::best_target())})
            for (const double rate : {5.0, 40.0}) {
                Case c{"", grown(600), solver::empty_scene(), 0.05, rate};
                c.scene.damping_scale = 0; // which would hide what the step brings in
                LanesRun<> run(c, simd, scheme);
                const auto energies = [&] { return energy(run.plan, run.state); };
                double gained = 0;
                Energy before = energies();
                for (int k = 0; k < 30; ++k) {
                    run.frame();
                    const Energy now = energies();
                    gained = std::max(gained, (now.bodies + now.elastic - before.bodies - before.elastic) / now.bodies);
                    before = now;
                }
                CAPTURE(int(scheme), simd.has_value(), rate, gained);
                CHECK(run.state.flags.energy_guard > 0);
                CHECK(gained < 2e-3); // 1/1000 of the kinetic energy is let be
            }
}

TEST_CASE(
    "the factors leave as much kinetic energy as there may be, and take it from what turns fast where that is enough") {
    const auto settled = [](double kinetic, double gained, double slow, double mixed, double fast,
                            bool foliage = false) {
        EnergyAccount a;
        a.watched = a.wood = true;
        a.kinetic = kinetic;
        a.gained = gained;
        a.slow = slow;
        a.mixed = mixed;
        a.fast = fast;
        settle(a, foliage);
        return a;
    };
    const auto left = [](const EnergyAccount& a) {
        const double x = a.keep_fast, y = a.keep_slow;
        return y * y * a.slow + 2 * x * y * a.mixed + x * x * a.fast;
    };
    // 4.5 J at the end, of 2 J and 0.5 J of work: from what turns fast alone.
    const EnergyAccount enough = settled(2, -0.5, 1, 0.25, 3);
    CHECK(enough.keep_slow == 1);
    CHECK((enough.keep_fast > 0 && enough.keep_fast < 1));
    CHECK(left(enough) == Approx(2.5).epsilon(1e-12));
    const EnergyAccount against = settled(2, 0, 1.5, -0.5, 4); // what turns fast goes against the rest
    CHECK(against.keep_slow == 1);
    CHECK(left(against) == Approx(2).epsilon(1e-12));
    // Where it is not enough, from all.
    const EnergyAccount all = settled(2, 0, 5, 0, 1);
    CHECK(all.keep_fast == 0);
    CHECK(all.keep_slow == Approx(std::sqrt(0.4)).epsilon(1e-12));
    CHECK(left(all) == Approx(2).epsilon(1e-12));
    // With foliage only where what turns fast has a hundredth of it.
    CHECK(settled(2, 0, 5, 0, 0.04, true).keep_slow == 1);
    CHECK(settled(2, 0, 5, 0, 0.04, true).keep_fast == 0);
    CHECK(settled(2, 0, 5, 0, 0.06, true).keep_slow < 1);
    CHECK(settled(2, 0, 5, 0, 0.04, false).keep_slow < 1);
    // Nothing is taken of less than a thousandth, or where there is no excess.
    for (const EnergyAccount& none : {settled(2, 0, 1, 0, 1.0019), settled(2, 0, 1, 0, 0.5), settled(2, -3, 2, 0, 2)}) {
        CHECK(none.keep_fast == 1);
        CHECK(none.keep_slow == 1);
    }
    CHECK(settled(2, 0, 1, 0, 1.0021).keep_fast < 1);
}

TEST_CASE("the energy guard takes in lanes what it takes on the plain path") {
    for (const bool windy : {false, true}) {
        Case c{"", grown(600), solver::empty_scene(), 0.05, 5};
        if (windy) c.scene.wind = gusts();
        LanesRun<> plain(c, std::nullopt), lanes(c, fast::best_target());
        const Apart d = run_apart(plain, lanes, 5);
        CAPTURE(windy);
        REQUIRE(plain.state.flags.energy_guard > 0);
        CHECK(lanes.state.flags.energy_guard == plain.state.flags.energy_guard);
        CHECK(d.theta < 1e-9); // measured: 5e-11, which fast turning multiplies from step to step
        CHECK(d.theta_dot < 1e-7);
    }
}
