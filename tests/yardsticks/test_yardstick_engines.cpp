// The yardsticks against each other: an engine that is fed wrongly, or loses its digits, shows here first.
#include "cases.h"
#include <catch2/catch.hpp>

using namespace yardstick;

TEST_CASE("engines agree with a dense solve in long double") {
    for (const Case& c : acceleration_cases()) {
        const auto truth = accelerations(*make_dense(c.tree, c.scene.gravity), c);
        for (const auto make : {make_mujoco, make_simbody}) {
            const auto engine = make(c.tree, c.scene.gravity);
            const auto found = accelerations(*engine, c);
            const Difference d = difference(found, truth);
            double lo = 1e300, hi = 0;
            for (const Vec3& v : truth) lo = std::min(lo, v.norm()), hi = std::max(hi, v.norm());
            UNSCOPED_INFO(engine->name() << ": " << c.name << ": " << d.largest << " at joint " << d.joint << " a "
                                         << truth[d.joint].norm() << " range " << lo << " " << hi);
            CHECK(d.largest <= 1e-30);
        }
    }
}
