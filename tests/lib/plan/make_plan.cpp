// What a scene does not name is not run and not allocated, and a step allocates nothing: every allocation of this
// program is counted.
#include "lib/study/solvers.h"
#include "tests/support/count_allocations.h"
#include "tests/support/solver_parts.h"
#include "tests/support/solver_support.h"
#include <catch2/catch.hpp>
#include <map>
#include <set>

using namespace bough;
using namespace solver;

namespace {

using Names = std::set<std::string>;

struct Case {
    std::string name;
    Scene scene;
    Wishes wishes;
    Names stages, arrays; // what is on beyond what every scene has, with the analytic solver
};

const Names every_stage{"composite", "spring", "state_update"};
const Names every_array{"theta", "theta_dot", "scaled_rate", "R_wb", "x_w", "c_h_w", "c_J_w"};
// With the coupled solver: wind is a stage, its forces are in the bodies' loads; pulls and the ground are in its own stages.
const Names every_coupled_stage{"midpoint", "body_loads", "resolvent", "state_update"};
const Names every_coupled_array{"theta", "theta_dot", "theta_change", "theta_dot_change",
                                "R_wb",  "x_w",       "coupled",      "guard"};
const Names records{"attachments", "coupled", "resolvent", "resolvent_real", "guard", "held"};

struct Method {
    Solver solver = Solver::analytic;
    Scheme scheme = Scheme::p12;
};
const std::vector<Method> methods{
    {Solver::analytic}, {Solver::coupled, Scheme::p12}, {Solver::coupled, Scheme::p34}, {Solver::coupled, Scheme::lie}};

template <class T> Plan<T> plan_by(const Method& method, const Tree& tree, const Scene& scene, const Wishes& wishes) {
    return make_plan<T>(tree, {{0, tree.size_bodies(), 0}}, scene, wishes, 1.0 / 30, method.solver, method.scheme);
}

Names joined(const Names& a, const Names& b) {
    Names all = a;
    all.insert(b.begin(), b.end());
    return all;
}

std::vector<Case> cases() {
    const Names forces{"f_w", "tau_w", "c_f_w", "c_tau_w"}, velocities{"omega_w", "v_w"};
    const Names drag{"drag_f_w", "drag_tau_w", "drag_bound", "wind_bound", "turn_bound", "c_drag_f_w", "c_drag_tau_w",
                     "c_drag",   "c_drag_row", "c_wind",     "c_wind_row", "c_turn",     "c_turn_row"};
    std::vector<Case> all;
    all.push_back({"gravity only", Scene{}, {}, {}, {}});
    all.push_back({"no gravity", empty_scene(), {}, {}, {}});
    Scene windy;
    windy.wind = wind_preset("gusty");
    const Names blown = joined(joined(forces, velocities), drag);
    all.push_back({"wind", windy, {}, {"wind_field", "external_forces", "drag"}, blown});
    Scene varied = windy;
    varied.wind->grid.emplace();
    varied.wind->grid->cell = 2;
    varied.wind->grid->columns = varied.wind->grid->rows = 3;
    varied.wind->swirl.emplace();
    varied.wind->swirl->angle = {20};
    varied.wind->shelter = WindShelter{3};
    all.push_back({"wind over the ground", varied, {}, {"wind_field", "external_forces", "drag"}, blown});
    Scene still = empty_scene();
    still.wind = Wind{};
    all.push_back({"still air", still, {}, {"wind_field", "external_forces", "drag"}, blown});
    Scene pulled;
    pulled.pulls.push_back({Selector{}, {0, 1}, {Vec3(1, 0, 0), Vec3(2, 0, 0)}});
    all.push_back({"pulls only", pulled, {}, {"external_forces"}, forces});
    Scene tied;
    tied.attachments.resize(1);
    tied.attachments[0].stiffness = 1e4;
    all.push_back({"an attachment only", tied, {}, {"attachments"}, {"held_tau_w", "held_row", "held"}});
    Scene moved;
    moved.root_motion.push_back({0, {0, 1}, {Vec3::Zero(), Vec3(1, 0, 0)}, {}});
    all.push_back({"root motion", moved, {}, {"root_motion"}, {}});
    moved.gravity.setZero();
    moved.wind = Wind{};
    all.push_back({"root motion in still air, no gravity",
                   moved,
                   {},
                   {"root_motion", "wind_field", "external_forces", "drag"},
                   blown});
    Scene lagged;
    lagged.fictitious = Fictitious{0.5, 0, 0};
    all.push_back({"lagged fictitious terms",
                   lagged,
                   {},
                   {"fictitious"},
                   joined(velocities, {"spin_dot", "alpha_w", "a_w", "fictitious_w"})});
    all.push_back({"velocity wished", Scene{}, {true, false}, {}, velocities});
    all.push_back({"torque wished", Scene{}, {false, true}, {}, {"torque_j"}});
    Wishes stress;
    stress.stress = true;
    all.push_back({"stress wished", Scene{}, stress, {}, {"torque_j"}});
    windy.pulls = pulled.pulls;
    all.push_back(
        {"everything", windy, {true, true}, {"wind_field", "external_forces", "drag"}, joined(blown, {"torque_j"})});
    return all;
}

Names expected_stages(const Case& c, const Method& method) {
    if (method.solver == Solver::analytic) return joined(every_stage, c.stages);
    Names stages = joined(every_coupled_stage, c.scene.wind ? Names{"wind_field"} : Names{});
    return joined(stages, c.scene.pulls.empty() && c.scene.attachments.empty() ? Names{} : Names{"attachments"});
}

Names expected_arrays(const Case& c, const Method& method) {
    if (method.solver == Solver::analytic) return joined(every_array, c.arrays);
    Names names = joined(every_coupled_array, {method.scheme == Scheme::lie ? "resolvent_real" : "resolvent"});
    if (c.wishes.velocity) names = joined(names, {"omega_w", "v_w"});
    if (c.wishes.torque || c.wishes.stress) names.insert("torque_j");
    if (!c.scene.pulls.empty() || !c.scene.attachments.empty()) names.insert("attachments");
    return names;
}

} // namespace

TEMPLATE_TEST_CASE("a scene runs and allocates what it names and no more", "", float, double) {
    using T = TestType;
    const Tree tree = make_tree::branched();
    const auto k_method = std::size_t(GENERATE(0, 1, 2, 3));
    const Method& method = methods[k_method];
    CAPTURE(solver_name(method.solver), scheme_of(method.scheme).name);
    const bool coupled = method.solver == Solver::coupled;
    for (const Case& c : cases()) {
        if (c.scene.fictitious && method.solver != Solver::analytic)
            continue; // refused (tests/lib/analytic/fictitious.cpp)
        CAPTURE(c.name);
        const Plan<T> plan = plan_by<T>(method, tree, c.scene, c.wishes);
        CHECK(plan.stress_of_moment.capacity() == (c.wishes.stress ? plan.bodies : 0));
        State<T> state = make_state(plan);
        for (int k = 0; k < 10; ++k) advance(plan, state);
        CHECK(state.step == 10);
        CHECK_FALSE(first_non_finite(state).has_value());

        const Names stages = expected_stages(c, method), arrays = expected_arrays(c, method);
        REQUIRE(explain(plan).stages.size() == stage_count);
        for (std::size_t k = 0; k < stage_count; ++k) {
            const PlannedStage planned = explain(plan).stages[k];
            CAPTURE(stage_name(planned.stage));
            CHECK(planned.stage == Stage(k)); // said in the order they run in
            CHECK(planned.on == stages.contains(stage_name(planned.stage)));
            CHECK(state.calls[k] == (planned.on ? 10u : 0u));
            CHECK_FALSE(planned.reason.empty());
        }

        std::map<std::string, std::size_t> held;
        parts::visit_held(
            state, [&](const char* name, const auto& array) { held[name] = array.capacity() * sizeof(array[0]); });
        held["held"] = parts::joints(state).held.bytes();
        held["attachments"] = parts::bodies(state).attachments.bytes();
        std::size_t sum = 0;
        Names on;
        for (const PlannedArray& array : explain(plan).arrays) {
            CAPTURE(array.name);
            REQUIRE(held.contains(array.name));
            CHECK(held[array.name] == (array.on ? array.bytes : 0));
            CHECK_FALSE(array.reason.empty());
            sum += array.on ? array.bytes : 0;
            if (array.on) on.insert(array.name);
        }
        CHECK(on == arrays);
        for (const auto& [name, bytes] : held) {
            CAPTURE(name);
            CHECK((bytes > 0) == on.contains(name)); // nothing is held that the account does not name
        }
        CHECK(state.bytes() == sum);
        CHECK(state.ground.size() == c.scene.root_motion.size());
        CHECK(parts::joints(state).root_load.capacity() == (coupled ? 0 : c.scene.root_motion.size()));
        CHECK(parts::bodies(state).ground.capacity() == (coupled ? c.scene.root_motion.size() : 0));
        const bool field = c.name == "wind over the ground", uniform = c.scene.wind.has_value() && !field;
        CHECK(state.wind.velocity.empty() != uniform);
        CHECK(parts::bodies(state).wind_change.velocity.empty() != (coupled && uniform));
        CHECK(plan.field == field);
        CHECK(plan.shelter.capacity() == (field ? plan.bodies : 0));
        CHECK(state.wind.field.velocity.capacity() == (field ? 27u : 0u));
        CHECK((state.wind.field.turn.capacity() > 0) == field);
        for (const WindField<T>* table : {&parts::bodies(state).wind_start, &parts::bodies(state).wind_end})
            CHECK(table->velocity.capacity() == (coupled && field ? 27u : 0u));
    }
}

TEST_CASE("sizes of arrays are those of their numbers") {
    const Tree tree = make_tree::branched();
    const auto plan = plan_of<double>(tree, Scene{});
    for (const PlannedArray& array : explain(plan).arrays) {
        if (records.contains(array.name)) continue; // not numbers: held against what is allocated above
        const Names matrices{"R_wb", "c_J_w"};
        const Names single{"drag_bound", "wind_bound", "turn_bound", "c_drag",     "c_drag_row",
                           "c_wind",     "c_wind_row", "c_turn",     "c_turn_row", "held_row"};
        const std::size_t numbers = matrices.count(array.name) ? 9 : single.count(array.name) ? 1 : 3;
        CAPTURE(array.name);
        CHECK(array.bytes == tree.size_bodies() * numbers * sizeof(double));
    }
}

TEST_CASE("the constants of wind and gravity exist only with them") {
    const Tree tree = make_tree::branched();
    const auto bare = plan_of(tree, empty_scene());
    CHECK(parts::joints(bare).gravity_row.capacity() + bare.drag_area.capacity() + bare.kind.capacity() +
              parts::joints(bare).sway.capacity() + parts::joints(bare).joint_distance.capacity() +
              parts::joints(bare).com_distance.capacity() + parts::joints(bare).inverse_weight.capacity() ==
          0);
    Scene windy;
    windy.wind = Wind{};
    const auto full = plan_of(tree, windy);
    CHECK(parts::joints(full).gravity_row.size() == tree.size_bodies());
    CHECK(parts::joints(full).inverse_weight.size() == tree.size_bodies());
    // The coupled step has its own, and none of the analytic one's bounds.
    const Method coupled{Solver::coupled};
    const auto coupled_bare = plan_by<double>(coupled, tree, empty_scene(), {});
    const auto coupled_full = plan_by<double>(coupled, tree, windy, {});
    CHECK(parts::bodies(coupled_bare).carried_moment.capacity() + coupled_bare.drag_area.capacity() +
              coupled_bare.kind.capacity() ==
          0);
    CHECK(parts::bodies(coupled_full).carried_moment.size() == tree.size_bodies());
    CHECK(coupled_full.drag_area.size() == tree.size_bodies());
    CHECK(parts::bodies(full).carried_moment.capacity() == 0);
    CHECK(parts::joints(coupled_full).gravity_row.capacity() + parts::joints(coupled_full).inertia_factor.capacity() +
              parts::joints(coupled_full).inverse_weight.capacity() ==
          0);
}

TEST_CASE("how clumps' leaves face is held where some face one way more than others, in a wind, and nowhere else") {
    Tree tree = make_tree::branched();
    make_tree::add_leaf(tree, 1, {0, 0, 0.1}, Quat::Identity(), 0.2, 0.1, 3e-4, 0, 0, 0.5);
    make_tree::add_leaf(tree, 1, {0, 0, 0.1}, Quat::Identity(), 0.2, 0.1, 3e-4, 0, 0, 0.5);
    const std::size_t n = tree.size_bodies();
    tree.leaf_count.assign(n, 1);
    tree.leaf_count[n - 2] = 20;
    Scene windy;
    windy.wind = Wind{};
    for (const Method& method : {Method{Solver::coupled}, Method{Solver::analytic}}) {
        const auto held = [&](const Scene& scene) {
            const Plan<double> plan = make_plan<double>(tree, {{0, n, 0}}, scene, {}, 1.0 / 30, method.solver,
                                                        method.scheme, fast::best_target());
            return std::pair(plan.facing.capacity(), parts::lanes(plan).facing.capacity());
        };
        tree.leaf_facing.clear();
        CHECK(held(windy) == std::pair(std::size_t(0), std::size_t(0)));
        tree.leaf_facing.assign(n, 0);
        CHECK(held(windy) == std::pair(std::size_t(0), std::size_t(0)));
        tree.leaf_facing[n - 1] = 0.5; // of one leaf, which is not read
        CHECK(held(windy) == std::pair(std::size_t(0), std::size_t(0)));
        tree.leaf_facing[n - 2] = 0.5;
        CHECK(held(windy).first == n);
        CHECK(held(windy).second > 0);
        CHECK(held(empty_scene()) == std::pair(std::size_t(0), std::size_t(0)));
    }
}

TEST_CASE("the plan says what of the wind varies over the ground") {
    for (const Case& c : cases()) {
        if (c.name != "wind over the ground") continue;
        const auto plan = plan_of(make_tree::branched(), c.scene);
        CHECK(explain(plan).stages[std::size_t(Stage::wind_field)].reason ==
              "/wind; /wind/grid, 9 cells; /wind/swirl; /wind/shelter");
    }
}

#ifndef BOUGH_SANITIZED
TEST_CASE("a step allocates nothing, on one thread or several") {
    for (const Tree& tree : {make_tree::branched(), make_tree::random_tree(3000, 1)})
        for (const Method& method : methods)
            for (const Case& c : cases()) {
                if (c.scene.fictitious && method.solver != Solver::analytic) continue; // refused
                Scene scene = c.scene;
                scene.pose = Pose::rest;
                const auto plan = plan_by<double>(method, tree, scene, c.wishes);
                State<double> state = make_state(plan);
                StageClock clock;
                advance(plan, state);
                const std::size_t before = allocations;
                for (int k = 0; k < 3; ++k) advance(plan, state, &clock);
                const std::size_t during = allocations - before;
                CAPTURE(c.name, solver_name(method.solver), scheme_of(method.scheme).name);
                CHECK(before > 0); // the counter counts
                CHECK(during == 0);
            }
}
#endif

TEST_CASE("a clock has time for the stages that ran and none for the others") {
    for (const Method& method : methods) {
        CAPTURE(solver_name(method.solver), scheme_of(method.scheme).name);
        const auto plan = plan_by<double>(method, make_tree::random_tree(200, 1), empty_scene(), {});
        State<double> state = make_state(plan);
        StageClock clock;
        for (int k = 0; k < 5; ++k) advance(plan, state, &clock);
        for (const PlannedStage& planned : explain(plan).stages)
            CHECK((clock.seconds[std::size_t(planned.stage)] > 0) == planned.on);
    }
}

TEST_CASE("scales of stiffness and damping multiply every joint's") {
    const Tree tree = make_tree::branched();
    Scene scene = empty_scene();
    scene.stiffness_scale = 2;
    scene.damping_scale = 3;
    const auto plan = plan_of(tree, scene);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        CHECK((plan.K[i] - 2 * tree.stiffness[i]).norm() == 0);
        CHECK(plan.beta[i] == 3 * tree.damping[i]);
    }
}

TEMPLATE_TEST_CASE("a plan of any solver steps by advance, in the precisions that it has", "", float, double) {
    using T = TestType;
    const Tree tree = make_tree::branched();
    for (const Solver solver : all_solvers)
        for (const bool lanes : {false, true}) {
            if (lanes && is_articulated(solver)) continue; // they have none
            const auto simd = lanes ? std::optional(fast::Target::baseline) : std::nullopt;
            const auto made = [&] {
                return make_plan<T>(tree, {{0, tree.size_bodies(), 0}}, {}, {}, 1.0 / 30, solver, Scheme::p12, simd);
            };
            CAPTURE(solver_name(solver), lanes);
            if (is_articulated(solver) && !std::is_same_v<T, double>) {
                CHECK_THROWS_AS(made(), std::logic_error);
                continue;
            }
            const auto plan = made();
            State<T> state = make_state(plan);
            REQUIRE(plan.stepper->in_lanes() == lanes);
            CHECK(plan.stepper->kind().name == std::string(solver_name(solver)));
            CHECK_NOTHROW(advance(plan, state));
            CHECK(state.step == 1);
        }
}
