// Attachments between two bodies (attachment_ties.h): against the reference and statics, in lanes, of any stiffness, over threads and scenes.
// (One step against dense algebra, pairs among it: coupled_step.cpp.)
#include "lib/coupled/attachment_ties.h"
#include "lib/base/parallel.h"
#include "lib/coupled/coupled_rows.h"
#include "lib/simulation/simulation.h"
#include "tests/support/held_tree.h"
#include <catch2/catch.hpp>

using namespace bough;
using namespace coupled;
using solver::empty_scene;

namespace {

Attachment tie(std::int64_t body, std::int64_t other, double k, double c) {
    Attachment held = hold(body, k, c);
    held.with = Selector();
    held.with->body = other;
    held.with->point = Vec3(0, 0, 0.03);
    return held;
}

Tree beside(Tree tree, const Vec3& by) {
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.parent[i] < 0) tree.joint_position[i] += by;
    return tree;
}

// Two twigs 0.2 m apart.
Tree twigs() {
    return make_tree::forest({twig(), beside(twig(), Vec3(0.2, 0, 0))});
}

// Of both points, as seen from where they were.
template <class T> Vec3 apart(const Held<T>& run, std::size_t k = 0) {
    return run.point(run.held(k)) - run.point(*run.held(k).far);
}

} // namespace

TEST_CASE("Two twigs of 0.8 mm are tied by springs of any stiffness and dampers of any strength at 1/30 s") {
    const Tree tree = twigs();
    const auto check = [&]<class T>(T, bool lanes) {
        for (const double k : {0.0, 1e-3, 1.0, 20.0, 1e3, 1e5, 1e7, 1e9, 1e12})
            for (const double c : {0.0, 1e-2, 1.0, 1e3, 1e9}) {
                if (k == 0 && c == 0) continue;
                // Drawn together, held as far apart as they are, pressed away from each other; of both, the first three times as long as they reach.
                for (const Vec3& target : {Vec3(0, 0, 0), Vec3(-0.2, 0, 0), Vec3(-0.5, 0.1, 0.1), Vec3(-1.6, 0, 0.3)}) {
                    Scene scene = empty_scene();
                    scene.gravity = Vec3(0, -9.81, 0);
                    scene.attachments = {tie(11, 23, k, c)};
                    scene.attachments[0].target = target;
                    Held<T> run(tree, scene, lanes);
                    CAPTURE(sizeof(T), lanes, k, c, target.transpose());
                    const auto [early, third, last] = run.energies();
                    CHECK(run.largest_angle() < 3.2);
                    CHECK(last <=
                          std::min(0.05 * early, 1.05 * third) + 5e-5); // [J] they fall by their lengths for 1e-3
                    if (target.norm() < 0.3 && k >= 1e3 && c <= k / 10) CHECK((apart(run) - target).norm() < 0.05);
                }
            }
    };
    check(double(), false);
    check(double(), true);
    check(float(), false);
    check(float(), true);
}

TEST_CASE("Tied bodies move in lanes as they do one number at a time, in both precisions, under every load") {
    const Tree one = leafy(2e9, 0.01);
    const auto n = std::int64_t(one.size_bodies());
    const Tree tree = make_tree::forest({one, beside(one, Vec3(0.8, 0, 0.3))});
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.wind = wind_preset("gusty");
    scene.attachments = {tie(12, n + 20, 200, 0.5), tie(22, 9, 30, 0), hold(9, 0, 2), tie(n + 15, 15, 0, 3),
                         tie(n + 5, 5, 1e7, 0)};
    scene.attachments[0].target = Vec3(-0.5, 0.1, 0);
    scene.attachments[1].from = 0.3;
    scene.attachments[1].to = 1.2;
    scene.attachments[3].time = {0, 1, 2};
    scene.attachments[3].position = {Vec3(0.8, 0, 0.3), Vec3(0.5, 0.1, 0.2), Vec3(0.8, 0, 0.3)};
    for (const Scheme scheme : {Scheme::p12, Scheme::p34}) {
        Held<double> plain(tree, scene, false, 1.0 / 120, scheme), lanes(tree, scene, true, 1.0 / 120, scheme);
        Held<float> single(tree, scene, true, 1.0 / 120, scheme), plain_single(tree, scene, false, 1.0 / 120, scheme);
        double moved = 0, off = 0, off_single = 0, off_plain = 0;
        for (int f = 0; f < 240; ++f) {
            plain.step();
            lanes.step();
            single.step();
            plain_single.step();
            for (std::size_t i = 0; i < plain.plan.bodies; ++i) {
                const Vec3& x = plain.state.x_w[i];
                if (tree.parent[i] >= 0) moved = std::max(moved, plain.state.theta[i].norm());
                off = std::max(off, (x - lanes.state.x_w[i]).norm());
                off_single = std::max(off_single, (x - single.state.x_w[i].cast<double>()).norm());
                off_plain = std::max(off_plain, (x - plain_single.state.x_w[i].cast<double>()).norm());
            }
        }
        CAPTURE(scheme_of(scheme).name);
        CHECK(moved > 0.05);
        CHECK(off < 1e-9);
        CHECK(off_single < 5e-3);
        CHECK(off_plain < 5e-3);
        for (std::size_t k = 0; k < scene.attachments.size(); ++k)
            CHECK((plain.held(k).force - lanes.held(k).force).norm() < 1e-6 * (1 + plain.held(k).force.norm()));
    }
}

// Where the sum of elastic, potential and the spring's energy is least, by differences of it: none of the solver's equations.
TEST_CASE("Two branches that are tied come to rest where their energy is least, and the tie's force is what it says") {
    const Tree rod = make_tree::chain(5, 1.0, 0.006, 0.004, 0.1, {800, 2e9, 2e8, 0.05});
    const Tree tree = make_tree::forest({rod, beside(rod, Vec3(0.4, 0, 0))});
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.pose = Pose::rest;
    for (const double k : {5.0, 300.0, 1e6}) {
        scene.attachments = {tie(3, 9, k, 1)};
        scene.attachments[0].target = Vec3(-0.1, 0.05, 0.05);
        Held<double> run(tree, scene, false);
        for (int f = 0; f < 3000; ++f) advance(run.plan, run.state);
        present(run.plan, run.state);
        check_least(run, tree, k, 2e-6, [&](const Eigen::VectorXd& theta) {
            Vec3 between = Vec3::Zero();
            const auto visit = [&](std::size_t i, const Vec3& x, const Mat3& R) {
                if (i == 3) between += x + R * Vec3(0, 0, 0.03);
                if (i == 9) between -= x + R * Vec3(0, 0, 0.03);
            };
            const double own =
                chain_energy(tree, scene, theta, 0, 5, visit) + chain_energy(tree, scene, theta, 5, 10, visit);
            return own + k / 2 * (between - *scene.attachments[0].target).squaredNorm();
        });
        const Vec3 force = k * (*scene.attachments[0].target - apart(run));
        CHECK((run.held().force - force).norm() < 1e-6 * force.norm());
    }
}

TEST_CASE("Trees that are tied move as the reference's, and their error falls with the square of the step") {
    const Tree one = paper_trees::branched(2e9, 0.01);
    const auto n = std::int64_t(one.size_bodies());
    coupled::Motion motion{make_tree::forest({one, beside(one, Vec3(0.9, 0, 0))}), empty_scene(), 30};
    motion.scene.gravity = Vec3(0, -9.81, 0);
    motion.scene.attachments = {tie(20, n + 12, 50, 0.4), tie(n + 5, 5, 400, 2), tie(9, 15, 20, 0)};
    const Held<double> start(motion.tree, motion.scene, false);
    check_order(motion, apart(start, 0), apart(start, 1));
}

TEST_CASE("Tied bodies act the same on any number of threads; without ties nothing of them is there") {
    const Tree one = make_tree::random_tree(3000, 3);
    const Tree tree =
        make_tree::forest({one, beside(one, Vec3(3, 0, 0)), beside(make_tree::random_tree(40, 4), Vec3(6, 0, 0))});
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    scene.wind = wind_preset("breeze");
    for (const int body : {50, 500, 2500}) scene.attachments.push_back(tie(body, 3000 + body, 100, 1));
    scene.attachments.push_back(tie(3010, 6010, 1e5, 0));
    hash_on_threads(tree, scene, [](const Held<float>& run) { CHECK(run.held(0).force.norm() > 0); });
    for (Attachment& held : scene.attachments) {
        held.with.reset();
        held.target = Vec3(0, 1, 0);
    }
    Held<float> without(tree, scene, true);
    advance(without.plan, without.state);
    CHECK(coupled_state(without.state).attachments.ties.capacity() == 0);
    CHECK(coupled_state(without.state).attachments.solved.capacity() == 0);
    CHECK(coupled_state(without.state).attachments.answers.size() == 0);
}

TEST_CASE("A scene ties two of its trees; what cannot be tied is refused; a run that is cut goes on bit by bit") {
    Scene scene;
    const Tree one = paper_trees::branched(2e9, 0.01);
    scene.add(one);
    scene.add(one, Vec3(1, 0, 0), 90);
    scene.wind = wind_preset("breeze");
    scene.attachments = {tie(5, 5, 500, 1)};
    scene.attachments[0].with->tree = 1;
    Simulation tied(scene);
    const std::size_t other = one.size_bodies() + 5;
    const auto between = [&] { return Vec3(tied.positions()[5] - tied.positions()[other]); };
    const Vec3 start = between();
    Scene loose = scene;
    loose.attachments.clear();
    Simulation apart(loose);
    for (int f = 0; f < 60; ++f) {
        tied.step();
        apart.step();
    }
    CHECK((between() - start).norm() < 0.5 * (apart.positions()[5] - apart.positions()[other] - start).norm() + 1e-4);
    CHECK(tied.hash() != apart.hash());
    const SavedState saved = tied.save();
    Simulation again(scene);
    again.restore(saved);
    for (int f = 0; f < 20; ++f) {
        tied.step();
        again.step();
    }
    CHECK(again.hash() == tied.hash());

    const auto refused = [](Scene wrong, const SimulationOptions& o = {}) -> std::string {
        try {
            const Simulation simulation(std::move(wrong), o);
        } catch (const SceneError& error) {
            return error.what();
        }
        return "";
    };
    Scene wrong = scene;
    wrong.attachments[0].with->by = Selector::By::level;
    CHECK_THAT(refused(wrong), Catch::Contains("/attachments/0/with: is by level"));
    wrong = scene;
    wrong.attachments[0].with->tree = 0;
    CHECK_THAT(refused(wrong), Catch::Contains("/attachments/0/with") && Catch::Contains("expected another"));
    wrong.attachments[0].with->body = 10000;
    CHECK_THAT(refused(wrong), Catch::Contains("/attachments/0/with"));
}

TEMPLATE_TEST_CASE("The bytes of a state are also those of the points that it holds, and are what its plan says", "",
                   float, double) {
    using T = TestType;
    const Tree tree = twig(); // of 12 bodies, of which the outermost is carried by all
    Scene scene = empty_scene();
    scene.attachments = {hold(11, 10, 0), tie(3, 7, 10, 0)};
    for (const bool lanes : {false, true}) {
        CAPTURE(lanes);
        const Held<T> bare(tree, empty_scene(), lanes);
        Held<T> run(tree, scene, lanes);
        const std::size_t without = bare.state.bytes() + // where ties are, trees wait for them between the sweeps
                                    (lanes ? parts::lanes(run.state).bytes() - parts::lanes(bare.state).bytes() : 0);
        const std::size_t bodies = 12 * (sizeof(AttachedBody) + sizeof(SolvedBody) + sizeof(std::size_t));
        // Three unknowns, which factors solve for.
        const std::size_t equations = (2 * 3 * 3 + 2 * 3) * sizeof(std::complex<double>);
        const std::size_t points = 2 * sizeof(Attached) + sizeof(Tie) + bodies + equations;
        // A number for each row; for one that has an attached body, a record inward and a complex symmetric matrix.
        const std::size_t rows = lanes ? parts::lanes(run.plan).layout.rows * sizeof(std::int32_t) +
                                             12 * (fast::inward::count + 12) * sizeof(fast::Row<T>)
                                       : 0;
        CHECK(run.state.bytes() == without + points + rows);
        for (int k = 0; k < 2; ++k) {
            std::size_t planned = 0;
            for (const PlannedArray& array : explain(run.plan).arrays) planned += array.on ? array.bytes : 0;
            CHECK(run.state.bytes() == planned);
            run.step();
        }
    }
}
