// A pose reached under forces made the tree's own: it stays there when they are gone.
#include "lib/plan/posed_tree.h"
#include "lib/model/static_load.h"
#include "lib/study/solvers.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulate.h"
#include <catch2/catch.hpp>

using namespace bough;
using namespace simulate;

namespace {

Pull pull_on(std::int64_t body, const Vec3& force) {
    Pull pull;
    pull.on.body = body;
    pull.time = {0, 100};
    pull.force = {force, force};
    return pull;
}

template <class T> struct Pulled {
    Plan<T> plan;
    State<T> state;
    Pulled(const Tree& tree, const Scene& scene, Solver solver, std::optional<fast::Target> simd = std::nullopt)
        : plan(make_plan<T>(tree, {{0, tree.size_bodies(), 0}}, scene, {}, 1.0 / 30, solver, Scheme::p12, simd)),
          state(make_state(plan)) {}
    void steps(int n) {
        for (int k = 0; k < n; ++k) advance(plan, state);
        present(plan, state);
    }
};

} // namespace

TEST_CASE("the pose reached under forces, made rest, stays to 1e-9 when they are gone") {
    Tree tree = make_tree::branched();
    for (std::size_t i = 10; i < 14; ++i) tree.stiffness[i] *= 100;
    const bool snow = GENERATE(false, true), moved = GENERATE(false, true);
    if (snow) lay_load(tree, {5, 0, 0, 0});
    Scene scene;
    scene.pulls = {pull_on(5, Vec3(0, -360, 240)), pull_on(3, Vec3(1200, 0, 0))};
    scene.stiffness_scale = 0.8;
    if (moved) {
        RootMotion m;
        m.time = {0, 1};
        m.position = {Vec3::Zero(), Vec3(0.3, 0.1, 0)};
        m.rotation = {Quat::Identity(), make_tree::turn(0.2, Vec3(1, 2, 0))};
        scene.root_motion = {m};
    }
    for (const Solver solver : {Solver::coupled, Solver::analytic}) {
        Pulled<double> run(tree, scene, solver, fast::Target::baseline);
        const auto drawn = run.state.x_w;
        run.steps(45); // in the midst of swinging
        const Tree posed = posed_tree(run.plan, run.state, tree);
        REQUIRE_FALSE(check(posed).has_value());
        CHECK(posed.load.empty());
        CHECK((posed.stiffness == tree.stiffness && posed.mass == tree.mass && posed.source == tree.source));
        REQUIRE((run.state.x_w[5] - drawn[5]).norm() > 0.05);
        for (const Solver then : {Solver::coupled, Solver::analytic}) {
            Scene free;
            free.stiffness_scale = then == Solver::coupled ? 1.0 : 0.3; // whatever its springs
            Pulled<double> alone(posed, free, then);
            const auto largest = [&] {
                double off = 0;
                for (std::size_t i = 0; i < alone.plan.bodies; ++i)
                    off = std::max({off, (alone.state.x_w[i] - run.state.x_w[i]).norm(),
                                    (alone.state.R_wb[i] - run.state.R_wb[i]).norm()});
                return off;
            };
            CHECK(largest() < 1e-12);
            alone.steps(150);
            CHECK(largest() < 1e-9);
        }
    }
}

TEST_CASE("a run in float gives its pose to float's digits") {
    Tree tree = make_tree::branched();
    Scene scene;
    scene.pulls = {pull_on(5, Vec3(0, -6, 4))};
    Pulled<float> run(tree, scene, Solver::coupled);
    run.steps(30);
    const Tree posed = posed_tree(run.plan, run.state, tree);
    REQUIRE_FALSE(check(posed).has_value());
    const Pulled<double> alone(posed, Scene(), Solver::coupled);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        CHECK((alone.state.x_w[i] - run.state.x_w[i].cast<double>()).norm() < 1e-5);
}
