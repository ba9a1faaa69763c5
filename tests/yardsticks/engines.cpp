// The yardsticks against each other and against themselves: an engine that is fed wrongly or loses its digits, or a load
// written down wrongly, shows here and not as an error of the library.
#include "cases.h"
#include <catch2/catch.hpp>

using namespace yardstick;

TEST_CASE("MuJoCo and Simbody agree with a dense solve of 113 bits") {
    for (const Case& c : acceleration_cases()) {
        const auto truth = accelerations(*make_dense(c.tree, c.scene.gravity), c);
        for (const auto make : {make_mujoco, make_simbody}) {
            const auto engine = make(c.tree, c.scene.gravity);
            const Difference d = difference(c, accelerations(*engine, c), truth);
            INFO(engine->name() << ", " << c.name << ": kinetic " << d.kinetic << ", joint " << d.joint << " at "
                                << d.worst_joint);
            CHECK(d.kinetic <= c.kinetic_limit);
            CHECK(d.joint <= c.joint_limit);
        }
    }
}

TEST_CASE("The map of rates is the derivative of the rotation vector") {
    make_tree::Dice dice{std::mt19937(4)};
    for (const double size : {1e-9, 1e-4, 0.05, 0.29, 0.31, 1.0, 2.5}) {
        const Vec3 theta = size * Vec3(dice(-1, 1), dice(-1, 1), dice(-1, 1)).normalized();
        const Vec3 rate(dice(-1, 1), dice(-1, 1), dice(-1, 1));
        CHECK((rotation_vector(turn_of(theta)) - theta).norm() <= 4e-16 * (1 + 1 / size) * size);
        const double h = 1e-3;
        const auto at = [&](double t) { return rotation_vector(turn_of(theta) * turn_of(rate * t)); };
        const Vec3 derivative = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
        CHECK((rate_map(theta) * rate - derivative).norm() <= 1e-11);
    }
}
