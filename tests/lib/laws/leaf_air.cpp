// Leaves and petals that hang, with /leaves and without: their three springs by three frequencies, forces and torque in the wind, the steps' limits,
// lanes, and the grid of extremes. (Those that fly: tests/lib/free/leaf_flight.cpp.)
#include "lib/study/articulated.h"
#include "lib/study/ring_down.h"
#include "lib/study/stability.h"
#include "tests/support/coupled_support.h"
#include "tests/support/inverse_dynamics.h"
#include "tests/support/lanes_support.h"
#include "tests/support/sanitized.h"
#include "tests/support/solver_parts.h"

using namespace bough;

namespace {

constexpr LeafAir spiralling{0.4, 6, 4, 25};

Tree one_leaf(Kind kind = Kind::leaf) {
    Tree tree;
    tree.name = "leaf";
    make_tree::add_leaf(tree, -1, {0, 1, 0}, make_tree::turn(0.4, Vec3(1, 2, 0)), 0.07, 0.05, 3e-4, 0, 0, 0);
    tree.kind[0] = kind;
    return tree;
}

// 28 bodies, of which the five leaves hold their own weight in a wind.
Tree leafy(double stiffer = 20) {
    Tree tree = coupled::leafy(1e9, 0.01);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == Kind::leaf) tree.stiffness[i] *= stiffer;
    return tree;
}

Wind steady(const Vec3& velocity) {
    Wind wind;
    wind.profile = 0;
    wind.velocity = velocity;
    return wind;
}

Scene with_leaves(Scene scene, const LeafAir& leaves = spiralling) {
    scene.leaves = leaves;
    return scene;
}

using lanes::Simd;
const Simd plainly = std::nullopt;

struct Path {
    const char* name;
    Solver solver;
    Simd simd;
};
std::vector<Path> paths() {
    return {{"coupled", Solver::coupled, plainly},
            {"coupled, lanes", Solver::coupled, fast::best_target()},
            {"analytic", Solver::analytic, plainly},
            {"analytic, lanes", Solver::analytic, fast::best_target()}};
}

// Force and torque about the centre of mass by matrices in the leaf's own axes, written from the paper, (23), (24), and from air.h: folding, turning.
struct LeafLoad {
    Vec3 force, torque;
};
LeafLoad paper_load(const LeafAir& by, const Tree& tree, std::size_t i, const Mat3& R, const Vec3& u,
                    const Vec3& omega) {
    const double A = tree.size[i][0] * tree.size[i][1] / 2, phi = by.offset * std::acos(-1.0) / 180;
    const Vec3 v = R.transpose() * u, n(0, 1, 0), vn = v.dot(n) * n, vt = v - vn;
    const Mat3 nx = cross_matrix(n);
    const double g = 1 / (1 + v.norm() / 7.5); // folding at 7.5 m/s; a quarter of the drag from all sides
    const Vec3 f = by.kappa * 1.2 * A * g * v.norm() * (vn + 0.25 * vt) +
                   by.air_resistance * tree.mass[i] * (vn + vt / by.drag_ratio);
    const Vec3 t = by.kappa * 1.2 * A / 2 * std::sqrt(A / std::acos(-1.0)) * v.dot(n) *
                       (nx * (v * std::cos(phi) + nx * v * std::sin(phi))) -
                   (by.air_resistance + 6 * g * v.norm() * by.kappa * 1.2 * A / tree.mass[i]) * tree.inertia[i] *
                       (R.transpose() * omega);
    return {R * f, R * t};
}

} // namespace

TEST_CASE("A leaf's three stiffnesses ring at three frequencies, its prism's about the joint") {
    // Second moments of a triangle of height l and base w about the middle of its base: l^2/6 along it, w^2/24 across; t^2/12 through a plate.
    const double l = 0.07, w = 0.05, t = 3e-4, m = 700 * t * l * w / 2;
    const double inertia[3] = {m * (l * l / 6 + t * t / 12), m * (l * l / 6 + w * w / 24),
                               m * (w * w / 24 + t * t / 12)};
    const double wanted[3] = {1.1, 1.7, 2.3}; // [Hz] flap, sway, twist
    for (const Kind kind : {Kind::leaf, Kind::petal}) {
        Tree tree = one_leaf(kind);
        for (int k = 0; k < 3; ++k) tree.stiffness[0][k] = inertia[k] * std::pow(2 * std::numbers::pi * wanted[k], 2);
        tree.damping[0] = 0;
        for (const Path& path : paths())
            for (int axis = 0; axis < 3; ++axis) {
                Plan<double> plan = make_plan<double>(tree, {{0, 1, 0}}, solver::empty_scene(), {}, 1.0 / 30,
                                                      path.solver, Scheme::p12, path.simd);
                State<double> state = make_state(plan);
                state.theta[0][axis] = 0.01;
                restart(plan, state);
                std::vector<double> y;
                for (int k = 0; k < 90; ++k) {
                    present(plan, state);
                    y.push_back(state.theta[0][axis]);
                    CHECK(state.theta[0].norm() == Approx(std::abs(y.back())).margin(1e-9));
                    advance(plan, state);
                }
                CAPTURE(path.name, axis);
                CHECK(fit_damped_sinusoid(y, plan.dt, wanted[axis]).frequency == Approx(wanted[axis]).epsilon(2e-3));
            }
    }
}

TEST_CASE("In a steady wind leaves come to rest where (23), (24), weight and springs balance") {
    const Tree tree = leafy(100);
    Scene scene = with_leaves({});
    scene.wind = steady(Vec3(6, 0, 2));
    for (const Path& path : paths()) {
        Plan<double> plan = make_plan<double>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, 1.0 / 30, path.solver,
                                              Scheme::p12, path.simd);
        REQUIRE(plan.stepper->in_lanes() == path.simd.has_value());
        State<double> state = make_state(plan);
        for (int k = 0; k < 9000; ++k) advance(plan, state);
        present(plan, state);
        double torques = 0, moments = 0;
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            CAPTURE(path.name, i);
            CHECK(state.theta_dot[i].norm() < 1e-8);
            if (!is_flat(tree.kind[i])) continue;
            const Mat3& R = state.R_wb[i];
            const Vec3 c = R * tree.com[i];
            const LeafLoad load = paper_load(spiralling, tree, i, R, scene.wind->velocity, Vec3::Zero());
            const Vec3 moment = c.cross(Vec3(load.force + tree.mass[i] * scene.gravity)) + load.torque;
            const Vec3 spring =
                body_rate_jacobian_inverse(state.theta[i]).transpose() * tree.stiffness[i].cwiseProduct(state.theta[i]);
            CHECK((R.transpose() * moment - spring).norm() <= 1e-7 * spring.norm());
            torques += load.torque.norm();
            moments += moment.norm();
        }
        CHECK(torques > 0.05 * moments); // or nothing was looked at
    }
}

TEST_CASE("What the articulated reference accelerates a leaf by is (23) and (24), and inverse dynamics give it back") {
    Scene with = with_leaves(solver::empty_scene());
    with.wind = steady(Vec3(3, 1, -2));
    const Tree leaf = one_leaf();
    const Plan<double> alone = make_plan<double>(leaf, {{0, 1, 0}}, with, {}, 1.0 / 30, Solver::articulated_reference);
    State<double> at = make_state(alone);
    solver::shake(alone, at, 6, 0.7, 8);
    const std::vector<BodyMotion> b = body_motions(alone, at);
    const Vec3 c = b[0].R * leaf.com[0], u = with.wind->velocity - b[0].omega.cross(c);
    const LeafLoad load = paper_load(spiralling, leaf, 0, b[0].R, u, b[0].omega);
    const Mat3 I = b[0].R * leaf.inertia[0] * b[0].R.transpose();
    const Mat3 J = I + leaf.mass[0] * (c.squaredNorm() * Mat3::Identity() - c * c.transpose());
    const Mat3 T = body_rate_jacobian_inverse(at.theta[0]);
    const Vec3 spring =
        -b[0].R * T.transpose() * leaf.stiffness[0].cwiseProduct(Vec3(at.theta[0] + leaf.damping[0] * at.theta_dot[0]));
    const Vec3 moment = spring + c.cross(load.force) + load.torque - b[0].omega.cross(J * b[0].omega);
    const Vec3 truth = b[0].R.transpose() * J.ldlt().solve(moment); // rates in the body's axes change by this
    const Vec3 rate = b[0].R.transpose() * b[0].omega;
    ArticulatedPass& pass = articulated_state(at).pass[0];
    pass.body[0].theta = at.theta[0];
    pass.body[0].rate = rate;
    articulated_pass(alone, pass, 0, 0);
    const Vec3 acceleration = pass.body[0].rate_dot;
    CHECK((acceleration - truth).norm() <= 1e-9 * truth.norm());
    const Residual left = inverse_dynamics(alone, at.theta, {rate}, {acceleration}, 0);
    CHECK(left.worst <= 1e-9 * left.moment_rms);
}

TEST_CASE("The coupled step converges to the articulated reference with /leaves as without, order 2") {
    Scene scene = with_leaves(solver::empty_scene());
    scene.wind = Wind();
    scene.wind->velocity = Vec3(5, 0, 1.4);
    scene.wind->profile = 0;
    scene.wind->gust_factor = 1.5;
    scene.wind->gust_period = 0.7;
    const coupled::Motion motion{leafy(), scene, 20};
    const coupled::Track truth = coupled::truth_of(motion);
    for (const Scheme scheme : {Scheme::p12, Scheme::p34}) {
        CAPTURE(scheme_of(scheme).name);
        CHECK(coupled::order_at(motion, truth, scheme, 32) >= 1.85);
        CHECK(coupled::error_of(motion, truth, scheme, 64) < 1e-3);
    }
}

TEST_CASE("Leaves in lanes are the plain step's to rounding, and their float as near to double") {
    const Tree large = lanes::firm(lanes::grown(600));
    std::vector<lanes::Case> cases;
    cases.push_back({"gusts", large, with_leaves(lanes::in_wind(lanes::gusts()))});
    cases.push_back(
        {"storm, spiralling far", leafy(), with_leaves(lanes::in_wind(*wind_preset("gusty")), {1, 20, 0.5, 80})});
    lanes::Case still{"still air", leafy(), with_leaves(solver::empty_scene()), 0.05, 0.5};
    still.scene.wind = Wind{};
    cases.push_back(still);
    Scene pulled = with_leaves(lanes::in_wind(lanes::gusts()));
    pulled.pulls = lanes::pulls();
    cases.push_back({"pulls", large, pulled});
    cases.push_back({"several blocks", lanes::firm(lanes::grown(3000)), with_leaves(lanes::in_wind(lanes::gusts()))});
    lanes::Case moved{"everything, the ground too", large, with_leaves(lanes::everything())};
    lanes::Case limp{"turning fast", lanes::grown(300), with_leaves(lanes::in_wind(*wind_preset("storm")))};
    limp.scene.pose = Pose::rest;
    limp.scene.stiffness_scale = 0.05;
    for (const Solver solver : {Solver::coupled, Solver::analytic}) {
        std::vector<lanes::Case> all = cases;
        if (solver == Solver::coupled) all.push_back(moved);
        for (lanes::Case& c : all) {
            c.solver = solver;
            for (const Scheme scheme : {Scheme::p12, Scheme::p34}) {
                if (scheme == Scheme::p34 && (solver == Solver::analytic || c.tree.size_bodies() > 1000)) continue;
                lanes::LanesRun<> plain(c, plainly, scheme), fast(c, fast::best_target(), scheme);
                CAPTURE(c.name, solver_name(solver), scheme_of(scheme).name);
                REQUIRE(fast.plan.stepper->in_lanes());
                REQUIRE(fast.plan.leaf.on);
                const lanes::Apart d = lanes::run_apart(plain, fast, 60);
                CHECK(d.theta < 1e-10);
                CHECK(d.theta_dot < 1e-8);
                CHECK(fast.state.flags.energy_guard == plain.state.flags.energy_guard);
                CHECK(fast.state.flags.fast_turns == plain.state.flags.fast_turns);
            }
            if (c.tree.size_bodies() <= 1000) lanes::check_float_drift(c, 100);
            if (c.tree.size_bodies() <= 1000) lanes::check_targets_agree(c, 1e-4);
        }
        // Where the guard has work the two part soon, on both paths by as much as it had: few frames.
        limp.solver = solver;
        lanes::LanesRun<> plain(limp, plainly), fast(limp, fast::best_target());
        const lanes::Apart d = lanes::run_apart(plain, fast, 6);
        CAPTURE(solver_name(solver));
        if (solver == Solver::coupled) CHECK(plain.state.flags.energy_guard > 0);
        CHECK(fast.state.flags.energy_guard == plain.state.flags.energy_guard);
        CHECK(d.theta < 1e-7);
    }
}

TEST_CASE("Without a wind, without leaves or without /leaves nothing of it is there") {
    Tree bare = leafy();
    for (Kind& kind : bare.kind)
        if (kind == Kind::leaf) kind = Kind::fruit;
    Scene windless, windy = lanes::in_wind(lanes::gusts());
    for (const Path& path : paths()) {
        const auto run = [&](const Tree& tree, const Scene& scene) {
            lanes::Case c{"", tree, scene};
            c.solver = path.solver;
            auto made = std::make_unique<lanes::LanesRun<>>(c, path.simd);
            made->steps(20);
            return made;
        };
        CAPTURE(path.name);
        for (const auto& [tree, scene] : {std::pair{leafy(), windless}, {bare, windy}}) {
            const auto without = run(tree, scene), with = run(tree, with_leaves(scene));
            CHECK(with->hash() == without->hash());
            REQUIRE(explain(with->plan).arrays.size() == explain(without->plan).arrays.size());
            for (std::size_t k = 0; k < explain(with->plan).arrays.size(); ++k) {
                CHECK(explain(with->plan).arrays[k].on == explain(without->plan).arrays[k].on);
                CHECK(explain(with->plan).arrays[k].bytes == explain(without->plan).arrays[k].bytes);
            }
        }
        const auto without = run(leafy(), windy), with = run(leafy(), with_leaves(windy));
        CHECK_FALSE(without->plan.leaf.on);
        CHECK(with->plan.leaf.on);
        CHECK(with->hash() != without->hash());
        for (const PlannedStage& stage : explain(with->plan).stages)
            if (stage.stage == (path.simd                        ? Stage::lanes
                                : path.solver == Solver::coupled ? Stage::body_loads
                                                                 : Stage::external_forces))
                CHECK(stage.reason.find("/leaves") != std::string::npos);
    }
}

TEST_CASE("A tree that is one leaf, and one of leaves alone, run on every path") {
    Tree many;
    many.name = "leaves";
    for (int i = 0; i < 40; ++i)
        make_tree::add_leaf(many, -1, {0.1 * i, 1, 0}, make_tree::turn(0.3 * i, Vec3(1, 0.2 * i, 0.5)), 0.07, 0.05,
                            3e-4, i, 0, 0);
    Scene scene = with_leaves(lanes::in_wind(*wind_preset("breeze")));
    scene.pose = Pose::rest;
    for (const Tree& tree : {one_leaf(), one_leaf(Kind::petal), many})
        for (const Path& path : paths()) {
            lanes::Case c{"", tree, scene};
            c.solver = path.solver;
            lanes::LanesRun<> run(c, path.simd);
            run.steps(300);
            present(run.plan, run.state);
            CAPTURE(tree.name, path.name);
            REQUIRE_FALSE(first_non_finite(run.state).has_value());
            for (const Vec3& theta : run.state.theta) CHECK(theta.norm() < 3.15);
        }
}

TEST_CASE("With /leaves every promised cell of the grid of extremes holds") {
    const auto holds = [](const LeafAir& leaves, const Simd& simd, const std::string& only, std::size_t least) {
        StabilitySetup setup;
        setup.tree = make_tree::branched();
        setup.ranges = {{0, setup.tree.size_bodies(), 0}};
        setup.scene.pose = Pose::rest;
        setup.scene.leaves = leaves;
        setup.simd = simd;
        std::size_t promised = 0;
        // Deep chains and forests bring trees of their own, without leaves.
        for (const StabilityCell& cell :
             measure_stability(setup, {40, false, only, {"balls", "depth", "forest"}}, [](auto, auto) {}).cells) {
            if (!cell.promised) continue;
            CAPTURE(leaves.offset, leaves.air_resistance, simd.has_value(), cell.group, cell.name, cell.solver,
                    cell.precision, cell.note, cell.energy_drift, cell.rms_growth);
            ++promised;
            CHECK(cell.finite);
            CHECK(cell.bounded);
        }
        CHECK(promised >= least);
    };
    if (sanitized) return holds(spiralling, fast::best_target(), "wind", 8);
    holds(spiralling, fast::best_target(), "", 160);
    for (const LeafAir& leaves : {LeafAir{}, LeafAir{2, 30, 0.5, 60}})
        for (const Simd& simd : {plainly, Simd(fast::best_target())}) holds(leaves, simd, "wind", 8);
}

TEST_CASE(
    "Soft or stiff, in still air or a storm, leaves go no faster than the wind drives them, at one step a frame") {
    for (const double softer : cases(1, {1e-3, 1.0, 1e6}))
        for (const double speed : cases(2, {5.0, 50.0, 0.0}))
            for (const LeafAir& leaves : {LeafAir{}, spiralling, LeafAir{2, 30, 0.5, 60}})
                for (const Path& path : paths()) {
                    lanes::Case c{"", leafy(softer), with_leaves({}, leaves)};
                    c.scene.wind = steady(Vec3(speed, 0, 0));
                    c.scene.pose = Pose::rest;
                    c.solver = path.solver;
                    lanes::LanesRun<> run(c, path.simd);
                    double fastest = 0, slowest = 0;
                    for (int k = 0; k < 400; ++k) {
                        run.frame();
                        if (k % 4 != 3) continue;
                        const std::vector<BodyMotion> motion = body_motions(run.plan, run.state);
                        double most = 0;
                        for (std::size_t i = 0; i < c.tree.size_bodies(); ++i)
                            if (is_flat(c.tree.kind[i]))
                                most = std::max(
                                    most,
                                    Vec3(motion[i].v + motion[i].omega.cross(motion[i].R * c.tree.com[i])).norm());
                        (k < 300 ? fastest : slowest) = std::max(k < 300 ? fastest : slowest, most);
                    }
                    CAPTURE(softer, speed, leaves.kappa, path.name, fastest, slowest);
                    REQUIRE_FALSE(first_non_finite(run.state).has_value());
                    CHECK(fastest <= 1.5 * speed + 3);
                    CHECK(slowest <= 1.2 * fastest);
                }
}

TEST_CASE("A leaf of no mass is refused") {
    Tree tree = one_leaf();
    CHECK_FALSE(check(tree).has_value());
    tree.mass[0] = 0;
    REQUIRE(check(tree).has_value());
    CHECK(check(tree)->field == "mass");
    CHECK(check(tree)->message == "is 0, expected more than 0");
}
