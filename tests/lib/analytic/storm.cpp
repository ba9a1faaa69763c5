// Bounded, as the design defines it, on a grown tree of ten thousand bodies with twigs of a millimetre in a wind of 30 m/s
// for 60 s at one step a frame, by the analytic step in lanes, which follows the plain one to rounding (tests/lib/analytic/lanes.cpp): in float, and where
// wood is as stiff as it is in double too. Slow: its CTest label leaves it out of sanitized builds.
#include "tests/support/lanes_support.h"
#include "tests/support/simulate.h"

using namespace bough;
using simulate::steady;

namespace {

Tree twiggy_tree() {
    Tree tree = segment(grow_bodies(default_growth(), 5, {}, 10000), wood_presets().front(), {});
    double thinnest = 1;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == Kind::branch) thinnest = std::min(thinnest, tree.size[i][2]);
    REQUIRE(thinnest < 0.0011);
    return tree;
}

template <class T> void endures(const Tree& tree, double stiffness, lanes::Simd simd) {
    lanes::Case storm{"storm", tree, {}};
    storm.solver = Solver::analytic;
    Scene& scene = storm.scene;
    scene.wind = steady(30);
    scene.stiffness_scale = stiffness;
    scene.pose = Pose::rest;
    lanes::LanesRun<T> run(storm, simd);
    REQUIRE(run.plan.stepper->in_lanes() == simd.has_value());
    const auto rms = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) sum += double((run.state.x_w[i]).squaredNorm());
        return std::sqrt(sum / double(tree.size_bodies()));
    };
    double third = 0, last = 0, largest = 0;
    for (int frame = 0; frame < 1800; ++frame) {
        advance(run.plan, run.state);
        if (frame < 900) continue;
        present(run.plan, run.state);
        const double position = rms();
        REQUIRE(std::isfinite(position));
        (frame < 1350 ? third : last) += position * position;
        if (frame % 50 == 0)
            for (const auto& theta : run.state.theta) largest = std::max(largest, double(theta.norm()));
    }
    INFO("stiffness x " << stiffness << ": largest angle " << largest << ", flags " << run.state.flags.buckling << " "
                        << run.state.flags.bounded_lambda);
    CHECK(std::sqrt(last / third) <= 1.05);
    // A thousand times softer than wood the small angle a joint that the method assumes is left: twigs that stood against
    // the wind turn over with it. Bounded, but no promise on the angle.
    if (stiffness >= 1) CHECK(largest < 1.5);
    const Energy e = energy(run.plan, run.state);
    CHECK(e.kinetic <= 0.01 * std::abs(e.elastic) + 1e-3);
}

} // namespace

TEST_CASE("Ten thousand bodies endure a storm") {
    const Tree tree = twiggy_tree();
    for (const double stiffness : {1e-3, 1.0, 1e6}) {
        CAPTURE(stiffness);
        endures<float>(tree, stiffness, fast::best_target());
    }
    endures<double>(tree, 1, fast::best_target());
}
