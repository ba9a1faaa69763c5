// bending_stress.h and what a run gives of it, against beam theory written out here: cantilevers, uniform and tapered, under a load at the end, their
// own weight, and what breaks.
#include "lib/model/bending_stress.h"
#include "lib/simulation/simulation.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulations.h"
#include <numbers>

using namespace bough;

namespace {

using std::numbers::pi;
const make_tree::Wood stiff{900, 1e13, 1e12, 0.05}; // bends by less than a microradian

// In still space, pulled at its end by a force that stays.
Scene held(const Tree& tree, const Vec3& force) {
    Scene scene;
    scene.gravity = Vec3::Zero();
    scene.add(std::make_shared<const Tree>(tree));
    Pull pull;
    pull.on.by = Selector::By::branch;
    pull.on.at = 1;
    pull.time = {0, 1e6};
    pull.force = {force, force};
    scene.pulls = {pull};
    return scene;
}

std::vector<double> stresses(const Scene& scene, int steps = 3000, Precision precision = Precision::double_) {
    SimulationOptions o;
    o.stresses = true;
    o.precision = precision;
    Simulation run(scene, o);
    for (int k = 0; k < steps; ++k) REQUIRE(run.step().finite());
    return {run.stresses().begin(), run.stresses().end()};
}

} // namespace

TEST_CASE("a cantilever with a load at its end: sigma = F (L - x) r / I at each joint, however many there are") {
    const double L = 4, r = 0.06, I = pi * r * r * r * r / 4, F = 50;
    for (const int n : {1, 4, 20}) {
        const std::vector<double> found = stresses(held(make_tree::chain(n, L, r, r, 0, stiff), {F, 0, 0}));
        REQUIRE(found.size() == std::size_t(n));
        for (int i = 0; i < n; ++i) CHECK(found[std::size_t(i)] == Approx(F * (L - L * i / n) * r / I).epsilon(1e-6));
    }
}

TEST_CASE("across the grain any way, not along it") {
    const double L = 4, r = 0.06, W = pi * r * r * r / 4;
    const Tree tree = make_tree::chain(4, L, r, r, 0, stiff);
    const std::vector<double> across = stresses(held(tree, {30, 0, -40})), along = stresses(held(tree, {0, 50, 0}));
    CHECK(across[0] == Approx(50 * L / W).epsilon(1e-6));
    CHECK(along[0] < 1e-6 * across[0]);
}

TEST_CASE("a tapered cantilever bears the most where it is 1.5 times as thick as at its end") {
    const double L = 3, foot = 0.06, end = 0.01, F = 5;
    const int n = 100;
    const std::vector<double> found = stresses(held(make_tree::chain(n, L, foot, end, 0, stiff), {0, 0, F}));
    for (int i = 0; i < n; ++i) {
        const double x = L * i / n, r = foot + (end - foot) * x / L;
        CHECK(found[std::size_t(i)] == Approx(4 * F * (L - x) / (pi * r * r * r)).epsilon(1e-6));
    }
    // d/dx of (L - x) / r^3 is 0 where r = 3 (L - x) (foot - end) / L.
    const double worst = L - end / 2 * L / (foot - end);
    const auto most = std::max_element(found.begin(), found.end()) - found.begin();
    CHECK(std::abs(L * double(most) / n - worst) <= L / n);
    CHECK(*std::max_element(found.begin(), found.end()) > 5 * found[0]);
}

TEST_CASE("a branch held out level bears its own weight at its foot: w L^2 / 2 over W, as drawn and in float") {
    const double L = 2, r = 0.03, W = pi * r * r * r / 4;
    Tree tree = make_tree::chain(8, L, r, r, 0, stiff);
    tree.joint_rotation[0] = make_tree::turn(pi / 2, Vec3::UnitY());
    Scene scene;
    scene.add(std::make_shared<const Tree>(tree));
    const double weight = stiff.density * pi * r * r * scene.gravity.norm(); // [N/m]
    for (const Precision precision : {Precision::double_, Precision::single}) {
        const std::vector<double> found = stresses(scene, 0, precision);
        for (int i = 0; i < 8; ++i) {
            const double left = L * (1 - i / 8.0);
            CHECK(found[std::size_t(i)] == Approx(weight * left * left / 2 / W).epsilon(1e-5));
        }
    }
}

TEST_CASE("leaves, fruit and joints that are held have none") {
    const Tree tree = make_tree::branched();
    Scene scene;
    scene.add(std::make_shared<const Tree>(tree));
    scene.wind = wind_preset("breeze");
    const std::vector<double> all = stresses(scene, 3);
    Tree part = tree;
    part.rigid.assign(tree.size_bodies(), 0);
    part.rigid[5] = part.rigid[6] = 1;
    scene.trees.clear();
    scene.add(std::make_shared<const Tree>(part));
    const std::vector<double> held_still = stresses(scene, 3);
    REQUIRE(held_still.size() == tree.size_bodies());
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        CHECK((all[i] > 0) == (tree.kind[i] == Kind::branch));
        CHECK((held_still[i] > 0) == (tree.kind[i] == Kind::branch && part.rigid[i] == 0));
    }
}

TEST_CASE("wood breaks where its stress passes the strength of a scene's fracture") {
    const double L = 4, r = 0.06, W = pi * r * r * r / 4, F = 50, strength = F * L / W;
    for (const double share : {0.999, 1.001}) {
        Scene scene = held(make_tree::chain(4, L, r, r, 0, stiff), {share * F, 0, 0});
        scene.pulls[0].time = {0, 60}; // slowly, or the wood swings past
        scene.pulls[0].force = {Vec3::Zero(), Vec3(share * F, 0, 0)};
        scene.fracture = Fracture();
        scene.fracture->strength = strength;
        Simulation run(scene, {});
        std::size_t broke = 0;
        for (int k = 0; k < 2100; ++k) broke += run.step().broke;
        CHECK(broke == (share > 1 ? 1 : 0));
    }
}
