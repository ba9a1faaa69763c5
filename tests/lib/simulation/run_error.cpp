// run_error.h: the error's estimate while things are changed: against runs that began so, and against the same run at a quarter of the step by hand.
#include "lib/simulation/run_error.h"
#include "tests/support/simulations.h"

using namespace bough;
using namespace simulations;

TEST_CASE("the estimate has what is changed while it goes on: it is that of a run which began so") {
    // The wood, the gravity and the wind of the first run are changed before its first step; a hand takes hold in both, and is moved.
    for (const bool portable : {false, true}) {
        Scene before = one(leafy(), "breeze"), after = one(leafy(), "storm");
        SimulationOptions o = {.portable = portable};
        o.pulls = true;
        Simulation changed(before, o), begun(after, o);
        RunError of_changed(changed), of_begun(begun);
        changed.set_wind(*wind_preset("storm"));
        Simulation* const both[] = {&changed, &begun};
        std::uint64_t hand[2];
        for (int k = 0; k < 2; ++k) hand[k] = both[k]->attach(20, Vec3::Zero(), 50, 1);
        for (int step = 0; step < 30; ++step) {
            for (int k = 0; k < 2; ++k) {
                const Vec3 there = both[k]->positions()[20];
                if (step < 20) both[k]->move_attachment(hand[k], there + Vec3(0.01, 0, 0.01), 2);
                if (step == 20) both[k]->release(hand[k]);
                both[k]->pull(30, Vec3::Zero(), Vec3(0, 0.01, 0));
            }
            of_changed.lead();
            of_begun.lead();
            changed.step();
            begun.step();
            of_changed.follow();
            of_begun.follow();
        }
        CHECK(changed.hash() == begun.hash());
        const TipError a = of_changed.result(), b = of_begun.result();
        CHECK(a.samples == 30);
        CHECK(a.rms == b.rms);
        CHECK(a.rms > 0);

        // And it is 3/2 of the difference to the same run at a quarter of the step, done by hand.
        SimulationOptions finer = o;
        finer.step = o.step / 4;
        Simulation coarse(after, o), fine(after, finer);
        RunError error(coarse);
        const std::uint64_t at_coarse = coarse.attach(20, Vec3::Zero(), 50, 1),
                            at_fine = fine.attach(20, Vec3::Zero(), 50, 1);
        const Vec3 from = coarse.positions()[20];
        double sum = 0;
        const auto tips = [&](const Simulation& run) {
            std::vector<Vec3> all;
            const Tree& tree = run.tree();
            std::vector<std::uint8_t> bears(tree.size_bodies(), 0);
            for (std::size_t i = 0; i < bears.size(); ++i)
                if (tree.kind[i] == Kind::branch && tree.parent[i] >= 0) bears[std::size_t(tree.parent[i])] = 1;
            for (std::size_t i = 0; i < bears.size(); ++i)
                if (tree.kind[i] == Kind::branch && !bears[i])
                    all.push_back(run.positions()[i] + run.rotations()[i] * Vec3(0, 0, tree.size[i][0]));
            return all;
        };
        std::size_t count = 0;
        for (int step = 1; step <= 12; ++step) {
            const Vec3 to = from + 0.01 * step * Vec3(1, 0, 0.5);
            coarse.move_attachment(at_coarse, to, 1);
            fine.move_attachment(at_fine, to, 4);
            error.lead();
            coarse.step();
            error.follow();
            fine.step(4);
            const std::vector<Vec3> a_tips = tips(coarse), b_tips = tips(fine);
            count = a_tips.size();
            for (std::size_t k = 0; k < count; ++k) sum += (a_tips[k] - b_tips[k]).squaredNorm();
        }
        REQUIRE(error.result().tips == count);
        CHECK(error.result().rms == Approx(1.5 * std::sqrt(sum / double(12 * count))).epsilon(1e-9));
    }
}

TEST_CASE("where no error can be told of, it is said") {
    Simulation analytic(one(leafy()), {.method = Method::analytic});
    CHECK_THROWS_WITH(RunError(analytic), Catch::Contains("coupled method"));
    Scene falling = one(leafy());
    falling.fracture = Fracture{};
    Simulation free(falling);
    CHECK_THROWS_WITH(RunError(free), Catch::Contains("/fracture"));
}
