// Springs and dampers at points (attachment.h): against the reference and statics, in lanes, of any stiffness, over threads and cuts.
#include "lib/coupled/attachment.h"
#include "formats/files.h"
#include "lib/base/parallel.h"
#include "tests/support/held_tree.h"
#include <catch2/catch.hpp>

using namespace bough;
using namespace coupled;
using solver::empty_scene;

TEST_CASE("A twig of 0.8 mm is held by springs of any stiffness and dampers of any strength at 1/30 s") {
    check_grid<double>(Solver::coupled, false);
    check_grid<double>(Solver::coupled, true);
    check_grid<float>(Solver::coupled, true);
}

struct Pressed {
    const char* species;
    std::uint64_t seed;
    std::int64_t body;
    double by; // [m] that its tip is led towards its base in a second, and stays
};

// The way of the body's joint in a step [m], at most: in the first two seconds and in the last two of twelve.
template <class T>
std::pair<double, double> early_and_late(const Tree& tree, const Pressed& pressed, double k, double hertz, bool lanes) {
    Scene scene;
    scene.wind = wind_preset("calm");
    scene.attachments = {hold(pressed.body, k, 1)};
    const auto body = std::size_t(pressed.body);
    scene.attachments[0].on.point = Vec3(0, 0, tree.size[body][0]);
    const Held<double> start(tree, scene, false);
    const Vec3 tip = start.point();
    scene.attachments[0].time = {0, 1};
    scene.attachments[0].position = {tip, tip - pressed.by * start.state.R_wb[body].col(2)};
    Held<T> run(tree, scene, lanes, 1 / hertz);
    Vec3 before = run.state.x_w[body].template cast<double>();
    double early = 0, late = 0;
    for (int f = 0; f < 12 * hertz; ++f) {
        run.step();
        const Vec3 now = run.state.x_w[body].template cast<double>();
        const double way = (now - before).norm();
        before = now;
        if (f < 2 * hertz) early = std::max(early, way);
        if (f >= 10 * hertz) late = std::max(late, way);
    }
    return {early, late};
}

void check_rests(const Pressed& pressed, double k, double hertz) {
    const Tree tree = convert(grow(pressed.species, {.bodies = 300, .seed = pressed.seed}));
    const auto check = [&]<class T>(T, bool lanes) {
        const auto [early, late] = early_and_late<T>(tree, pressed, k, hertz, lanes);
        CAPTURE(sizeof(T), lanes, k, hertz, pressed.species, pressed.seed, pressed.body, pressed.by, early, late);
        CHECK(early > 1e-3);
        CHECK(late < 0.05 * early);
    };
    check(double(), false);
    check(double(), true);
    check(float(), false);
    check(float(), true);
}

// Branches of trees as they are grown. With a bound of H that left out what couples turns about P and across it, they trembled for ever, by 1 to 30 m/s.
TEST_CASE("A branch that is pressed along itself comes to rest at 1/30 s, in both precisions") {
    for (const Pressed& pressed :
         {Pressed{"apple", 7, 64, 0.46}, Pressed{"apple", 7, 64, 0.93}, Pressed{"apple", 7, 148, 0.53},
          Pressed{"apple", 7, 191, 0.31}, Pressed{"apple", 3, 103, 0.73}, Pressed{"pine", 7, 63, 1.54},
          Pressed{"pine", 7, 107, 1.67}})
        check_rests(pressed, 1e3, 30);
}

// Where rounding took 0.01 of a path's masses in double, the pines went on by 5 m/s. With the whole of the last step's force in the target's shift,
// the others went on in float by 30 to 50 m/s.
TEST_CASE("A branch that a spring of 1e9 N/m presses along itself comes to rest, in both precisions") {
    for (const Pressed& pressed : {Pressed{"pine", 7, 149, 1.00}, Pressed{"pine", 7, 89, 1.61}})
        check_rests(pressed, 1e9, 30);
    for (const Pressed& pressed : {Pressed{"willow", 7, 270, 0.17}, Pressed{"apple", 3, 90, 0.48}})
        check_rests(pressed, 1e9, 120);
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
    check_lanes(tree, scene, [](const Held<double>& plain, const Held<double>& lanes) {
        for (std::size_t k = 0; k < 4; ++k)
            CHECK((plain.held(k).force - lanes.held(k).force).norm() < 1e-6 * (1 + plain.held(k).force.norm()));
    });
}

TEST_CASE("Under a rope a branch comes to rest where its energy is least, and the rope's force is what it says") {
    check_rest(Solver::coupled, 3000, 2e-6);
}

TEST_CASE("A tree that is held moves as the reference's, and its error falls with the square of the step") {
    coupled::Motion motion{paper_trees::branched(2e9, 0.01), empty_scene(), 30};
    motion.scene.gravity = Vec3(0, -9.81, 0);
    motion.scene.attachments = {hold(20, 50, 0.4), hold(12, 400, 2)};
    const Held<double> start(motion.tree, motion.scene, false);
    check_order(motion, start.point(0), start.point(1));
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

// The springs' own forces grow at every step, as none reaches its target: until rounding moved what is between them, and rates became infinite.
TEST_CASE("A twig that springs of 1e8 N/m draw to three places out of its reach comes to rest, in both precisions") {
    const Tree tree = make_tree::chain(3, 0.07, 0.0012, 0.0008, 0.03, {800, 5e9, 5e8, 0.01});
    Scene scene = empty_scene();
    scene.attachments = {hold(2, 2e9, 0.5), hold(1, 2e8, 4e8), hold(1, 3e9, 2e6)};
    scene.attachments[0].target = Vec3(0.2, 0.3, 0.1);
    scene.attachments[1].target = Vec3(-0.7, -0.4, 0.3);
    scene.attachments[2].target = Vec3(0.1, -0.1, 0.2);
    for (std::size_t k = 0; k < 3; ++k) scene.attachments[k].on.point = Vec3(0, 0, k == 2 ? 0.02 : 0.015);
    const auto check = [&]<class T>(T, bool lanes) {
        Held<T> run(tree, scene, lanes);
        double last = 0;
        for (int f = 0; f < 900; ++f) {
            run.step();
            REQUIRE(std::isfinite(run.kinetic()));
            if (f >= 840) last = std::max(last, run.kinetic());
        }
        CAPTURE(sizeof(T), lanes);
        CHECK(last < 1e-4);
    };
    check(double(), false);
    check(double(), true);
    check(float(), true);
}
