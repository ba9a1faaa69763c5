// free_support.h: a tree, what is free beside it, steps of both: what the tests of free bodies share.
#pragma once
#include "lib/free/world_step.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulate.h"
#include <catch2/catch.hpp>

namespace free_bodies {

using namespace bough;
using Simd = std::optional<fast::Target>; // none: the plain path

struct Way {
    Solver solver = Solver::coupled;
    Simd simd;
};
// Both steps on both paths.
inline const std::vector<Way> ways{{Solver::coupled, std::nullopt},
                                   {Solver::coupled, fast::Target::baseline},
                                   {Solver::analytic, std::nullopt},
                                   {Solver::analytic, fast::Target::baseline}};
inline std::string name(const Way& way) {
    return std::string(solver_name(way.solver)) + (way.simd ? ", in lanes" : ", plain");
}

template <class T = double> struct FreeRun {
    Tree tree;
    std::vector<TreeRange> ranges;
    Plan<T> plan;
    State<T> state;
    World<T> world;
    FreeRun(const Tree& t, const Scene& scene, const Way& way, double dt = 1.0 / 30)
        : tree(t), ranges{{0, t.size_bodies(), 0}},
          plan(make_plan<T>(tree, ranges, scene, {}, dt, way.solver, Scheme::p12, way.simd)), state(make_state(plan)),
          world(make_world(plan, tree, ranges)) {}
    FreeRun(const FreeRun&) = delete;
    void steps(int n) {
        for (int k = 0; k < n; ++k) advance(plan, state, world);
    }
    std::uint64_t hash() const { return state_hash(plan, state, world); }
    const FreeBody& ball(std::size_t k = 0) const { return world.free[k]; }
};

// Nothing but what a test puts in: no gravity, no air.
inline Scene empty_scene() {
    Scene scene = simulate::nothing();
    scene.air_density = 0;
    scene.contact = Contact();
    scene.contact->friction = 0;
    scene.contact->restitution = 0;
    scene.contact->rolling = 0;
    scene.contact->ground = false;
    return scene;
}

inline Ball ball(const Vec3& position, const Vec3& velocity, double radius = 0.1, double mass = 1) {
    Ball b;
    b.position = position;
    b.velocity = velocity;
    b.radius = radius;
    b.mass = mass;
    return b;
}

// A rod of the given length [m] on the ground, its z along the world's z, hinged without a spring.
inline Tree hinged_rod(double length = 2, double radius = 0.025) {
    make_tree::Wood wood;
    wood.youngs = wood.shear = 0;
    wood.damping = 0;
    Tree tree = make_tree::chain(1, length, radius, radius, 0, wood);
    tree.joint_rotation[0] = Quat::Identity();
    return tree;
}

// Wind that shakes leaves and fruit off, balls, everything that may be free.
inline Scene lively() {
    Scene scene;
    scene.pose = Pose::rest;
    scene.wind = *wind_preset("storm");
    scene.fracture = Fracture();
    scene.fracture->leaf = 2e-5;
    scene.fracture->fruit = 0.05;
    scene.fracture->spread = 0.5;
    scene.fracture->joints = {{{Selector::By::body, 0, 9, {}}, 1e-3}};
    scene.balls = {ball(Vec3(0.1, 2.4, 0), Vec3(0, -4, 0), 0.1, 0.5), ball(Vec3(-0.3, 3, 0), Vec3(0, 0, 0), 0.05, 0.3)};
    return scene;
}

} // namespace free_bodies
