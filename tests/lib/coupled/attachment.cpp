// Springs and dampers at points (attachment.h): against the reference and statics, in lanes, of any stiffness, over threads and cuts.
#include "lib/coupled/attachment.h"
#include "lib/base/parallel.h"
#include "tests/support/held_tree.h"
#include <catch2/catch.hpp>

using namespace bough;
using namespace coupled;
using solver::empty_scene;

namespace {

// Where a twig is held: in its reach, beside it, three times as far as it reaches, and moved to and fro.
std::vector<Attachment> hands(std::int64_t body, double k, double c) {
    std::vector<Attachment> all(4, hold(body, k, c));
    all[0].target = Vec3(0.1, 0.25, 0.05);
    all[1].target = Vec3(-0.3, 0.05, 0.1);
    all[2].target = Vec3(1, 0.3, -0.2);
    all[3].time = {0, 0.3, 0.6, 0.9, 1.2};
    all[3].position = {Vec3(0, 0.36, 0), Vec3(0.3, 0.2, 0), Vec3(0, 0.2, 0.6), Vec3(-0.3, 0.3, 0), Vec3(0.2, 0.2, 0.1)};
    return all;
}

template <class T> void check_grid(bool lanes) {
    const Tree tree = twig();
    for (const double k : {0.0, 1e-3, 1.0, 20.0, 1e3, 1e5, 1e7, 1e9, 1e12})
        for (const double c : {0.0, 1e-2, 1.0, 1e3, 1e9}) {
            if (k == 0 && c == 0) continue;
            for (std::size_t hand = 0; hand < 4; ++hand) {
                Scene scene = empty_scene();
                scene.gravity = Vec3(0, -9.81, 0);
                scene.attachments = {hands(11, k, c)[hand]};
                Held<T> run(tree, scene, lanes);
                CAPTURE(sizeof(T), lanes, k, c, hand);
                double third = 0, last = 0;
                for (int f = 0; f < 240; ++f) {
                    run.step();
                    const double energy = run.kinetic();
                    REQUIRE(std::isfinite(energy));
                    (f < 180 ? third : last) = std::max(f < 180 ? (f < 120 ? 0 : third) : last, energy);
                }
                CHECK(run.largest_angle() < 3.2);
                CHECK(last <= 1.05 * third + 5e-5); // [J] it falls by its length for 5e-4
                if (hand < 2 && k >= 1e3)
                    CHECK((run.point() - *scene.attachments[0].target).norm() < 0.05); // as it comes to rest
            }
        }
}

} // namespace

TEST_CASE("A twig of 0.8 mm is held by springs of any stiffness and dampers of any strength at 1/30 s") {
    check_grid<double>(false);
    check_grid<double>(true);
    check_grid<float>(true);
}

TEST_CASE("Attachments in lanes move a tree as they do one number at a time, in both precisions, under every load") {
    const Tree tree = leafy(2e9, 0.01);
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.wind = wind_preset("gusty");
    scene.attachments = {hold(12, 200, 0.5), hold(22, 30, 0), hold(9, 0, 2), hold(15, 60, 1)};
    scene.attachments[0].target = Vec3(0.4, 1.9, 0.3);
    scene.attachments[1].target = Vec3(0.1, 2.2, -0.3);
    scene.attachments[2].time = {0, 1, 2};
    scene.attachments[2].position = {Vec3(0.3, 1.8, 0.1), Vec3(0.5, 1.7, -0.2), Vec3(0.1, 1.5, 0.3)};
    scene.attachments[3].from = 0.3;
    scene.attachments[3].to = 1.2;
    for (const Scheme scheme : {Scheme::p12, Scheme::p34}) {
        Held<double> plain(tree, scene, false, 1.0 / 120, scheme), lanes(tree, scene, true, 1.0 / 120, scheme);
        Held<float> single(tree, scene, true, 1.0 / 120, scheme);
        double moved = 0, off = 0, off_single = 0;
        for (int f = 0; f < 240; ++f) {
            plain.step();
            lanes.step();
            single.step();
            for (std::size_t i = 0; i < plain.plan.bodies; ++i) {
                moved = std::max(moved, (plain.state.x_w[i] - tree.joint_position[i]).norm());
                off = std::max(off, (plain.state.x_w[i] - lanes.state.x_w[i]).norm());
                off_single = std::max(off_single, (plain.state.x_w[i] - single.state.x_w[i].cast<double>()).norm());
            }
        }
        CAPTURE(scheme_of(scheme).name);
        CHECK(moved > 0.1);
        CHECK(off < 1e-9);
        CHECK(off_single < 5e-3);
        for (std::size_t k = 0; k < 4; ++k)
            CHECK((plain.held(k).force - lanes.held(k).force).norm() < 1e-6 * (1 + plain.held(k).force.norm()));
    }
}

// Where the sum of elastic, potential and the spring's energy is least, by Newton's method on differences of it: none of the solver's equations.
TEST_CASE("Under a rope a branch comes to rest where its energy is least, and the rope's force is what it says") {
    const Tree tree = make_tree::chain(5, 1.0, 0.006, 0.004, 0.1, {800, 2e9, 2e8, 0.05});
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.pose = Pose::rest;
    for (const double k : {5.0, 300.0, 1e6}) {
        scene.attachments = {hold(3, k, 1)};
        scene.attachments[0].on.point = Vec3(0.001, 0, 0.15);
        scene.attachments[0].target = Vec3(0.5, 0.55, 0.2);
        Held<double> run(tree, scene, false);
        for (int f = 0; f < 3000; ++f) advance(run.plan, run.state);
        present(run.plan, run.state);
        const auto energy_at = [&](const Eigen::VectorXd& theta) {
            long double sum = 0;
            Mat3 R = Mat3::Identity();
            Vec3 x = Vec3::Zero(), held = Vec3::Zero();
            for (std::size_t i = 0; i < 5; ++i) {
                const Vec3 angle = theta.segment<3>(3 * Eigen::Index(i));
                x += R * tree.joint_position[i];
                R = R * tree.joint_rotation[i].toRotationMatrix() *
                    Mat3(Eigen::AngleAxisd(angle.norm(), angle.stableNormalized()));
                sum += angle.dot(tree.stiffness[i].cwiseProduct(angle)) / 2;
                sum -= tree.mass[i] * scene.gravity.dot(x + R * tree.com[i]);
                if (i == 3) held = x + R * *scene.attachments[0].on.point;
            }
            return double(sum + k / 2 * (held - *scene.attachments[0].target).squaredNorm());
        };
        Eigen::VectorXd at(15);
        for (std::size_t i = 0; i < 5; ++i) at.segment<3>(3 * Eigen::Index(i)) = run.state.theta[i];
        const Eigen::VectorXd gradient = gradient_of(energy_at, at);
        CAPTURE(k, gradient.norm());
        double moment = 0; // [N m] what stands against each other
        for (std::size_t i = 0; i < 5; ++i)
            moment = std::max(moment, tree.stiffness[i].cwiseProduct(run.state.theta[i]).norm());
        CHECK(moment > 0.05);
        CHECK(gradient.norm() < 2e-6 * moment * std::max(1.0, k / 1e3));
        const Vec3 force = k * (*scene.attachments[0].target - run.point());
        CHECK((run.held().force - force).norm() < 1e-6 * force.norm());
    }
}

TEST_CASE("A tree that is held moves as the reference's, and its error falls with the square of the step") {
    coupled::Motion motion{paper_trees::branched(2e9, 0.01), empty_scene(), 30};
    motion.scene.gravity = Vec3(0, -9.81, 0);
    motion.scene.attachments = {hold(20, 50, 0.4), hold(12, 400, 2)};
    const Held<double> start(motion.tree, motion.scene, false);
    const Vec3 a = start.point(0), b = start.point(1);
    motion.scene.attachments[0].time = {0, 0.4, 0.8, 1};
    motion.scene.attachments[1].time = {0, 0.5, 1};
    motion.scene.attachments[0].position = {a, a + Vec3(0.2, 0, 0.1), a + Vec3(0, -0.1, 0.2), a};
    motion.scene.attachments[1].position = {b, b + Vec3(0, -0.1, 0.1), b};
    const Track truth = truth_of(motion);
    const double coarse = error_of(motion, truth, Scheme::p12, 1), fine = error_of(motion, truth, Scheme::p12, 4);
    CAPTURE(coarse, fine);
    CHECK(coarse < 0.02);
    CHECK(order_at(motion, truth, Scheme::p12, 4) > 1.8);
    CHECK(order_at(motion, truth, Scheme::p34, 4) > 1.8);
}

TEST_CASE("A tree and a hand that move together with the ground stay as they are") {
    const Tree tree = paper_trees::branched(2e9, 0.01);
    Scene still = empty_scene();
    still.gravity = Vec3(0, -9.81, 0);
    still.attachments = {hold(12, 300, 1)};
    still.attachments[0].target = Vec3(0.3, 1.8, 0.2);
    Scene carried = still;
    carried.root_motion = {two_keys()};
    carried.attachments[0].target.reset();
    carried.attachments[0].time = {0, 1};
    carried.attachments[0].position.assign(2, Vec3::Zero());
    for (const bool lanes : {false, true}) {
        Held<double> at_rest(tree, still, lanes), moved(tree, carried, lanes);
        const Vec3 v(3, -1, 2);
        moved.plan.splines = {steady_ground(v, Vec3::Zero(), Vec3::Zero())};
        moved.plan.attachments[0].course =
            QuinticSpline{{0, 2},
                          {*still.attachments[0].target, *still.attachments[0].target + 2 * v},
                          {v, v},
                          {Vec3::Zero(), Vec3::Zero()}};
        moved.state = make_state(moved.plan);
        for (int f = 0; f < 45; ++f) {
            at_rest.step();
            moved.step();
        }
        double off = 0;
        for (std::size_t i = 0; i < tree.size_bodies(); ++i)
            off = std::max(off, (at_rest.state.theta[i] - moved.state.theta[i]).norm());
        CAPTURE(lanes);
        CHECK(off < 1e-9);
        CHECK(at_rest.state.theta[12].norm() > 1e-3);
    }
}

TEST_CASE("Attachments act the same on any number of threads, and are absent where a scene has none") {
    const Tree tree = make_tree::random_tree(6000, 3);
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.wind = wind_preset("breeze");
    for (const int body : {50, 500, 2500, 5900}) {
        scene.attachments.push_back(hold(body, 100, 1));
        scene.attachments.back().target = Vec3(0.5, 1, 0.02 * body);
    }
    const std::uint64_t hash = hash_on_threads(tree, scene);
    scene.attachments.clear();
    Held<float> without(tree, scene, true);
    advance(without.plan, without.state);
    CHECK(without.state.calls[std::size_t(Stage::attachments)] == 0);
    CHECK(coupled_state(without.state).attachments.bodies.capacity() == 0);
    CHECK(coupled_state(without.state).attachments.all.capacity() == 0);
    CHECK(state_hash(without.plan, without.state) != hash);
}
