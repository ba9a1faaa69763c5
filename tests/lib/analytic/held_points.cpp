// Springs and dampers at points in the analytic step (held_points.h): against closed forms, the least energy, springs laid on by hand.
#include "lib/analytic/held_points.h"
#include "lib/plan/pushes.h"
#include "tests/support/held_tree.h"
#include "tests/support/solver_parts.h"
#include <catch2/catch.hpp>
#include <complex>

using namespace bough;
using namespace coupled;
using solver::empty_scene;

namespace {

template <class T> Held<T> analytic(const Tree& tree, const Scene& scene, double dt = 1.0 / 30) {
    return Held<T>(tree, scene, false, dt, Scheme::p12, Solver::analytic);
}

} // namespace

TEST_CASE("The analytic step holds a twig of 0.8 mm by springs of any stiffness and dampers of any strength") {
    check_grid<double>(Solver::analytic, false);
    check_grid<float>(Solver::analytic, true);
}

TEST_CASE("Under a rope a branch comes to rest in the analytic step where its energy is least") {
    check_rest(Solver::analytic, 6000, 1e-5);
}

// q'' + b q' + lambda q = f of one joint about one axis, a rod's tip held in its reach.
TEST_CASE("A joint that is held moves as an oscillator with the spring's stiffness beside its own, to second order") {
    const Tree tree = make_tree::chain(1, 1.0, 0.006, 0.004, 0, {800, 2e9, 2e8, 0.01});
    const double l = 0.9;
    for (const auto& [k, c] : {std::pair(30.0, 0.0), std::pair(200.0, 1.0), std::pair(0.0, 2.0), std::pair(1e3, 6.0)}) {
        Scene scene = empty_scene();
        scene.attachments = {hold(0, k, c)};
        scene.attachments[0].on.point = Vec3(0, 0, l);
        double errors[2];
        for (const int fine : {1, 2}) {
            const double h = 1.0 / (960 * fine), away = 1e-5; // [m]
            Held<double> run = analytic<double>(tree, scene, h);
            const Vec3 rest = run.point();
            parts::joints(run.state).held.all[0].target = rest + Vec3(away, 0, 0);
            const AnalyticPlan<double>& own = parts::joints(run.plan);
            const double f = own.inertia_factor[0][0],
                         S = f * f * (tree.inertia[0](1, 1) + tree.mass[0] * tree.com[0].squaredNorm()),
                         b = (tree.damping[0] * tree.stiffness[0].y() + c * l * l) / S,
                         lambda = (tree.stiffness[0].y() + k * l * l) / S, end = k * l * away / S / lambda;
            const std::complex<double> root = std::sqrt(std::complex<double>(b * b / 4 - lambda)), r1 = -b / 2 + root,
                                       r2 = -b / 2 - root;
            const double start = k > 0 ? 0 : 2e-5, way = start - end; // with a damper alone it is let go
            if (start != 0) {
                run.state.theta[0] = run.plan.theta_start[0] + Vec3(0, start, 0);
                restart(run.plan, run.state);
            }
            double most = 0;
            for (int n = 1; n <= 240 * fine; ++n) {
                advance(run.plan, run.state);
                const double t = n * h;
                const std::complex<double> q = way * (r2 * std::exp(r1 * t) - r1 * std::exp(r2 * t)) / (r2 - r1);
                most = std::max(most, std::abs(run.state.theta[0].y() - run.plan.theta_start[0].y() - end - q.real()));
            }
            errors[fine - 1] = most / std::abs(way);
        }
        CAPTURE(k, c, errors[0], errors[1]);
        CHECK(errors[0] < 0.03);
        CHECK(std::log2(errors[0] / errors[1]) > 1.7);
    }
}

// The springs' forces as what a program lays on its bodies, step by step, which small steps bear.
TEST_CASE("Attachments in the analytic step are the forces of their springs, as steps become small") {
    const Tree tree = paper_trees::branched(2e9, 0.01);
    Scene free = empty_scene();
    free.gravity = Vec3(0, -9.81, 0);
    Scene held = free;
    held.attachments = {hold(20, 50, 0.4), hold(12, 20, 0.1), hold(7, 30, 0.2)};
    held.attachments[0].target = Vec3(0.3, 2.2, 0.2);
    held.attachments[2].with = Selector();
    held.attachments[2].with->body = 17;
    held.attachments[2].target = Vec3(0.1, 0.1, 0);
    double errors[2], moved = 0;
    for (const int fine : {1, 4}) {
        const double h = 1.0 / (480 * fine);
        Held<double> run = analytic<double>(tree, held, h);
        Wishes wishes;
        wishes.loads = true;
        Plan<double> plan = make_plan<double>(tree, {{0, tree.size_bodies(), 0}}, free, wishes, h, Solver::analytic,
                                              Scheme::p12, std::nullopt);
        State<double> by_hand = make_state(plan);
        const HeldPoints<double>& points = parts::joints(run.state).held;
        const std::vector<Vec3> start = by_hand.x_w;
        std::vector<Vec3> before(3);
        double off = 0;
        for (int n = 0; n < 240 * fine; ++n) {
            by_hand.loads.clear();
            const auto at = [&](const AttachedEnd& end) {
                return Vec3(by_hand.x_w[end.body] + by_hand.R_wb[end.body] * end.point_b);
            };
            for (std::size_t k = 0; k < 3; ++k) {
                const Attached& of = points.all[k];
                const Vec3 e = at(of) - (of.far ? at(*of.far) : Vec3(Vec3::Zero())) - of.target;
                const Vec3 f =
                    -of.stiffness * e - of.damping * (n == 0 ? Vec3(Vec3::Zero()) : Vec3((e - before[k]) / h));
                before[k] = e;
                by_hand.loads.push_back({of.body, of.point_b, f});
                if (of.far) by_hand.loads.push_back({of.far->body, of.far->point_b, -f});
            }
            advance(plan, by_hand);
            run.step();
            for (std::size_t i = 0; i < plan.bodies; ++i) {
                off = std::max(off, (by_hand.x_w[i] - run.state.x_w[i]).norm());
                moved = std::max(moved, (by_hand.x_w[i] - start[i]).norm());
            }
        }
        errors[fine == 4] = off;
    }
    CAPTURE(moved, errors[0], errors[1]);
    CHECK(moved > 0.1);
    CHECK(errors[1] < 0.05 * moved);
    CHECK(errors[1] < 0.35 * errors[0]); // of first order, the hand's own
}

TEST_CASE(
    "What is held by a rod goes with it step by step in the analytic step, over twelve joints and between trees") {
    const Tree tree = twig();
    Scene scene = empty_scene();
    scene.attachments = {hold(11, 1e12, 0)};
    Held<double> still = analytic<double>(tree, scene);
    const Vec3 start = still.point();
    scene.attachments[0].time = {0, 0.5, 1};
    scene.attachments[0].position = {start, start + Vec3(0.08, -0.03, 0.05), start};
    Held<double> run = analytic<double>(tree, scene);
    double off = 0;
    for (int f = 0; f < 30; ++f) {
        run.step();
        off = std::max(off, (run.point() - curve_at(*run.plan.attachments[0].course, (f + 1) / 30.0).x).norm());
    }
    CHECK(off < 2e-3);
}

TEST_CASE("The analytic step has what it needs for attachments where a scene has some, and runs one joint at a time") {
    const Tree tree = twig();
    Scene scene = empty_scene();
    scene.gravity = Vec3(0, -9.81, 0);
    Held<float> without(tree, scene, true, 1.0 / 30, Scheme::p12, Solver::analytic);
    CHECK(without.plan.stepper->in_lanes());
    Held<double> plain = analytic<double>(tree, scene);
    plain.step();
    CHECK(plain.state.calls[std::size_t(Stage::attachments)] == 0);
    CHECK(parts::joints(plain.state).held_tau_w.capacity() == 0);
    CHECK(parts::joints(plain.state).held_row.capacity() == 0);
    CHECK(parts::joints(plain.state).held.joints.capacity() == 0);
    scene.attachments = {hold(11, 10, 0)};
    Held<float> with(tree, scene, true, 1.0 / 30, Scheme::p12, Solver::analytic);
    CHECK(with.plan.stepper->kind().plainly == "/attachments");
    with.step();
    CHECK(with.state.calls[std::size_t(Stage::attachments)] == 1);
}

TEST_CASE("The bytes of a state are also those of the points that it holds") {
    const Tree tree = twig(); // of 12 bodies, of which the outermost is carried by all
    Scene scene = empty_scene();
    const std::size_t without = analytic<double>(tree, scene).state.bytes();
    scene.attachments = {hold(11, 10, 0), hold(3, 10, 0)};
    scene.attachments[1].with = Selector{};
    scene.attachments[1].with->body = 7;
    Held<double> run = analytic<double>(tree, scene);
    const std::size_t loads = 12 * 4 * sizeof(double), equations = (2 * 6 * 6 + 2 * 6) * sizeof(double);
    const std::size_t with =
        without + loads + 12 * sizeof(HeldJoint<double>) + 2 * (sizeof(Attached) + sizeof(HeldForce)) + equations;
    CHECK(run.state.bytes() == with);
    run.step();
    CHECK(run.state.bytes() == with);
}
