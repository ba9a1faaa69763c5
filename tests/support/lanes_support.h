// lanes_support.h: a step on the plain path or in lanes, on trees and scenes in which the two are compared.
#pragma once
#include "lib/growth/grow.h"
#include "lib/growth/segment.h"
#include "lib/plan/state.h"
#include "lib/study/solvers.h"
#include "tests/support/coupled_cases.h"
#include "tests/support/solver_parts.h"
#include "tests/support/solver_support.h"
#include <catch2/catch.hpp>

namespace lanes {

using namespace bough;
using fast::Target;

using Simd = std::optional<Target>; // none: the plain path

struct Case {
    std::string name;
    Tree tree;
    Scene scene;
    double angle = 0, rate = 0; // [rad], [rad/s] at random at the start
    std::vector<TreeRange> ranges{};
    Solver solver = Solver::coupled;
    std::vector<TreeRange> all_ranges() const {
        return ranges.empty() ? std::vector<TreeRange>{{0, tree.size_bodies(), 0}} : ranges;
    }
};

template <class T = double> struct LanesRun {
    Plan<T> plan;
    State<T> state;
    LanesRun(const Case& c, Simd simd, Scheme scheme = Scheme::p12, const Wishes& wishes = {},
             std::optional<Solver> solver = std::nullopt, double sleep = 0)
        : plan(make_plan<T>(c.tree, c.all_ranges(), c.scene, wishes, 1.0 / 30, solver.value_or(c.solver), scheme, simd,
                            sleep)),
          state(make_state(plan)) {
        if (c.angle == 0 && c.rate == 0) return;
        make_tree::Dice dice{std::mt19937(5)};
        for (std::size_t i = 0; i < plan.bodies; ++i) {
            state.theta[i] += solver::random_vector(dice, c.angle).template cast<T>();
            state.theta_dot[i] = solver::random_vector(dice, c.rate).template cast<T>();
            if (plan.stepper->kind().name == std::string(solver_name(Solver::coupled)))
                parts::theta_change(state)[i] = T(plan.dt) * state.theta_dot[i];
            else // about what the composites of tips carry of it
                parts::scaled_rate(state)[i] = std::sqrt(plan.inertia_joint[i].trace()) * state.theta_dot[i];
        }
        restart(plan, state);
    }
    void steps(int n) {
        for (int k = 0; k < n; ++k) advance(plan, state);
    }
    void frame() {
        advance(plan, state);
        present(plan, state);
    }
    std::uint64_t hash() {
        present(plan, state);
        return state_hash(state);
    }
    std::uint64_t calls(Stage stage) const { return state.calls[std::size_t(stage)]; }
};

inline std::vector<Target> targets() {
    std::vector<Target> there;
    for (const Target target : fast::all_targets)
        if (fast::available(target)) there.push_back(target);
    return there;
}

inline Tree grown(std::int64_t bodies) {
    return segment(grow_bodies(default_growth(), 7, {true, false, true}, bodies), wood_presets().front(), {});
}

// The tree with its clumps' leaves facing one way, each by a share of its own.
inline Tree facing(Tree tree) {
    make_tree::Dice dice{std::mt19937(9)};
    tree.leaf_facing.assign(tree.size_bodies(), 0);
    std::size_t clumps = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (is_clump(tree, i)) tree.leaf_facing[i] = dice(0, 1), ++clumps;
    if (clumps == 0) throw std::logic_error("facing: no clumps");
    return tree;
}

// Moves and turns a tree.
inline RootMotion carried_about(std::int32_t tree = 0) {
    RootMotion keys;
    keys.tree = tree;
    keys.time = {0, 1, 2, 3};
    keys.position = {Vec3::Zero(), Vec3(0.1, 0.02, -0.1), Vec3(0.15, 0, 0), Vec3::Zero()};
    keys.rotation = {Quat::Identity(), make_tree::turn(0.2, Vec3(1, 2, 0)), make_tree::turn(0.1, Vec3(0, 2, 1)),
                     Quat::Identity()};
    return keys;
}

inline RootMotion shifted(std::int32_t tree = 0) {
    RootMotion keys = carried_about(tree);
    keys.rotation.clear();
    return keys;
}

inline Wind gusts() {
    Wind wind = *wind_preset("gusty");
    wind.turbulence = 0.2;
    return wind;
}

// Several on one body, and on many bodies at once; `times` as strong, for trees that are firm.
inline std::vector<Pull> pulls(double times = 1) {
    std::vector<Pull> all{coupled::pull_on(3, Vec3(1, 0, -4), times * Vec3(-8, 1, 2)),
                          coupled::pull_on(3, Vec3(-1, 2, 0), times * Vec3(2, 2, 2)),
                          coupled::pull_on(7, Vec3(0, -1, 1), times * Vec3(0, 1, 0))};
    Pull level;
    level.on.by = Selector::By::level;
    level.on.level = 1;
    level.time = {0, 0.7, 3};
    level.force = {times * Vec3(0, 0, 0.1), times * Vec3(0.1, 0.05, -0.2), Vec3::Zero()};
    all.push_back(level);
    return all;
}

// Wind, pulls, gravity, a moving ground.
inline Scene everything() {
    Scene scene;
    scene.wind = gusts();
    scene.pulls = pulls();
    scene.root_motion = {carried_about()};
    return scene;
}

inline Scene in_wind(const Wind& wind) {
    Scene scene;
    scene.wind = wind;
    return scene;
}

// So soft that it swings about once in ten seconds.
inline Scene slack() {
    Scene scene = solver::empty_scene();
    scene.stiffness_scale = 1e-7;
    return scene;
}

// Leaves that hold their own weight, and do not turn too fast for a step to resolve.
inline Tree firm(Tree tree) {
    for (Vec3& K : tree.stiffness) K *= 10;
    return tree;
}

inline Tree three_trees(std::vector<TreeRange>& ranges) {
    const std::vector<Tree> trees{firm(make_tree::branched()), coupled::leafy(1e9, 0.01), firm(grown(200))};
    std::size_t first = 0;
    std::int32_t branch = 0;
    for (const Tree& tree : trees) {
        ranges.push_back({first, tree.size_bodies(), branch});
        first += tree.size_bodies();
        branch += *std::max_element(tree.branch.begin(), tree.branch.end()) + 1;
    }
    return make_tree::forest(trees);
}

struct Apart {
    double theta = 0, theta_dot = 0, x = 0; // [rad], [rad/s], [m], the most of all bodies and frames
};

template <class T> double most(const std::vector<Vector3<T>>& a, const std::vector<Vector3<T>>& b) {
    double d = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double here = double((a[i] - b[i]).norm());
        if (!(here <= d)) d = here; // NaN is the most
    }
    return d;
}

template <class T> Apart run_apart(LanesRun<T>& a, LanesRun<T>& b, int frames) {
    Apart d;
    for (int k = 0; k < frames; ++k) {
        a.frame();
        b.frame();
        d.theta = std::max(d.theta, most(a.state.theta, b.state.theta));
        d.theta_dot = std::max(d.theta_dot, most(a.state.theta_dot, b.state.theta_dot));
        d.x = std::max(d.x, most(a.state.x_w, b.state.x_w));
        if (!std::isfinite(most(a.state.theta, b.state.theta))) d.theta = INFINITY;
    }
    return d;
}

// In float the lanes stay within twice of what the plain step's float is off by: bodies' places against the plain step in double,
// RMS and the most over `frames`.
inline void check_float_drift(const Case& c, int frames) {
    LanesRun<> plain(c, std::nullopt);
    LanesRun<float> plain_float(c, std::nullopt), lanes_float(c, fast::best_target());
    double plain_off = 0, lanes_off = 0, plain_worst = 0, lanes_worst = 0;
    const auto off = [](const std::vector<Vector3<float>>& a, const std::vector<Vec3>& b, double& worst) {
        double sum = 0;
        for (std::size_t i = 0; i < b.size(); ++i) {
            const double d = (a[i].cast<double>() - b[i]).squaredNorm();
            sum += d;
            worst = std::max(worst, std::sqrt(d));
        }
        return sum / double(b.size());
    };
    // The lanes' float against the lanes' double, which is the plain one's to rounding.
    LanesRun<> lanes_double(c, fast::best_target());
    for (int k = 0; k < frames; ++k) {
        plain.frame();
        lanes_double.frame();
        plain_float.frame();
        lanes_float.frame();
        plain_off += off(plain_float.state.x_w, plain.state.x_w, plain_worst) / frames;
        lanes_off += off(lanes_float.state.x_w, lanes_double.state.x_w, lanes_worst) / frames;
    }
    CAPTURE(c.name);
    CHECK(std::sqrt(lanes_off) < 2 * std::sqrt(plain_off));
    CHECK(lanes_worst < 2 * plain_worst);
}

// True where AVX2 and AVX-512 can be compared: tests/run compiles the better of them alone.
inline bool both_wide() {
    return fast::available(Target::avx2) && fast::available(Target::avx512);
}

// The wider two targets are compiled from the same source with the same fused operations.
inline void check_same_bits(const Case& c) {
    LanesRun<> half(c, Target::avx2), full(c, Target::avx512);
    LanesRun<float> half_float(c, Target::avx2), full_float(c, Target::avx512);
    half.steps(30), full.steps(30), half_float.steps(30), full_float.steps(30);
    CAPTURE(c.name);
    CHECK(half.hash() == full.hash());
    CHECK(half_float.hash() == full_float.hash());
}

// Every target against the baseline. most_in_float: [m] of the bodies' places.
inline void check_targets_agree(const Case& c, double most_in_float) {
    for (const Target target : targets()) {
        if (target == Target::baseline) continue;
        LanesRun<> one(c, Target::baseline), other(c, target);
        LanesRun<float> one_float(c, Target::baseline), other_float(c, target);
        const Apart d = run_apart(one, other, 60), f = run_apart(one_float, other_float, 60);
        CAPTURE(c.name, fast::target_name(target));
        CHECK(d.theta < 1e-11);
        CHECK(d.theta_dot < 1e-10);
        CHECK(d.x < 1e-11);
        CHECK(f.x < most_in_float);
    }
}

// What the steps of both solvers are compared in.
inline std::vector<Case> first_cases(const Tree& large, const Tree& leafy) {
    Scene drop;
    drop.pose = Pose::rest;
    return {{"rest pose let go", leafy, drop},
            {"rest pose let go, many leaves", large, drop},
            {"gusts, leaves and fruit", large, in_wind(gusts())},
            {"gusts, clumps that face one way more than others", facing(large), in_wind(gusts())}};
}

} // namespace lanes
