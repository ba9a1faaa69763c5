// What a plan with lanes promises: which stages run, which arrays exist and how large all of them are; what present() fills.
#include "tests/support/lanes_support.h"
#include "tests/support/solver_parts.h"
#include <map>
#include <set>

using namespace bough;
using namespace lanes;

namespace {

using Names = std::set<std::string>;

// Leaves that do not turn too fast for a step to resolve.
Tree firm_tree() {
    Tree tree = make_tree::branched();
    for (Vec3& K : tree.stiffness) K *= 1e4;
    return tree;
}

std::vector<Case> cases() {
    const Tree tree = firm_tree();
    Scene windy, moved;
    windy.wind = gusts();
    moved.root_motion = {shifted()};
    std::vector<Case> all{{"gravity alone", tree, Scene{}},
                          {"nothing", tree, solver::empty_scene()},
                          {"wind", tree, windy},
                          {"moved", tree, moved},
                          {"everything", tree, everything()}};
    Scene varied = windy;
    varied.wind->swirl.emplace();
    varied.wind->swirl->angle = {20};
    varied.wind->shelter = WindShelter{3};
    all.push_back({"wind over the ground", tree, varied});
    Scene pulled;
    pulled.pulls = pulls();
    windy.pulls = pulls();
    std::vector<Case> joints{{"analytic, gravity alone", tree, Scene{}},
                             {"analytic, nothing", tree, solver::empty_scene()},
                             {"analytic, pulls", tree, pulled},
                             {"analytic, wind over the ground", tree, varied},
                             {"analytic, everything", tree, windy}};
    for (Case& c : joints) {
        c.solver = Solver::analytic;
        all.push_back(c);
    }
    return all;
}

template <class T> std::map<std::string, std::size_t> held(const State<T>& state) {
    std::map<std::string, std::size_t> bytes;
    parts::visit_held(state,
                      [&](const char* name, const auto& array) { bytes[name] = array.capacity() * sizeof(array[0]); });
    return bytes;
}

} // namespace

TEMPLATE_TEST_CASE("lanes run alone and leave the plain step's arrays empty", "", float, double) {
    using T = TestType;
    for (const Case& c : cases())
        for (const Wishes& wishes : {Wishes{}, Wishes{true, false}, Wishes{false, true}}) {
            CAPTURE(c.name, wishes.velocity, wishes.torque);
            LanesRun<T> run(c, fast::best_target(), Scheme::p12, wishes);
            for (int k = 0; k < 10; ++k) run.frame();
            REQUIRE(explain(run.plan).stages.size() == stage_count);
            for (std::size_t k = 0; k < stage_count; ++k) {
                const PlannedStage planned = explain(run.plan).stages[k];
                CAPTURE(stage_name(planned.stage));
                CHECK(planned.stage == Stage(k));
                const bool points = c.solver == Solver::coupled && !c.scene.pulls.empty(); // placed one by one
                CHECK(planned.on == (planned.stage == Stage::lanes || (points && planned.stage == Stage::attachments)));
                CHECK(run.state.calls[k] == (planned.on ? 10u : 0u));
                CHECK_FALSE(planned.reason.empty());
            }
            Names expected{"theta", "theta_dot", "R_wb", "x_w"}, on;
            if (c.solver == Solver::analytic)
                expected.insert("scaled_rate");
            else
                expected.insert({"theta_change", "theta_dot_change"});
            if (wishes.velocity) expected.insert({"omega_w", "v_w"});
            if (wishes.torque) expected.insert("torque_j");
            const std::map<std::string, std::size_t> bytes = held(run.state);
            for (const PlannedArray& array : explain(run.plan).arrays) {
                if (!bytes.contains(array.name)) continue; // the lanes' own
                CAPTURE(array.name);
                CHECK(bytes.at(array.name) == (array.on ? array.bytes : 0));
                CHECK_FALSE(array.reason.empty());
                if (array.on) on.insert(array.name);
            }
            CHECK(on == expected);
        }
}

TEMPLATE_TEST_CASE("a state in lanes is as large as its plan says", "", float, double) {
    using T = TestType;
    for (const Case& c : cases()) {
        CAPTURE(c.name);
        LanesRun<T> run(c, fast::best_target());
        for (int k = 0; k < 10; ++k) run.frame();
        std::size_t sum = 0;
        for (const PlannedArray& array : explain(run.plan).arrays) sum += array.on ? array.bytes : 0;
        CHECK(run.state.bytes() == sum);
    }
}

TEMPLATE_TEST_CASE("what was wished for is there when it is presented, and only then", "", float, double) {
    using T = TestType;
    const Case c{"", firm_tree(), everything()};
    LanesRun<T> run(c, fast::best_target(), Scheme::p12, {true, true});
    run.frame();
    const auto v = run.state.v_w, omega = run.state.omega_w, torque = run.state.torque_j;
    run.steps(3);
    CHECK_FALSE(parts::lanes(run.state).presented);
    CHECK(run.state.v_w == v); // nobody has asked
    CHECK(run.state.torque_j == torque);
    present(run.plan, run.state);
    CHECK(parts::lanes(run.state).presented);
    CHECK(run.state.v_w != v);
    CHECK(run.state.omega_w != omega);
    CHECK(run.state.torque_j != torque);
    // The spring's and damper's own law, -K (theta + beta theta_dot), of each joint.
    for (std::size_t i = 0; i < run.plan.bodies; ++i) {
        const Vector3<T> bent = run.state.theta[i] + run.plan.beta[i] * run.state.theta_dot[i];
        const Vector3<T> law = -run.plan.K[i].cwiseProduct(bent);
        CAPTURE(i);
        CHECK(run.state.torque_j[i].norm() > 0);
        CHECK(std::abs(run.state.torque_j[i].norm() / law.norm() - 1) < 0.05); // to the map's first order
    }
    LanesRun<T> bare(c, fast::best_target());
    bare.frame();
    CHECK(bare.state.v_w.capacity() + bare.state.omega_w.capacity() + bare.state.torque_j.capacity() == 0);
}

TEST_CASE("a plan without lanes holds none, and presenting it does nothing") {
    const Case c{"", make_tree::branched(), everything()};
    LanesRun<> plain(c, std::nullopt);
    plain.steps(2);
    const std::uint64_t hash = state_hash(plain.state);
    const auto x = plain.state.x_w;
    present(plain.plan, plain.state);
    CHECK(state_hash(plain.state) == hash);
    CHECK(plain.state.x_w == x);
    CHECK(parts::lanes(plain.plan).constants.capacity() + parts::lanes(plain.plan).layout.body.capacity() == 0);
    const fast::Lanes<double>& none = parts::lanes(plain.state);
    CHECK(none.now.capacity() + none.table.capacity() + none.outward.capacity() + none.inward.capacity() +
              none.accelerated.capacity() + none.scratch.capacity() ==
          0);
}

TEMPLATE_TEST_CASE("where nobody reads poses, a run in lanes keeps nothing in document order, and is the same", "",
                   float, double) {
    using T = TestType;
    for (const Case& c : cases()) {
        CAPTURE(c.name);
        LanesRun<T> full(c, fast::best_target()), bare(c, fast::best_target(), Scheme::p12, {false, false, false});
        const Plan<T>& plan = bare.plan;
        CHECK(full.plan.pose);
        const bool points = c.solver == Solver::coupled && !c.scene.pulls.empty(); // are placed by what poses need
        CHECK(plan.pose == points);
        if (points) continue;
        const auto none = [](const auto&... arrays) { return ((arrays.capacity() == 0) && ...); };
        CHECK(none(plan.parent, plan.joint_position, plan.R_pj, plan.mass, plan.c_mass, plan.com, plan.inertia_joint,
                   plan.K, plan.beta, parts::joints(plan).inertia_factor, parts::joints(plan).gravity_row,
                   parts::bodies(plan).carried_moment, plan.drag_area, plan.kind, parts::joints(plan).sway,
                   parts::joints(plan).joint_distance, parts::joints(plan).com_distance,
                   parts::joints(plan).inverse_weight));
        full.steps(10);
        bare.steps(10);
        Names on;
        std::size_t sum = 0;
        for (const PlannedArray& array : explain(plan).arrays) {
            if (!array.on) continue;
            on.insert(array.name);
            sum += array.bytes;
        }
        CHECK(on == (c.solver == Solver::analytic ? Names{"lanes.now", "lanes.outward, inward"}
                                                  : Names{"lanes.table", "lanes.outward, inward, accelerated"}));
        CHECK(bare.state.bytes() == sum);
        for (const auto& [name, bytes] : held(bare.state)) {
            CAPTURE(name);
            CHECK(bytes == 0);
        }
        CHECK(bare.calls(Stage::lanes) == 10);
        const std::uint64_t hash = full.hash();
        CHECK(state_hash(plan, bare.state) == hash);

        // What a saved state needs is there when it is asked for, and a run goes on from it.
        present(plan, bare.state);
        CHECK(state_hash(bare.state) == hash);
        CHECK(parts::theta_change(bare.state) == parts::theta_change(full.state));
        CHECK(parts::theta_dot_change(bare.state) == parts::theta_dot_change(full.state));
        CHECK(parts::scaled_rate(bare.state) == parts::scaled_rate(full.state));
        CHECK(none(bare.state.R_wb, bare.state.x_w));
        restart(plan, bare.state);
        CHECK(bare.state.bytes() == sum);
        bare.steps(10);
        full.steps(10);
        CHECK(state_hash(plan, bare.state) == full.hash());
        // Velocities and torques need them.
        CHECK(LanesRun<T>(c, fast::best_target(), Scheme::p12, {true, false, false}).plan.pose);
        CHECK(LanesRun<T>(c, fast::best_target(), Scheme::p12, {false, true, false}).plan.pose);
        CHECK(LanesRun<T>(c, std::nullopt, Scheme::p12, {false, false, false})
                  .plan.pose); // the plain step reads them itself
    }
}

TEMPLATE_TEST_CASE("the rows' hash is that of the arrays they are presented in", "", float, double) {
    using T = TestType;
    std::vector<TreeRange> ranges;
    Case forest{"three trees", three_trees(ranges), everything()};
    forest.ranges = ranges;
    std::vector<Case> all = cases();
    all.push_back(forest);
    all.push_back({"with a top", grown(20000), everything()});
    for (const Case& c : all)
        for (const Scheme scheme : {Scheme::p12, Scheme::p34})
            for (const Simd simd : {Simd(fast::best_target()), Simd()}) {
                CAPTURE(c.name, scheme_of(scheme).name, simd.has_value());
                LanesRun<T> run(c, simd, scheme);
                for (int k = 0; k < 3; ++k) {
                    run.frame();
                    CHECK(state_hash(run.plan, run.state) == state_hash(run.state));
                }
            }
}

TEMPLATE_TEST_CASE("a tree that is handed over gives the same run, and is given back", "", float, double) {
    using T = TestType;
    Scene scaled = everything();
    scaled.stiffness_scale = 3;
    scaled.damping_scale = 0.5;
    for (const Scene& scene : {Scene{}, everything(), scaled})
        for (const Solver solver : {Solver::coupled, Solver::analytic})
            for (const Simd simd : {Simd(fast::best_target()), Simd()}) {
                CAPTURE(solver_name(solver), simd.has_value(), scene.stiffness_scale);
                const Tree tree = firm_tree();
                Tree own = tree;
                const std::vector<TreeRange> range{{0, tree.size_bodies(), 0}};
                const auto lent = make_plan<T>(tree, range, scene, {}, 1.0 / 30, solver, Scheme::p12, simd);
                const auto given = make_plan<T>(std::move(own), range, scene, {}, 1.0 / 30, solver, Scheme::p12, simd);
                State<T> one = make_state(lent), other = make_state(given);
                for (int k = 0; k < 5; ++k) advance(lent, one), advance(given, other);
                CHECK(state_hash(given, other) == state_hash(lent, one));
                CHECK(own.parent.capacity() + own.kind.capacity() + own.mass.capacity() + own.com.capacity() +
                          own.inertia.capacity() + own.joint_position.capacity() + own.joint_rotation.capacity() +
                          own.stiffness.capacity() + own.damping.capacity() + own.size.capacity() +
                          own.level.capacity() + own.s.capacity() ==
                      0);
                CHECK(own.branch == tree.branch);
                CHECK(own.name == tree.name);
            }
}
