// Each way a scene or a wind can be wrong, with the place and the message.
#include "formats/documents/scene.h"
#include "tests/support/random_documents.h"

using namespace bough;
using namespace bough::test;
using Catch::Contains;
using Catch::StartsWith;

namespace {

std::string scene_error(const std::string& fields) {
    return error_of([&] { read_scene_document(R"({"format": "bough-scene", "version": 1, )" + fields + "}", "s"); });
}

} // namespace

TEST_CASE("scenes name the nested place") {
    CHECK(scene_error("\"wind\": \"gusty\"") == "");
    CHECK_THAT(scene_error("\"wind\": \"gale\""),
               StartsWith("s: /wind: is \"gale\", expected calm, breeze, gusty, storm"));
    CHECK(scene_error("\"wind\": {\"velocity\": [1, 0, 0], \"gust\": 2}") ==
          "s: /wind/gust: is an unknown field, expected one of grid, gust_factor, gust_period, period, profile, "
          "reference_height, seed, shelter, swirl, turbulence, velocity");
    CHECK(scene_error("\"wind\": {\"velocity\": [1, 0]}") == "s: /wind/velocity: has 2 numbers, expected 3 (x, y, z)");
    CHECK(scene_error("\"wind\": {}") == "s: /wind/velocity: is missing");
    CHECK(scene_error("\"wind\": {\"velocity\": [1, 0, 0], \"gust_period\": 0}") ==
          "s: /wind/gust_period: is 0, expected more than 0");
    CHECK(scene_error("\"trees\": [{\"file\": \"a\"}, {\"file\": 7}]") == "s: /trees/1/file: is 7, expected text");
    CHECK(scene_error("\"trees\": [{\"yaw\": 7}]") == "s: /trees/0/file: is missing");
    CHECK(scene_error("\"gravitty\": [0, 0, 0]") == "s: /gravitty: is an unknown field, did you mean \"gravity\"?");
    CHECK(scene_error("\"gravity\": [0, \"x\", 0]") == "s: /gravity/1: is \"x\", expected a number");
    CHECK(scene_error("\"pose\": \"sitting\"") == "s: /pose: is \"sitting\", expected one of drawn, settled, rest");
    CHECK(scene_error("\"air_density\": -1") == "s: /air_density: is -1, expected 0 or more");
    const std::string degrees = ", expected degrees, more than 0 and at most 180";
    CHECK(scene_error("\"joint_limit\": 0") == "s: /joint_limit: is 0" + degrees);
    CHECK(scene_error("\"joint_limit\": {\"leaf\": 181}") == "s: /joint_limit/leaf: is 181" + degrees);
    CHECK(scene_error("\"joint_limit\": {\"fruit\": [5, 5, -1]}") == "s: /joint_limit/fruit/2: is -1" + degrees);
    CHECK(scene_error("\"joint_limit\": {\"fruit\": [5, 5]}") ==
          "s: /joint_limit/fruit: has 2 numbers, expected 3 (x, y, z)");
    CHECK(scene_error("\"joint_limit\": \"30\"") ==
          "s: /joint_limit: is \"30\", expected a number of degrees or an object with branch, leaf, fruit");
    CHECK(scene_error("\"joint_limit\": {\"twig\": 5}").rfind("s: /joint_limit/twig: ", 0) == 0);
    CHECK(scene_error("\"leaves\": {}") == "");
    CHECK(scene_error("\"leaves\": {\"kappa\": -1}") == "s: /leaves/kappa: is -1, expected 0 or more");
    CHECK(scene_error("\"leaves\": {\"air_resistance\": -2}") ==
          "s: /leaves/air_resistance: is -2, expected 0 or more");
    CHECK(scene_error("\"leaves\": {\"drag_ratio\": 0}") == "s: /leaves/drag_ratio: is 0, expected more than 0");
    CHECK(scene_error("\"leaves\": {\"offset\": \"x\"}") == "s: /leaves/offset: is \"x\", expected a number");
    CHECK(scene_error("\"leaves\": {\"nu\": 1}").rfind("s: /leaves/nu: is an unknown field", 0) == 0);
    CHECK(scene_error("\"leaves\": 1").rfind("s: /leaves: is 1, expected ", 0) == 0);
    const auto wood = [](const std::string& fields) { return scene_error("\"wood\": {" + fields + "}"); };
    CHECK(wood("") == "");
    CHECK(wood("\"branch\": {\"stiffness\": -1}") == "s: /wood/branch/stiffness: is -1, expected 0 or more");
    CHECK(wood("\"leaf\": {\"density\": 0}") == "s: /wood/leaf/density: is 0, expected more than 0");
    CHECK(wood("\"petal\": {\"damping\": \"x\"}") == "s: /wood/petal/damping: is \"x\", expected a number");
    CHECK(wood("\"fruit\": 2").rfind("s: /wood/fruit: is 2, expected ", 0) == 0);
    CHECK(wood("\"twig\": {}").rfind("s: /wood/twig: is an unknown field", 0) == 0);
    const auto curve = [&](const std::string& fields) { return wood("\"curves\": [{" + fields + "}]"); };
    CHECK(curve("\"radius\": [0, 0.1], \"stiffness\": [1, 2]") == "");
    CHECK(curve("\"stiffness\": [1, 2]") == "s: /wood/curves/0/radius: is missing");
    CHECK(curve("\"radius\": [], \"stiffness\": []") ==
          "s: /wood/curves/0/radius: is empty, expected at least one radius");
    CHECK(curve("\"radius\": [0.1]") == "s: /wood/curves/0: changes nothing, expected stiffness or damping");
    CHECK(curve("\"radius\": [0, 0.1], \"stiffness\": []") ==
          "s: /wood/curves/0/stiffness: has 0 keys, expected 2 (one for each radius)");
    CHECK(curve("\"radius\": [0, 0.1], \"damping\": [1]") ==
          "s: /wood/curves/0/damping: has 1 key, expected 2 (one for each radius)");
    CHECK(curve("\"radius\": [0.1, 0.1], \"damping\": [1, 1]") ==
          "s: /wood/curves/0/radius/1: is 0.1, expected more than the one before it");
    CHECK(curve("\"radius\": [0.1], \"stiffness\": [-3]") ==
          "s: /wood/curves/0/stiffness/0: is -3, expected 0 or more");
    CHECK(curve("\"radius\": [0.1], \"stiffness\": [3], \"on\": {}") ==
          "s: /wood/curves/0/on: names no body, expected body, branch, nearest or level");
    CHECK(curve("\"radius\": [0.1], \"stiffness\": [3], \"on\": {\"tree\": 1, \"body\": 0}") ==
          "s: /wood/curves/0/on/tree: is 1, expected a tree of the scene, 0 to less than 1");
    CHECK(curve("\"radius\": [0.1], \"stiffness\": [3], \"relative\": 1") ==
          "s: /wood/curves/0/relative: is 1, expected true or false");
    CHECK(wood("\"fork\": {\"factor\": 2}") == "s: /wood/fork/length: is missing");
    CHECK(wood("\"fork\": {\"factor\": 0, \"length\": 1}") == "s: /wood/fork/factor: is 0, expected more than 0");
    CHECK(wood("\"fork\": {\"factor\": 2, \"length\": 0}") == "s: /wood/fork/length: is 0, expected more than 0");
    CHECK(scene_error("\"load\": {\"leaf\": 1}") == "");
    CHECK(scene_error("\"load\": {\"leaf\": -1}") == "s: /load/leaf: is -1, expected 0 or more");
    CHECK(scene_error("\"load\": 1").rfind("s: /load: is 1, expected ", 0) == 0);
    CHECK(scene_error("\"load\": {\"snow\": 1}").rfind("s: /load/snow: is an unknown field", 0) == 0);
    CHECK(scene_error("\"fictitious\": {\"turning\": 0.1}") == "");
    CHECK(scene_error("\"fictitious\": {\"turning\": -1}") == "s: /fictitious/turning: is -1, expected 0 or more");
    CHECK(scene_error("\"fictitious\": {\"coriolis\": 1}").rfind("s: /fictitious/coriolis: is an unknown field", 0) ==
          0);
    CHECK(scene_error("\"air_density\": 1, \"air_density\": 1") == "s: /air_density: appears twice");
    CHECK_THAT(scene_error("\"gravity\": [0, NaN, 0]"), StartsWith("s:1:") && Contains("/gravity/1 is NaN"));

    const auto pull = [](const std::string& on, const std::string& rest) {
        return scene_error("\"pulls\": [{\"on\": " + on + ", " + rest + "}]");
    };
    const std::string good = "\"time\": [0, 1], \"force\": [[0, 0, 1], [0, 0, 2]]";
    CHECK(pull("{\"body\": 3}", good) == "");
    CHECK(pull("{\"body\": 3}", "\"time\": [0, 1], \"force\": [0, 0, 1, 0, 0, 2]") == "");
    CHECK(pull("{}", good) == "s: /pulls/0/on: names no body, expected body, branch, nearest or level");
    CHECK(pull("{\"body\": 3, \"level\": 1}", good) ==
          "s: /pulls/0/on/level: stands beside \"body\", expected only one of them");
    CHECK(pull("{\"level\": 1, \"at\": 1}", good) == "s: /pulls/0/on/at: goes only with branch");
    CHECK(pull("{\"branch\": 1, \"at\": 2}", good) == "s: /pulls/0/on/at: is 2, expected 0 to 1");
    CHECK_THAT(pull("{\"body\": 1, \"tree\": 1}", good), StartsWith("s: /pulls/0/on/tree: is 1, expected a tree"));
    CHECK_THAT(pull("{\"body\": -1}", good), StartsWith("s: /pulls/0/on/body: is -1, expected 0 or more"));
    CHECK_THAT(pull("{\"body\": 3}", "\"time\": [0, 0], \"force\": [[0, 0, 1], [0, 0, 2]]"),
               StartsWith("s: /pulls/0/time/1: is 0"));
    CHECK_THAT(pull("{\"body\": 3}", "\"time\": [0], \"force\": [[0, 0, 1], [0, 0, 2]]"),
               StartsWith("s: /pulls/0/force: has 2 forces"));
    CHECK(pull("{\"body\": 3}", "\"time\": [0, 1], \"force\": [[0, 0, 1], [0, \"x\", 2]]") ==
          "s: /pulls/0/force/1/1: is \"x\", expected a number");
    CHECK(pull("{\"body\": 3}", "\"time\": [0]") == "s: /pulls/0/force: is missing");
}

TEST_CASE("what a scene simulates names the nested place") {
    const auto simulate = [](const std::string& fields) { return scene_error("\"simulate\": {" + fields + "}"); };
    CHECK(simulate("\"last_level\": 1") == "");
    CHECK(simulate("\"subtrees\": [{\"body\": 3}], \"radius\": 0.01") == "");
    CHECK(simulate("") ==
          "s: /simulate: leaves nothing out, expected first_level, last_level, radius, subtrees, box or error");
    CHECK(simulate("\"first_level\": -1") == "s: /simulate/first_level: is -1, expected 0 or more");
    CHECK(simulate("\"first_level\": 2, \"last_level\": 1") ==
          "s: /simulate/last_level: is 1, expected at least /simulate/first_level, 2");
    CHECK(simulate("\"last_level\": \"all\"") == "s: /simulate/last_level: is \"all\", expected an integer");
    CHECK(simulate("\"radius\": -0.1") == "s: /simulate/radius: is -0.1, expected 0 or more");
    CHECK(simulate("\"subtrees\": [{\"body\": 3}, {}]") ==
          "s: /simulate/subtrees/1: names no body, expected body, branch, nearest or level");
    CHECK(simulate("\"subtrees\": [{\"body\": -3}]") == "s: /simulate/subtrees/0/body: is -3, expected 0 or more");
    CHECK(simulate("\"subtrees\": [{\"level\": 3, \"point\": [0, 0, 0]}]") ==
          "s: /simulate/subtrees/0/point: goes only with body");
    CHECK(simulate("\"box\": {\"least\": [0, 0, 0]}") == "s: /simulate/box/most: is missing");
    CHECK(simulate("\"box\": {\"least\": [0, 0, 2], \"most\": [1, 1, 1]}") ==
          "s: /simulate/box/most/2: is 1, expected at least that of /simulate/box/least, 2");
    CHECK(simulate("\"error\": -1") == "s: /simulate/error: is -1, expected 0 or more");
    const std::string view = "\"view\": {\"from\": [0, 2, 20]";
    CHECK(simulate("\"error\": 2, " + view + "}") == "");
    CHECK(simulate(view + "}") == "s: /simulate/view: goes only with /simulate/error, in pixels then");
    CHECK(simulate("\"error\": 2, " + view + ", \"angle\": 180}") ==
          "s: /simulate/view/angle: is 180, expected more than 0 and less than 180");
    CHECK(simulate("\"error\": 2, " + view + ", \"pixels\": 0}") ==
          "s: /simulate/view/pixels: is 0, expected more than 0");
    CHECK(simulate("\"error\": 2, \"view\": {}") == "s: /simulate/view/from: is missing");
    CHECK_THAT(simulate("\"levels\": 2"), StartsWith("s: /simulate/levels: is an unknown field"));
    CHECK_THAT(scene_error("\"simulate\": {\"last_level\": 1}, \"fracture\": {\"leaf\": 1}"),
               StartsWith("s: /simulate: stands beside /fracture, expected one of them"));
    CHECK_THAT(scene_error("\"simulate\": {\"last_level\": 1}, \"balls\": [{\"position\": [0, 1, 0], \"radius\": 1, "
                           "\"mass\": 1}]"),
               StartsWith("s: /simulate: stands beside /balls, expected one of them"));
}

TEST_CASE("root motion names the nested place") {
    const auto moved = [](const std::string& fields) { return scene_error("\"root_motion\": [{" + fields + "}]"); };
    const std::string time = "\"time\": [0, 1], ";
    CHECK(moved(time + "\"position\": [[0, 0, 0], [1, 0, 0]]") == "");
    CHECK(moved(time + "\"position\": [0, 0, 0, 1, 0, 0], \"rotation\": [0, 0, 0, 1, 0, 1, 0, 0]") == "");
    CHECK(moved(time + "\"rotation\": [[0, 0, 0, 1], [0, 1, 0, 0]]") == "");
    CHECK(moved("\"position\": [[0, 0, 0], [1, 0, 0]]") == "s: /root_motion/0/time: is missing");
    CHECK(moved("\"time\": [0], \"position\": [[0, 0, 0]]") ==
          "s: /root_motion/0/time: has 1 time, expected at least 2");
    CHECK(moved("\"time\": [0, -1], \"position\": [[0, 0, 0], [1, 0, 0]]") ==
          "s: /root_motion/0/time/1: is -1, expected more than 0 (times rise)");
    CHECK(moved("\"time\": [0, 1]") == "s: /root_motion/0: moves nothing, expected position or rotation");
    CHECK(moved(time + "\"position\": []") == "s: /root_motion/0/position: has 0 keys, expected 2 (one for each time)");
    CHECK(moved(time + "\"position\": [[0, 0, 0]]") ==
          "s: /root_motion/0/position: has 1 key, expected 2 (one for each time)");
    CHECK(moved(time + "\"position\": [[0, 0, 0], [1, 0]]") ==
          "s: /root_motion/0/position/1: has 2 numbers, expected 3 (x, y, z)");
    CHECK(moved(time + "\"rotation\": [[0, 0, 0, 1], [1, 0, 0]]") ==
          "s: /root_motion/0/rotation/1: has 3 numbers, expected 4 (x, y, z, w)");
    CHECK(moved(time + "\"rotation\": [[0, 0, 0, 1], [1, 0, \"x\", 0]]") ==
          "s: /root_motion/0/rotation/1/2: is \"x\", expected a number");
    CHECK(moved(time + "\"rotation\": [[0, 0, 0, 1], [1, 0, 0, 1]]") ==
          "s: /root_motion/0/rotation/1: has length 1.4142135623730951, expected a unit quaternion");
    CHECK(moved(time + "\"rotation\": [0, 0, 0, 1, 0, 0, 0]") ==
          "s: /root_motion/0/rotation: has 7 numbers, expected a multiple of 4 (x, y, z, w)");
    CHECK(moved(time + "\"tree\": 1, \"position\": [[0, 0, 0], [1, 0, 0]]") ==
          "s: /root_motion/0/tree: is 1, expected a tree of the scene, 0 to less than 1");
    const std::string good = time + "\"position\": [[0, 0, 0], [1, 0, 0]]";
    CHECK(moved(good + "}, {" + good) == "s: /root_motion/1/tree: is 0, which /root_motion/0 moves already");
    CHECK_THAT(moved(good + ", \"rotations\": []"), StartsWith("s: /root_motion/0/rotations: is an unknown field"));
}

TEST_CASE("a grid over the ground, a swirl, a shelter say what is wrong with them") {
    const auto wind = [](const std::string& fields) {
        return scene_error("\"wind\": {\"velocity\": [1, 0, 0], " + fields + "}");
    };
    const std::string head = "\"grid\": {\"origin\": [0, 0], \"cell\": 2, \"columns\": 2, \"rows\": 3";
    const auto grid = [&](const std::string& more) { return wind(head + more + "}"); };
    CHECK(grid("") == "");
    CHECK(grid(", \"velocity\": [1, 2, 3], \"octaves\": 3, \"persistence\": 0.5, \"phase\": [0, 1, 2, 3, 4, 5]") == "");
    CHECK(grid(", \"velocity\": [[1, 2, 3], [1, 2, 3]]") ==
          "s: /wind/grid/velocity: has 2 values, expected 1 or 6 (one for each cell)");
    CHECK(grid(", \"velocity\": []") ==
          "s: /wind/grid/velocity: is empty, expected one [x, y, z], or one for each cell");
    CHECK(grid(", \"phase\": [1, 2]") == "s: /wind/grid/phase: has 2 values, expected 1 or 6 (one for each cell)");
    CHECK(grid(", \"phase\": []") == "s: /wind/grid/phase: has 0 values, expected 1 or 6 (one for each cell)");
    CHECK(grid(", \"octaves\": [0, 1, 2, -1, 0, 0]") == "s: /wind/grid/octaves/3: is -1, expected 0 to 32 octaves");
    CHECK(grid(", \"octaves\": 33") == "s: /wind/grid/octaves: is 33, expected 0 to 32 octaves");
    CHECK(grid(", \"octaves\": 1.5") == "s: /wind/grid/octaves: is 1.5, expected an integer");
    CHECK(grid(", \"octaves\": [1, 1.5, 1, 1, 1, 1]") ==
          "s: /wind/grid/octaves/1: is 1.5, expected an integer of 32 bits");
    CHECK(grid(", \"octaves\": [1, 99999999999, 1, 1, 1, 1]") ==
          "s: /wind/grid/octaves/1: is 99999999999, expected an integer of 32 bits");
    CHECK(grid(", \"persistence\": -0.5") == "s: /wind/grid/persistence: is -0.5, expected 0 or more");
    CHECK(grid(", \"frequency\": 0") == "s: /wind/grid/frequency: is 0, expected more than 0");
    CHECK_THAT(grid(", \"speed\": 1"), StartsWith("s: /wind/grid/speed: is an unknown field"));
    CHECK(wind("\"grid\": {\"origin\": [0], \"cell\": 2, \"columns\": 2, \"rows\": 3}") ==
          "s: /wind/grid/origin: has 1 number, expected 2 (x, z)");
    CHECK(wind("\"grid\": {\"origin\": [0, 0], \"cell\": 0, \"columns\": 2, \"rows\": 3}") ==
          "s: /wind/grid/cell: is 0, expected more than 0");
    CHECK(wind("\"grid\": {\"origin\": [0, 0], \"cell\": 1, \"columns\": 0, \"rows\": 3}") ==
          "s: /wind/grid/columns: is 0, expected 1 or more");
    CHECK(wind("\"grid\": {\"origin\": [0, 0], \"cell\": 1, \"columns\": 3000, \"rows\": 3000}") ==
          "s: /wind/grid: has 9000000 cells, expected at most 4194304");
    CHECK(wind("\"grid\": {\"origin\": [0, 0], \"cell\": 1, \"columns\": 1}") == "s: /wind/grid/rows: is missing");
    CHECK(wind("\"grid\": 3") == "s: /wind/grid: is 3, expected an object");

    CHECK(wind("\"swirl\": {\"angle\": 20}") == "");
    CHECK(wind("\"swirl\": {\"angle\": [20, 30], \"radius\": [0, 4], \"wavelength\": 3, \"center\": [1, 2]}") == "");
    CHECK(wind("\"swirl\": {}") == "s: /wind/swirl/angle: is missing");
    CHECK(wind("\"swirl\": {\"angle\": [20, 30]}") ==
          "s: /wind/swirl/angle: has 2 keys, expected 1 (radius names no more)");
    CHECK(wind("\"swirl\": {\"angle\": 20, \"radius\": [0, 4]}") ==
          "s: /wind/swirl/angle: has 1 key, expected 2 (one for each radius)");
    CHECK(wind("\"swirl\": {\"angle\": [1, 200], \"radius\": [0, 4]}") ==
          "s: /wind/swirl/angle/1: is 200, expected -180 to 180 degrees");
    CHECK(wind("\"swirl\": {\"angle\": [1, 2], \"radius\": [4, 4]}") ==
          "s: /wind/swirl/radius/1: is 4, expected more than the one before it");
    CHECK(wind("\"swirl\": {\"angle\": 1, \"period\": -1}") == "s: /wind/swirl/period: is -1, expected more than 0");
    CHECK(wind("\"swirl\": {\"angle\": 1, \"wavelength\": 0}") ==
          "s: /wind/swirl/wavelength: is 0, expected more than 0");

    CHECK(wind("\"shelter\": {\"cell\": 0.5}") == "");
    CHECK(wind("\"shelter\": {}") == "s: /wind/shelter/cell: is missing");
    CHECK(wind("\"shelter\": {\"cell\": -1}") == "s: /wind/shelter/cell: is -1, expected more than 0");
    CHECK(scene_error("\"wind\": {\"velocity\": [0, 0, 0], \"shelter\": {\"cell\": 1}}") ==
          "s: /wind/shelter: needs a direction, but /wind/velocity is zero");
    CHECK(wind("\"period\": 0") == "s: /wind/period: is 0, expected more than 0");
}

TEST_CASE("a wind document has its own places") {
    const auto wrong = [](const std::string& fields) {
        return error_of([&] { read_wind(R"({"format": "bough-wind", "version": 1, )" + fields + "}", "w"); });
    };
    CHECK(wrong("\"velocity\": [1, 0, 0]") == "");
    CHECK(wrong("\"velocity\": [1, 0, 0], \"turbulence\": -1") == "w: /turbulence: is -1, expected 0 or more");
    CHECK(wrong("\"speed\": 1") == "w: /velocity: is missing");
    CHECK(wrong("\"velocity\": [1, 0, 0], \"swirl\": {\"angle\": \"wide\"}") ==
          "w: /swirl/angle: is \"wide\", expected a number or a list of them");
    CHECK(wrong("\"velocity\": [1, 0, 0], \"swirl\": {\"angle\": 1, \"period\": 0}") ==
          "w: /swirl/period: is 0, expected more than 0");
}
