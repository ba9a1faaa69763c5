// files.h: the door's files.
#include "formats/files.h"
#include "formats/documents/motion.h"
#include "formats/error.h"
#include "formats/open.h"
#include "tests/support/make_tree.h"
#include "tests/support/random_documents.h"
#include "tests/support/simulations.h"
#include <catch2/catch.hpp>

using namespace bough;
using namespace simulations;
using bough::test::Folder;

TEST_CASE("a motion file holds what the simulation shows, and does not appear before it is whole") {
    const Folder folder;
    Simulation simulation(one(make_tree::branched(), "gusty"));
    const std::string file = folder / "motion.json";
    {
        MotionFile motion(file, simulation);
        simulation.step();
        motion.write(simulation);
    }
    CHECK_THROWS_AS(read_state(file), InputError); // nothing there
    std::vector<Vec3> shown;
    {
        MotionFile motion(file, simulation);
        for (int k = 0; k < 4; ++k) {
            simulation.step();
            motion.write(simulation);
            shown.assign(simulation.positions().begin(), simulation.positions().end());
        }
        motion.finish();
    }
    const Motion motion = read_motion(read_input(file), file);
    REQUIRE(motion.frame.size() == 4);
    CHECK(motion.header.fps == Approx(30));
    CHECK(apart(motion.frame[3].position, shown) < 1e-12);
    CHECK_THROWS_AS(MotionFile(folder / "motion.xyz", simulation), OutputError);
    CHECK_THROWS_WITH(grow("elm"), Catch::Contains("expected one of") && Catch::Contains("apple"));
    CHECK_THROWS_AS(read_scene(folder / "none.json"), InputError);
}
