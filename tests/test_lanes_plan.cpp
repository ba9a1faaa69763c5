// What a plan with lanes promises: which stages run, which arrays exist and how large all of them are; what present() fills.
#include "lanes_support.h"
#include "lib/stages/state_arrays.h"
#include <map>
#include <set>

using namespace bough;
using namespace lanes;

namespace {

using Names = std::set<std::string>;

// Leaves that do not turn too fast for a step to resolve.
Tree firm() {
    Tree tree = make_tree::branched();
    for (Vec3& K : tree.stiffness) K *= 1e4;
    return tree;
}

std::vector<Case> cases() {
    const Tree tree = firm();
    Scene windy, moved;
    windy.wind = gusts();
    moved.root_motion = {shifted()};
    std::vector<Case> all{{"gravity alone", tree, Scene{}},
                          {"nothing", tree, solver::empty_scene()},
                          {"wind", tree, windy},
                          {"moved", tree, moved},
                          {"everything", tree, everything()}};
    Scene pulled;
    pulled.pulls = pulls();
    windy.pulls = pulls();
    std::vector<Case> joints{{"analytic, gravity alone", tree, Scene{}},
                             {"analytic, nothing", tree, solver::empty_scene()},
                             {"analytic, pulls", tree, pulled},
                             {"analytic, everything", tree, windy}};
    for (Case& c : joints) {
        c.solver = Solver::analytic;
        all.push_back(c);
    }
    return all;
}

template <class T> std::map<std::string, std::size_t> held(const Plan<T>& plan, const State<T>& state) {
    std::map<std::string, std::size_t> bytes;
    visit_arrays(plan, state, [&](const char* name, const auto& array, bool, const std::string&) {
        bytes[name] = array.capacity() * sizeof(array[0]);
    });
    return bytes;
}

} // namespace

TEMPLATE_TEST_CASE("lanes run alone and leave the plain step's arrays empty", "", float, double) {
    using T = TestType;
    for (const Case& c : cases())
        for (const Wishes& wishes : {Wishes{}, Wishes{true, false}, Wishes{false, true}}) {
            CAPTURE(c.name, wishes.velocity, wishes.torque);
            Run<T> run(c, fast::best_target(), Scheme::p12, wishes);
            for (int k = 0; k < 10; ++k) run.frame();
            REQUIRE(run.plan.stages.size() == stage_count);
            for (std::size_t k = 0; k < stage_count; ++k) {
                const PlannedStage& planned = run.plan.stages[k];
                CAPTURE(stage_name(planned.stage));
                CHECK(planned.stage == Stage(k));
                CHECK(planned.on == (planned.stage == Stage::lanes));
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
            const std::map<std::string, std::size_t> bytes = held(run.plan, run.state);
            for (const PlannedArray& array : run.plan.arrays) {
                if (!bytes.contains(array.name)) continue; // the articulated solvers', the lanes' own
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
        Run<T> run(c, fast::best_target());
        for (int k = 0; k < 10; ++k) run.frame();
        std::size_t sum = 0;
        for (const PlannedArray& array : run.plan.arrays) sum += array.on ? array.bytes : 0;
        CHECK(run.state.bytes() == sum);
    }
}

TEMPLATE_TEST_CASE("what was wished for is there when it is presented, and only then", "", float, double) {
    using T = TestType;
    const Case c{"", firm(), everything()};
    Run<T> run(c, fast::best_target(), Scheme::p12, {true, true});
    run.frame();
    const auto v = run.state.v_w, omega = run.state.omega_w, torque = run.state.torque_j;
    run.steps(3);
    CHECK_FALSE(run.state.lanes.presented);
    CHECK(run.state.v_w == v); // nobody has asked
    CHECK(run.state.torque_j == torque);
    present(run.plan, run.state);
    CHECK(run.state.lanes.presented);
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
    Run<T> bare(c, fast::best_target());
    bare.frame();
    CHECK(bare.state.v_w.capacity() + bare.state.omega_w.capacity() + bare.state.torque_j.capacity() == 0);
}

TEST_CASE("a plan without lanes holds none, and presenting it does nothing") {
    const Case c{"", make_tree::branched(), everything()};
    Run<> plain(c, std::nullopt);
    plain.steps(2);
    const std::uint64_t hash = state_hash(plain.state);
    const auto x = plain.state.x_w;
    present(plain.plan, plain.state);
    CHECK(state_hash(plain.state) == hash);
    CHECK(plain.state.x_w == x);
    CHECK(plain.plan.lanes.constants.capacity() + plain.plan.lanes.layout.body.capacity() == 0);
    const fast::Lanes<double>& none = plain.state.lanes;
    CHECK(none.now.capacity() + none.next.capacity() + none.solved.capacity() + none.outward.capacity() +
              none.inward.capacity() + none.accelerated.capacity() + none.scratch.capacity() ==
          0);
}
