// The grid of extremes: every promised cell holds, and the audit that says so can say no.
#include "lib/reference/stability.h"
#include "tests/make_tree.h"
#include <catch2/catch.hpp>

using namespace bough;

namespace {

StabilitySetup setup_of(const Tree& tree) {
    StabilitySetup setup;
    setup.tree = tree;
    setup.ranges = {{0, tree.size_bodies(), 0}};
    setup.scene.pose = Pose::rest;
    return setup;
}

const auto no_progress = [](std::int64_t, std::int64_t) {};

} // namespace

TEST_CASE("every promised cell holds, float and double") {
    for (const Tree& tree :
         {make_tree::branched(), make_tree::chain(20, 4, 0.03, 0.003), make_tree::random_tree(60, 3)}) {
        const StabilityReport report = measure_stability(setup_of(tree), {40, false, ""}, no_progress);
        std::size_t promised = 0;
        for (const StabilityCell& cell : report.cells) {
            CAPTURE(tree.name, cell.group, cell.name, cell.precision, cell.note, cell.energy_drift, cell.rms_growth);
            if (!cell.promised) continue;
            ++promised;
            CHECK(cell.finite);
            CHECK(cell.bounded);
        }
        CHECK(promised >= 80);
    }
}

TEST_CASE("the audit sees a method that gains energy") {
    // Euler forward on an undamped pendulum: each step multiplies the energy by 1 + (omega h)^2.
    make_tree::Wood wood;
    wood.damping = 0;
    StabilitySetup setup = setup_of(make_tree::chain(1, 2, 0.03, 0.03, 0, wood));
    setup.scene.gravity = Vec3(3, -9.81, 0);
    const double J = setup.tree.inertia[0](0, 0) + setup.tree.mass[0] * setup.tree.com[0].squaredNorm();
    const double omega = std::sqrt(setup.tree.stiffness[0][0] / J);
    setup.dt = 0.02 / omega;
    const StabilityCell gains =
        run_cell(setup, {"own", "pendulum", true, {}}, Solver::articulated_explicit, false, 1000, [] {});
    CHECK(gains.finite);
    CHECK(gains.energy_drift > 0.1);
    CHECK_FALSE(gains.bounded);
    const StabilityCell keeps = run_cell(setup, {"own", "pendulum", true, {}}, Solver::analytic, false, 1000, [] {});
    CHECK(keeps.energy_drift < 1e-3);
    CHECK(keeps.bounded);
    setup.dt = 10 / omega;
    const StabilityCell bursts =
        run_cell(setup, {"own", "pendulum", true, {}}, Solver::articulated_explicit, false, 1000, [] {});
    CHECK_FALSE(bursts.bounded);
}

TEST_CASE("ringing and angles are counted as they are") {
    // A stiff undamped joint that turns by a known phase a step: sign changes follow.
    make_tree::Wood wood;
    wood.damping = 0;
    StabilitySetup setup = setup_of(make_tree::chain(1, 2, 0.03, 0.03, 0, wood));
    setup.scene.gravity = Vec3(0.3, -9.81, 0); // bends about one axis
    const double J = setup.tree.inertia[0](0, 0) + setup.tree.mass[0] * setup.tree.com[0].squaredNorm();
    const double omega = std::sqrt(setup.tree.stiffness[0][0] / J);
    setup.scene.joint_inertia = JointInertia::paper;
    setup.dt = 2 * 3.14159265358979 / omega / 10.3; // 10.3 steps a period: two sign changes in it, on one of three axes
    const StabilityCell cell = run_cell(setup, {"own", "rod", true, {}}, Solver::analytic, false, 1030, [] {});
    CHECK(cell.ringing == Approx(2 / 10.3 / 3).epsilon(0.02));
    const double sag = 0.3 * setup.tree.mass[0] * setup.tree.com[0].z() / setup.tree.stiffness[0][0];
    CHECK(cell.max_angle == Approx(2 * sag).epsilon(0.05));
    CHECK(cell.guards == 0);
}
