// Pulls whose points and forces turn with their bodies (pulled_points.h): against closed forms, the reference, in lanes. (One step against dense
// algebra: coupled_step.cpp.)
#include "lib/coupled/pulled_points.h"
#include "formats/files.h"
#include "lib/analytic/analytic_stepper.h"
#include "lib/base/parallel.h"
#include "tests/support/held_tree.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;
using namespace coupled;
using solver::empty_scene;

namespace {

Pull steady(std::int64_t body, const Vec3& point_b, const Vec3& force, bool in_body) {
    Pull pull;
    pull.on.body = body;
    pull.on.point = point_b;
    pull.time = {0, 1000};
    pull.force = {force, force};
    pull.in_body = in_body;
    return pull;
}

} // namespace

// (At 7 N and more it leaves its plane: flutter, as Beck's column has it.) From the tip, in whose axes the force is known, joint by joint: each turns by the moment over its stiffness.
TEST_CASE("A force that turns with a branch's end bends it as the balance from its end says, by up to 1.9 rad") {
    const int n = 8;
    const Tree tree = make_tree::chain(n, 1.0, 0.006, 0.004, 0, {800, 2e9, 2e8, 0.05});
    for (const double size : {0.2, 2.0, 4.0}) {
        Scene scene = empty_scene();
        scene.pulls = {steady(n - 1, Vec3(0, 0, 1.0 / n), Vec3(size, 0, 0.3 * size), true)};
        Held<double> run(tree, scene, false);
        for (int f = 0; f < 3000; ++f) advance(run.plan, run.state);
        Vec3 f(size, 0, 0.3 * size), place(0, 0, 1.0 / n);
        double turned = 0;
        for (std::size_t i = n; i-- > 0;) {
            const double angle = place.cross(f).y() / tree.stiffness[i].y();
            CAPTURE(size, i, angle, run.state.theta[i].transpose());
            CHECK((run.state.theta[i] - Vec3(0, angle, 0)).norm() < 1e-9);
            const Mat3 R(Eigen::AngleAxisd(angle, Vec3::UnitY()));
            f = R * f;
            place = R * place + tree.joint_position[i];
            turned += angle;
        }
        if (size > 3) CHECK(turned > 1.9);
    }
}

TEST_CASE("A rod is moved by no force that goes through its joint and turns with it, however large") {
    const Tree tree = make_tree::chain(1, 1.0, 0.006, 0.004, 0, {800, 2e9, 2e8, 0.01});
    Scene scene = empty_scene();
    scene.gravity = Vec3(4, -9.81, 2);
    for (const double size : {-1e6, -1.0, 1e3}) {
        Held<double> without(tree, scene, false);
        Scene pressed = scene;
        pressed.pulls = {steady(0, Vec3(0, 0, 0.7), Vec3(0, 0, size), true)};
        Held<double> with(tree, pressed, false);
        double moved = 0, off = 0;
        for (int f = 0; f < 60; ++f) {
            without.step();
            with.step();
            moved = std::max(moved, without.state.theta[0].norm());
            off = std::max(off, (with.state.theta[0] - without.state.theta[0]).norm());
        }
        CAPTURE(size, moved);
        CHECK(moved > 1e-3);
        CHECK(off < 1e-15 * std::max(10.0, std::abs(size)));
    }
}

// M. Beck, 1952: a cantilever that a force along its end presses flutters from 20.05 E I / L^2 on; a dead one would have it buckle at 2.47.
TEST_CASE("A column flutters under a force that turns with its end from Beck's on, and not before") {
    const int n = 16;
    const Tree tree = make_tree::chain(n, 1.0, 0.005, 0.005, 0, {800, 2e9, 2e8, 0});
    const double EI = 2e9 * std::numbers::pi * std::pow(0.005, 4) / 4;
    for (const double part : {0.9, 1.1}) {
        Scene scene = empty_scene();
        Pull kick = steady(n - 1, Vec3::Zero(), Vec3(1e-3, 0, 0), false);
        kick.time[1] = 0.05;
        scene.pulls = {steady(n - 1, Vec3(0, 0, 1.0 / n), Vec3(0, 0, -part * 20.05 * EI), true), kick};
        Held<double> run(tree, scene, false, 1e-3);
        double most = 0;
        for (int f = 0; f < 3000; ++f) {
            run.step();
            most = std::max(most, std::hypot(run.state.x_w[n - 1].x(), run.state.x_w[n - 1].z()));
        }
        CAPTURE(part, most);
        CHECK((part < 1 ? most < 1e-3 : most > 0.1));
    }
}

TEST_CASE("A twig of 0.8 mm that is pulled at its end by 0.1 to 100 N comes to rest along the force at 1/30 s") {
    const Tree tree = twig();
    const auto check = [&]<class T>(T, bool lanes) {
        for (const double size : {0.1, 1.0, 10.0, 100.0})
            for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0.5, 0.2, -0.7)}) {
                Scene scene = empty_scene();
                scene.gravity = Vec3(0, -9.81, 0);
                scene.pulls = {steady(11, Vec3(0, 0, 0.03), size * way, false)};
                Held<T> run(tree, scene, lanes);
                for (int f = 0; f < 240; ++f) run.step();
                CAPTURE(sizeof(T), lanes, size, way.transpose(), run.kinetic());
                CHECK(run.kinetic() < 1e-9);
                const Vec3 along = run.state.R_wb[11].col(2).template cast<double>();
                if (size >= 1) CHECK(along.dot(way.normalized()) > 0.9999);
            }
    };
    check(double(), false);
    check(double(), true);
    check(float(), true);
}

// Branches of trees as they are grown. With a bound of H that left out what couples turns about P and across it, they go on by 12 to 22 m/s.
TEST_CASE("A branch that a force presses along itself comes to rest at 1/30 s, in both precisions") {
    struct Pressed {
        std::uint64_t seed;
        std::int64_t body;
        double force; // [N] at its end, towards its base
    };
    for (const Pressed& pressed :
         {Pressed{3, 170, 500}, Pressed{3, 161, 100}, Pressed{7, 51, 100}, Pressed{7, 220, 200}}) {
        const Tree tree = convert(grow("apple", {.bodies = 300, .seed = pressed.seed}));
        Scene scene;
        scene.wind = wind_preset("calm");
        const auto body = std::size_t(pressed.body);
        const Held<double> start(tree, scene, false);
        scene.pulls = {steady(pressed.body, Vec3(0, 0, tree.size[body][0]),
                              -pressed.force * start.state.R_wb[body].col(2), false)};
        const auto check = [&]<class T>(T, bool lanes) {
            Held<T> run(tree, scene, lanes);
            Vec3 before = run.state.x_w[body].template cast<double>();
            double early = 0, late = 0; // [m] in a step
            for (int f = 0; f < 360; ++f) {
                run.step();
                const Vec3 now = run.state.x_w[body].template cast<double>();
                const double way = (now - before).norm();
                before = now;
                if (f < 60) early = std::max(early, way);
                if (f >= 300) late = std::max(late, way);
            }
            CAPTURE(sizeof(T), lanes, pressed.seed, pressed.body, pressed.force, early, late);
            CHECK(early > 1e-2);
            CHECK(late < 0.05 * early);
        };
        check(double(), false);
        check(double(), true);
        check(float(), true);
    }
}

TEST_CASE("Pulls in the world's axes and in bodies' move trees as the reference's, and the error falls with the square "
          "of the step") {
    coupled::Motion motion{paper_trees::branched(2e9, 0.01), empty_scene(), 30};
    motion.scene.gravity = Vec3(0, -9.81, 0);
    Pull jet = pull_on(20, Vec3(3, 1, -4), Vec3(-2, 3, 5)), dead = pull_on(12, Vec3(1, -8, 0), Vec3(4, 0, 3));
    jet.in_body = true;
    motion.scene.pulls = {jet, dead};
    const Track truth = truth_of(motion);
    const double coarse = error_of(motion, truth, Scheme::p12, 1), fine = error_of(motion, truth, Scheme::p12, 4);
    CAPTURE(coarse, fine);
    CHECK(coarse < 0.05);
    CHECK(order_at(motion, truth, Scheme::p12, 4) > 1.8);
    CHECK(order_at(motion, truth, Scheme::p34, 4) > 1.8);
}

TEST_CASE("Pulls act in lanes as one number at a time, in both precisions, and the same on any number of threads") {
    const Tree tree = leafy(2e9, 0.01);
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.wind = wind_preset("gusty");
    scene.attachments = {hold(15, 60, 1)};
    Pull jet = pull_on(12, Vec3(3, 1, -4), Vec3(-2, 3, 5)), leaf = pull_on(22, Vec3(0, 1e-3, 0), Vec3(0, 2e-3, 0));
    jet.in_body = leaf.in_body = true;
    scene.pulls = {jet, leaf, pull_on(12, Vec3(1, -8, 0), Vec3(4, 0, 3)), pull_on(20, Vec3(0, 0, 3), Vec3(0, 5, 0))};
    check_lanes(tree, scene, [](const Held<double>&, const Held<double>&) {});
    const Tree large = make_tree::random_tree(3000, 3);
    Scene many = empty_scene();
    many.wind = wind_preset("breeze");
    for (const int body : {50, 500, 2500})
        many.pulls.push_back(steady(body, Vec3::Zero(), Vec3(0.3, 0, 0.2), body != 500));
    hash_on_threads(large, many);
    CHECK_THROWS_WITH(refuse_with_analytic(many), Catch::Contains("pulls/0/axes"));
}
