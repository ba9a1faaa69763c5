// articulated_pass (lib/study/articulated.h) against MuJoCo, Simbody and the dense solve of 113 bits, on the trees and
// motions of cases.h, by the two measures defined
// there; two solvers may differ by twice what each may differ from the truth.
#include "cases.h"
#include "lib/study/articulated.h"
#include "tests/support/solver_parts.h"
#include <catch2/catch.hpp>

using namespace yardstick;

namespace {

std::vector<Vec3> library_accelerations(const Case& c) {
    const auto plan = bough::make_plan<double>(c.tree, {{0, c.tree.size_bodies(), 0}}, c.scene, {}, 1e-3,
                                               bough::Solver::articulated_explicit);
    auto state = bough::make_state(plan);
    bough::ArticulatedPass& pass = articulated_state(state).pass[0];
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        pass.body[i].theta = rotation_vector(c.motion.turn[i]);
        pass.body[i].rate = c.motion.rate[i];
    }
    bough::articulated_pass(plan, pass, c.time, 0);
    std::vector<Vec3> found;
    for (const bough::ArticulatedBody& body : pass.body) found.push_back(body.rate_dot);
    return found;
}

} // namespace

TEST_CASE("Accelerations of articulated trees agree with MuJoCo, Simbody and a dense solve") {
    for (const Case& c : acceleration_cases()) {
        const auto found = library_accelerations(c);
        const auto truth = accelerations(*make_dense(c.tree, c.scene.gravity), c);
        const Difference d = difference(c, found, truth);
        INFO(c.name << ": kinetic " << d.kinetic << ", joint " << d.joint << " at " << d.worst_joint);
        CHECK(d.kinetic <= c.kinetic_limit);
        CHECK(d.joint <= c.joint_limit);
        for (const auto make : {make_mujoco, make_simbody}) {
            const auto engine = make(c.tree, c.scene.gravity);
            const Difference e = difference(c, found, accelerations(*engine, c));
            INFO(engine->name() << ": kinetic " << e.kinetic << ", joint " << e.joint << " at " << e.worst_joint);
            CHECK(e.kinetic <= 2 * c.kinetic_limit);
            CHECK(e.joint <= 2 * c.joint_limit);
        }
    }
}
