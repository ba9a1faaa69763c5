#include "cases.h"

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

} // namespace

std::vector<Case> acceleration_cases() {
    const std::vector<Tree> trees = {
        paper_trees::chain(2e9, 0.01),  paper_trees::branched(2e9, 0.01),
        make_tree::branched(),          make_tree::random_tree(100, 5),
        make_tree::random_tree(300, 6), make_tree::forest({make_tree::branched(), make_tree::chain(5, 1, 0.03, 0.01)})};
    std::vector<Case> cases;
    for (const Tree& tree : trees)
        for (const double stiffness : {1.0, 1e-6}) {
            Case c;
            const std::size_t n = tree.size_bodies();
            c.name = tree.name + ", " + std::to_string(n) + " bodies, K x " + (stiffness == 1 ? "1" : "1e-6");
            c.tree = tree;
            c.scene = windy_scene(n, stiffness);
            for (const bough::Pull& pull : c.scene.pulls) // a body is pulled at its centre of mass
                c.targets.push_back({std::size_t(pull.on.body), tree.com[std::size_t(pull.on.body)]});
            c.time = 0.8;
            make_tree::Dice dice{std::mt19937(unsigned(n))};
            for (std::size_t i = 0; i < n; ++i) {
                c.motion.turn.push_back(turn_of(within(dice, 1)));
                c.motion.rate.push_back(within(dice, 5));
            }
            cases.push_back(c);
        }
    return cases;
}

Difference difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double squares = 0;
    for (const Vec3& v : b) squares += v.squaredNorm();
    const double floor = 1e-3 * std::sqrt(squares / double(b.size()));
    Difference worst;
    for (std::size_t i = 0; i < b.size(); ++i) {
        const double d = (a[i] - b[i]).norm() / std::max(b[i].norm(), floor);
        if (!(d <= worst.largest)) worst = {d, i};
    }
    return worst;
}

std::vector<Vec3> accelerations(Engine& engine, const Case& c) {
    const std::size_t n = c.tree.size_bodies();
    Bodies bodies{std::vector<Mat3>(n), std::vector<Vec3>(n), std::vector<Vec3>(n), std::vector<Vec3>(n)};
    Loads loads{std::vector<Vec3>(n), std::vector<Vec3>(n), std::vector<Vec3>(n)};
    std::vector<Vec3> acceleration(n);
    engine.move(c.motion, bodies);
    compute_loads(c.tree, c.scene, c.targets, c.time, c.motion, bodies, loads);
    engine.accelerate(loads, acceleration);
    return acceleration;
}

} // namespace yardstick
