// Seconds of motion: Solver::articulated_reference (lib/study/extrapolation.h), and the coupled step at small steps, against trajectories whose accelerations
// come from MuJoCo and from Simbody (trajectory.h). MuJoCo's run has half the steps of Simbody's: what the two differ by bounds
// the engines' disagreement and, Runge-Kutta's order being 4, 15 times the error of the finer one's steps. The error is the
// largest distance of a tip over all frames, relative to the root mean square of the tips' deflection from the start.
#include "cases.h"
#include "lib/study/solvers.h"
#include "tests/support/solver_parts.h"
#include "trajectory.h"
#include <catch2/catch.hpp>

using namespace yardstick;

namespace {

Track library_track(const Tree& tree, const bough::Scene& scene, const std::vector<std::size_t>& tips, int frames,
                    double fps, double tolerance) {
    auto plan = bough::make_plan<double>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, 1 / fps,
                                         bough::Solver::articulated_reference);
    parts::set_tolerance(plan, tolerance);
    auto state = bough::make_state(plan);
    Track track;
    for (int f = 0; f <= frames; ++f) {
        if (f > 0) bough::advance(plan, state);
        track.emplace_back();
        for (const std::size_t b : tips)
            track.back().push_back(state.x_w[b] + state.R_wb[b] * Vec3(0, 0, tree.size[b].x()));
    }
    CHECK(state.flags.unresolved == 0);
    return track;
}

// frames at 30 a second, `steps` a frame for the coarser run. tolerance [rad]: the library's, absolute, so that a tree that
// moves little needs a smaller one.
void compare(const Tree& tree, const bough::Scene& scene, int frames, int steps, double tolerance = 1e-8) {
    const auto tips = paper_trees::tips(tree);
    const auto mujoco = make_mujoco(tree, scene.gravity), simbody = make_simbody(tree, scene.gravity);
    const Track coarse = integrate(*mujoco, tree, scene, tips, frames, 30, steps);
    const Track fine = integrate(*simbody, tree, scene, tips, frames, 30, 2 * steps);
    const Track found = library_track(tree, scene, tips, frames, 30, tolerance);
    const double engines = track_difference(coarse, fine), ours = track_difference(found, fine);
    INFO(tree.name << ": engines " << engines << ", library " << ours);
    CHECK(engines <= 1e-7);
    CHECK(ours <= 1e-6);
}

// The coupled step in double at `steps` steps a frame.
Track coupled_track(const Tree& tree, const bough::Scene& scene, const std::vector<std::size_t>& tips, int frames,
                    bough::Scheme scheme, int steps) {
    const auto plan = bough::make_plan<double>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, 1 / (30.0 * steps),
                                               bough::Solver::coupled, scheme);
    auto state = bough::make_state(plan);
    Track track;
    for (int f = 0; f <= frames; ++f) {
        for (int k = 0; f > 0 && k < steps; ++k) bough::advance(plan, state);
        track.emplace_back();
        for (const std::size_t b : tips)
            track.back().push_back(state.x_w[b] + state.R_wb[b] * Vec3(0, 0, tree.size[b].x()));
    }
    return track;
}

void compare_coupled(const Tree& tree, const bough::Scene& scene, int frames, int engine_steps) {
    const auto tips = paper_trees::tips(tree);
    const auto mujoco = make_mujoco(tree, scene.gravity), simbody = make_simbody(tree, scene.gravity);
    const Track coarse = integrate(*mujoco, tree, scene, tips, frames, 30, engine_steps);
    const Track fine = integrate(*simbody, tree, scene, tips, frames, 30, 2 * engine_steps);
    CHECK(track_difference(coarse, fine) <= 1e-7);
    INFO(tree.name);
    CHECK(track_difference(coupled_track(tree, scene, tips, frames, bough::Scheme::p12, 2048), fine) <= 1e-6);
}

bough::Scene gravity_switched_on() {
    bough::Scene scene;
    scene.pose = bough::Pose::rest;
    return scene;
}

bough::Scene gusty() {
    bough::Scene scene = gravity_switched_on();
    scene.wind.emplace();
    scene.wind->velocity = Vec3(8, 0, 2.4);
    scene.wind->profile = 0;
    scene.wind->gust_factor = 1.5;
    scene.wind->gust_period = 0.7;
    return scene;
}

} // namespace

TEST_CASE("The chain of 20 rods falls as with the engines' accelerations, E = 2e8") {
    compare(paper_trees::chain(2e8, 1e-4), gravity_switched_on(), 60, 100);
}

TEST_CASE("The branched tree of 21 bodies falls as with the engines' accelerations, E = 2e8") {
    compare(paper_trees::branched(2e8, 1e-4), gravity_switched_on(), 60, 100);
}

TEST_CASE("The chain of 20 rods falls as with the engines' accelerations, E = 2e9, one second") {
    compare(paper_trees::chain(2e9, 1e-5), gravity_switched_on(), 30, 240);
}

TEST_CASE("The branched tree of 21 bodies falls as with the engines' accelerations, E = 2e9, one second") {
    compare(paper_trees::branched(2e9, 1e-5), gravity_switched_on(), 30, 300, 1e-9);
}

TEST_CASE("The branched tree of 21 bodies falls as with the engines' accelerations, E = 2e10, a quarter of a second") {
    compare(paper_trees::branched(2e10, 1e-5), gravity_switched_on(), 8, 1000, 1e-10);
}

TEST_CASE("The branched tree of 21 bodies sways in gusty wind as with the engines' accelerations, E = 2e8") {
    compare(paper_trees::branched(2e8, 1e-4), gusty(), 60, 120);
}

TEST_CASE("The coupled step at small steps falls as with the engines' accelerations, chain of 20 rods, E = 2e8") {
    compare_coupled(paper_trees::chain(2e8, 1e-4), gravity_switched_on(), 15, 100);
}

TEST_CASE("The coupled step at small steps falls as with the engines' accelerations, branched tree, E = 2e8") {
    compare_coupled(paper_trees::branched(2e8, 1e-4), gravity_switched_on(), 15, 100);
}

TEST_CASE("The coupled step at small steps sways in gusty wind as with the engines' accelerations, E = 2e8") {
    compare_coupled(paper_trees::branched(2e8, 1e-4), gusty(), 15, 120);
}
