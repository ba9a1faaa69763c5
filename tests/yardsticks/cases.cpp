#include "cases.h"
#include "lib/growth/grow.h"
#include "lib/growth/segment.h"

namespace yardstick {
namespace {

bough::Scene windy_scene(std::size_t bodies, double stiffness) {
    bough::Scene scene;
    scene.pose = bough::Pose::rest;
    scene.gravity = Vec3(0.3, -9.81, 0.2);
    scene.stiffness_scale = stiffness;
    scene.damping_scale = 0.7;
    scene.air_density = 1.3;
    scene.wind.emplace();
    scene.wind->velocity = Vec3(7, -1, 4);
    scene.wind->profile = 0;
    scene.wind->gust_factor = 1.6;
    scene.wind->gust_period = 5;
    for (const std::size_t b : {bodies - 1, bodies / 2}) {
        bough::Pull pull;
        pull.on.body = std::int64_t(b);
        pull.time = {0.2, 0.6, 1.5};
        pull.force = {Vec3(0, 0, 0), Vec3(0.02, 0.05, -0.03), Vec3(0.1, 0, 0)};
        scene.pulls.push_back(pull);
    }
    return scene;
}

Vec3 within(make_tree::Dice& dice, double radius) {
    const double x = dice(-1, 1), y = dice(-1, 1), z = dice(-1, 1);
    return Vec3(x, y, z) * (radius / std::sqrt(3.0));
}

// Of the joints' accelerations alone, the velocities' part left out.
double kinetic_square(const Case& c, const std::vector<Vec3>& joint) {
    const std::size_t n = joint.size();
    Bodies at(n);
    make_dense(c.tree, c.scene.gravity)->move(c.motion, at);
    std::vector<Vec3> turning(n), moving(n);
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) {
        turning[i] = at.R_wb[i] * joint[i];
        moving[i].setZero();
        if (c.tree.parent[i] >= 0) {
            const auto p = std::size_t(c.tree.parent[i]);
            moving[i] = moving[p] + turning[p].cross(at.joint[i] - at.joint[p]);
            turning[i] += turning[p];
        }
        const Vec3 center = moving[i] + turning[i].cross(at.com[i] - at.joint[i]);
        const Vec3 turning_b = at.R_wb[i].transpose() * turning[i];
        sum += c.tree.mass[i] * center.squaredNorm() + turning_b.dot(c.tree.inertia[i] * turning_b);
    }
    return sum;
}

Tree grown_tree() {
    bough::Items items;
    items.leaves = items.fruit = true;
    Tree tree =
        bough::segment(bough::grow_bodies(bough::default_growth(), 11, items, 300), bough::wood_presets().front(), {});
    tree.name = "grown";
    return tree;
}

} // namespace

std::vector<Case> acceleration_cases() {
    struct Row {
        Tree tree;
        double joint_limit, kinetic_limit;
    };
    const std::vector<Row> rows = {
        {paper_trees::chain(2e9, 0.01), 5e-9, 1e-10},
        {paper_trees::branched(2e9, 0.01), 1e-9, 1e-10},
        {make_tree::branched(), 1e-10, 1e-11},
        {make_tree::forest({make_tree::branched(), make_tree::chain(5, 1, 0.03, 0.01)}), 1e-10, 1e-11},
        {grown_tree(), 1e-6, 1e-9},
        {make_tree::random_tree(100, 5), 1e-5, 1e-9},
        {make_tree::random_tree(300, 6), 10, 1e-3}};
    std::vector<Case> cases;
    for (const auto& [tree, joint_limit, kinetic_limit] : rows)
        for (const double stiffness : {1.0, 1e-6}) {
            Case c{};
            const std::size_t n = tree.size_bodies();
            c.name = tree.name + ", " + std::to_string(n) + " bodies, K x " + (stiffness == 1 ? "1" : "1e-6");
            c.tree = tree;
            c.scene = windy_scene(n, stiffness);
            for (const bough::Pull& pull : c.scene.pulls) // a body is pulled at its centre of mass
                c.targets.push_back({std::size_t(pull.on.body), tree.com[std::size_t(pull.on.body)]});
            c.time = 0.8;
            c.joint_limit = joint_limit;
            c.kinetic_limit = kinetic_limit;
            make_tree::Dice dice{std::mt19937(unsigned(n))};
            for (std::size_t i = 0; i < n; ++i) {
                c.motion.turn.push_back(turn_of(within(dice, 1)));
                c.motion.rate.push_back(within(dice, 5));
            }
            cases.push_back(c);
        }
    return cases;
}

Difference difference(const Case& c, const std::vector<Vec3>& a, const std::vector<Vec3>& truth) {
    const std::size_t n = truth.size();
    std::vector<Vec3> off(n);
    double squares = 0;
    for (std::size_t i = 0; i < n; ++i) off[i] = a[i] - truth[i], squares += truth[i].squaredNorm();
    const double floor = 1e-3 * std::sqrt(squares / double(n));
    Difference found;
    for (std::size_t i = 0; i < n; ++i) {
        const double d = off[i].norm() / std::max(truth[i].norm(), floor);
        if (!(d <= found.joint)) found.joint = d, found.worst_joint = i;
    }
    found.kinetic = std::sqrt(kinetic_square(c, off) / kinetic_square(c, truth));
    return found;
}

std::vector<Vec3> accelerations(Engine& engine, const Case& c) {
    const std::size_t n = c.tree.size_bodies();
    Bodies bodies(n);
    Loads loads(n);
    std::vector<Vec3> acceleration(n);
    engine.move(c.motion, bodies);
    compute_loads(c.tree, c.scene, c.targets, c.time, c.motion, bodies, loads);
    engine.accelerate(loads, acceleration);
    return acceleration;
}

} // namespace yardstick
