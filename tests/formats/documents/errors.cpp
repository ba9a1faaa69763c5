// Each way a document can be wrong, with the place and the message; then every cut and every flipped byte.
#include "formats/documents/motion.h"
#include "formats/documents/scene.h"
#include "formats/documents/splines.h"
#include "formats/documents/tree.h"
#include "tests/support/random_documents.h"
#include "tests/support/sanitized.h"
#include <cstring>

using namespace bough;
using namespace bough::test;
using Catch::Contains;
using Catch::Equals;
using Catch::StartsWith;

namespace {

// Two bodies, a line of the file for each field.
const std::string two_bodies = R"({
"format": "bough-tree",
"version": 1,
"name": "oak",
"parent": [-1, 0],
"kind": [0, 1],
"mass": [2, 3],
"com": [0, 0, 0.5, 0, 0, 0.5],
"inertia": [0.2, 0.2, 0.01, 0, 0, 0, 0.2, 0.2, 0.01, 0, 0, 0],
"joint_position": [0, 0, 0, 0, 0, 1],
"joint_rotation": [0, 0, 0, 1, 0, 0, 0, 1],
"stiffness": [10, 10, 5, 10, 10, 5],
"damping": [0.1, 0.1],
"size": [1, 0.1, 0.05, 1, 0.05, 0.01],
"branch": [0, 0],
"level": [0, 0],
"s": [0, 0.5]
}
)";

std::string tree_error(const std::string& text) {
    const std::string error = error_of([&] { read_tree(text, "t.json"); });
    CHECK(error.find('\n') == std::string::npos);
    return error;
}

std::string changed(const std::string& from, const std::string& to) {
    return tree_error(replaced(two_bodies, from, to));
}

std::string scene_error(const std::string& fields) {
    return error_of([&] { read_scene(R"({"format": "bough-scene", "version": 1, )" + fields + "}", "s"); });
}

// A safetensors file made by hand.
std::string binary(const std::string& header, const std::string& data) {
    std::string length(8, '\0');
    const std::uint64_t size = header.size();
    std::memcpy(length.data(), &size, 8);
    return length + header + data;
}

std::string binary_tree() {
    const Tree tree = read_tree(two_bodies, "t");
    return written([&](Output& o) { write_tree(o, tree, Form::safetensors); });
}

// The same file with its header changed (`data` bytes added at the end).
std::string changed_header(const std::string& from, const std::string& to, const std::string& data = "") {
    const std::string file = binary_tree();
    std::uint64_t size = 0;
    std::memcpy(&size, file.data(), 8);
    return binary(replaced(file.substr(8, size), from, to), file.substr(8 + size) + data);
}

} // namespace

TEST_CASE("the two bodies are right before they are made wrong") {
    CHECK(tree_error(two_bodies) == "");
}

TEST_CASE("a wrong field is named with its place") {
    CHECK(changed("\"mass\"", "\"masss\"") == "t.json: /masss: is an unknown field, did you mean \"mass\"?");
    CHECK_THAT(changed("\"mass\"", "\"weather\""),
               StartsWith("t.json: /weather: is an unknown field, expected one of "));
    CHECK(changed("[2, 3]", "7") == "t.json: /mass: is 7, expected a flat array of numbers");
    CHECK(changed("[2, 3]", "[2, \"x\"]") == "t.json: /mass/1: is \"x\", expected a number");
    CHECK(changed("[2, 3]", "[2, null]") == "t.json: /mass/1: is null, expected a number");
    CHECK(changed("[2, 3]", "[[2], [3]]") == "t.json: /mass/0: is an array, expected a number");
    CHECK(changed("[2, 3]", "[2, {\"a\": 3}]") == "t.json: /mass/1: is an object, expected a number");
    CHECK(changed("[-1, 0]", "[-1, 0.5]") == "t.json: /parent/1: is 0.5, expected an integer");
    CHECK(changed("[-1, 0]", "[-1, 3000000000]") ==
          "t.json: /parent/1: is 3000000000, expected an integer from -2147483648 to 2147483647");
    CHECK(changed("\"oak\"", "12") == "t.json: /name: is 12, expected text");
    CHECK(changed("\"oak\"", "[]") == "t.json: /name: is an array, expected text");
    CHECK(changed("[2, 3]", "[2, 3, 4]") == "t.json: /mass: has 3 numbers, expected 2 (one for each body in /parent)");
    CHECK(changed("[0, 0, 0.5, 0, 0, 0.5]", "[0, 0, 0.5, 0]") ==
          "t.json: /com: has 4 numbers, expected 6 (3 for each body in /parent)");
    CHECK(changed("\"mass\": [2, 3],\n", "") == "t.json: /mass: is missing");
    CHECK(changed("\"mass\"", "\"com\": [], \"com\"") == "t.json: /com: appears twice");
    CHECK(changed("\"kind\": [0, 1],\n", "") == "");
}

TEST_CASE("rules between fields are named with their place") {
    CHECK_THAT(changed("[-1, 0]", "[-1, 1]"), StartsWith("t.json: /parent/1: is 1, expected -1 or less than 1"));
    CHECK_THAT(changed("[-1, 0]", "[1, 0]"), StartsWith("t.json: /parent/0: is 1, expected -1"));
    CHECK_THAT(changed("[-1, 0]", "[-1, -2]"), StartsWith("t.json: /parent/1: is -2, expected -1 or"));
    CHECK(changed("[0, 1]", "[0, 4]") ==
          "t.json: /kind/1: is 4, expected 0 (branch), 1 (leaf), 2 (fruit) or 3 (petal)");
    CHECK(changed("[2, 3]", "[2, 0]") == "t.json: /mass/1: is 0, expected more than 0");
    CHECK_THAT(changed("1, 0, 0, 0, 1]", "1, 0, 0, 0, 2]"),
               Equals("t.json: /joint_rotation/4: body 1 has length 2, expected a unit quaternion"));
    CHECK_THAT(changed("[0.2, 0.2, 0.01", "[0.2, 0.2, 0.41"), StartsWith("t.json: /inertia/0: body 0 has principal"));
    CHECK_THAT(changed("[0, 0.5]", "[0, 1.5]"), Equals("t.json: /s/1: is 1.5, expected 0 to 1"));
}

TEST_CASE("numbers that are not finite are refused") {
    CHECK(changed("[2, 3]", "[2, NaN]") == "t.json:7:13: /mass/1 is NaN, expected a finite number");
    CHECK(changed("[2, 3]", "[2, Infinity]") == "t.json:7:13: /mass/1 is Infinity, expected a finite number");
    CHECK(changed("[2, 3]", "[2, -Infinity]") == "t.json:7:13: /mass/1 is -Infinity, expected a finite number");
    CHECK(changed("[2, 3]", "[2, 1e999]") == "t.json:7:13: /mass/1 is 1e999, expected a finite number");
    CHECK(changed("[2, 3]", "[2, nan]") == "t.json:7:13: /mass/1 is nan, expected a finite number");

    std::string file = binary_tree();
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
        const double three = 3;
        const std::string bytes(reinterpret_cast<const char*>(&bad), 8), now(reinterpret_cast<const char*>(&three), 8);
        CHECK_THAT(tree_error(replaced(file, now, bytes)), StartsWith("t.json: /mass/1: is "));
    }
}

TEST_CASE("another document, or none, is called what it is") {
    CHECK(changed("bough-tree", "bough-splines") ==
          "t.json: is a bough-splines document, expected bough-tree: run treeconvert on it first");
    CHECK(changed("bough-tree", "gltf") == "t.json: /format: is \"gltf\", expected \"bough-tree\"");
    CHECK(changed("\"version\": 1", "\"version\": 2") ==
          "t.json: /version: is 2, newer than this program, which reads 1");
    CHECK(changed("\"version\": 1", "\"version\": 2, \"new\": []") ==
          "t.json: /version: is 2, newer than this program, which reads 1");
    CHECK(changed("\"version\": 1", "\"version\": 0") == "t.json: /version: is 0, expected 1");
    CHECK(changed("\"version\": 1", "\"version\": \"1\"") == "t.json: /version: is \"1\", expected an integer");
    CHECK(changed("\"version\": 1,\n", "") == "t.json: /version: is missing");
    CHECK(changed("\"format\": \"bough-tree\",\n", "") == "t.json: /format: is missing");
    CHECK(tree_error(R"({"name": "a-package", "files": []})") == "t.json: /format: is missing");
    CHECK(tree_error("") == "t.json: is empty, expected a bough-tree document");
    CHECK(tree_error(" \n\t") == "t.json: is empty, expected a bough-tree document");
    CHECK(tree_error("<xml/>") == "t.json: is neither JSON nor safetensors, expected a bough-tree document");
    CHECK(tree_error("[1, 2]") == "t.json: is neither JSON nor safetensors, expected a bough-tree document");
    // The format may stand last: it still says what the document is.
    std::string last = replaced(two_bodies, "\"format\": \"bough-tree\",\n", "");
    last = replaced(last, "\"s\": [0, 0.5]\n", "\"s\": [0, 0.5], \"format\": \"bough-motion\"\n");
    CHECK(tree_error(last) == "t.json: is a bough-motion document, expected bough-tree");
}

TEST_CASE("text that is no JSON is shown by line and column") {
    CHECK_THAT(changed("[2, 3]", "[2 3]"), StartsWith("t.json:7:12: in /mass/1: syntax error"));
    CHECK_THAT(changed("\"oak\",", "\"oak\""),
               StartsWith("t.json:5:1: in /name: syntax error") && Contains("expected ',' or '}'"));
    CHECK_THAT(changed("[2, 3]", "[2, 3,]"), StartsWith("t.json:7:15: "));
    CHECK_THAT(changed("\"s\"", "'s'"), StartsWith("t.json:17:1: "));
    CHECK_THAT(tree_error(two_bodies + "x"), StartsWith("t.json:19:1: "));
    const std::string cut = two_bodies.substr(0, two_bodies.find("3],"));
    CHECK(tree_error(cut) ==
          "t.json:7: ends here inside /mass/1, expected the rest of the document: is the file whole?");
    CHECK_THAT(tree_error(two_bodies.substr(0, 1)), StartsWith("t.json:1: ends here"));
    CHECK_THAT(tree_error(two_bodies + std::string(100000, '[')), StartsWith("t.json:19:1: "));
    CHECK_THAT(changed("\"oak\"", "\"\xff\""), StartsWith("t.json:4:10: "));
    CHECK_THAT(changed("[2, 3]", "[2, " + std::string(1'000'000, '[')), StartsWith("t.json: /mass/1: is an array"));
}

TEST_CASE("splines name the branch that is wrong") {
    const std::string good = R"({"format": "bough-splines", "version": 1, "parent": [-1, 0], "parent_at": [0, 0.5],
"level": [0, 1], "first_point": [0, 2, 4], "point": [0,0,0, 0,1,0, 0,0,0, 1,1,0], "radius": [1,1,1,1],
"leaf_branch": [1], "leaf_at": [0.5], "leaf_position": [0,0,0], "leaf_rotation": [0,0,0,1], "leaf_length": [1], "leaf_width": [1]})";
    const auto wrong = [&](const std::string& from, const std::string& to) {
        return error_of([&] { read_splines(replaced(good, from, to), "s"); });
    };
    CHECK(wrong("0.5", "0.5") == "");
    CHECK_THAT(wrong("[0, 2, 4]", "[0, 3, 4]"), StartsWith("s: /first_point/2: is 4, expected 5 or more"));
    CHECK_THAT(wrong("[0, 2, 4]", "[0, 2, 5]"),
               StartsWith("s: /first_point/2: is 5, expected the number of points, 4"));
    CHECK_THAT(wrong("[0, 2, 4]", "[1, 2, 4]"), StartsWith("s: /first_point/0: is 1, expected 0"));
    CHECK(wrong("[0, 2, 4]", "[0, 4]") ==
          "s: /first_point: has 2 numbers, expected 3 (one for each branch in /parent, and the end)");
    CHECK_THAT(wrong("1,1,0]", "1,1]"), StartsWith("s: /point: has 11 numbers, expected a multiple of 3"));
    CHECK_THAT(wrong("[1,1,1,1]", "[1,1,-1,1]"), StartsWith("s: /radius/2: is -1, expected 0 or more"));
    CHECK_THAT(wrong("[1], \"leaf_at\"", "[2], \"leaf_at\""), StartsWith("s: /leaf_branch/0: is 2, expected a branch"));
    CHECK_THAT(wrong("\"leaf_width\": [1]", "\"leaf_width\": [0]"),
               StartsWith("s: /leaf_width/0: is 0, expected more"));
    CHECK_THAT(wrong(", \"leaf_width\": [1]", ""),
               StartsWith("s: /leaf_width: is missing, expected 1 (one for each leaf"));
}

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

TEST_CASE("rigid names body and what is expected") {
    const std::string s = "\"s\": [0, 0.5]";
    CHECK(changed(s, s + ", \"rigid\": [0, 1]") == "");
    CHECK(changed(s, s + ", \"rigid\": [0, 2]") ==
          "t.json: /rigid/1: is 2, expected 0 (its joint moves) or 1 (it is rigid)");
    CHECK(changed(s, s + ", \"rigid\": [1]") ==
          "t.json: /rigid: has 1 number, expected 2 (one for each body in /parent)");
    CHECK(changed(s, s + ", \"rigid\": [0, 0.5]") == "t.json: /rigid/1: is 0.5, expected an integer");
}

TEST_CASE("leaf_count names body and what is expected") {
    const std::string s = "\"s\": [0, 0.5]";
    CHECK(changed(s, s + ", \"leaf_count\": [1, 12]") == "");
    CHECK(changed(s, s + ", \"leaf_count\": [1, 0]") == "t.json: /leaf_count/1: is 0, expected 1 or more");
    CHECK(changed(s, s + ", \"leaf_count\": [2, 1]") ==
          "t.json: /leaf_count/0: is 2, expected 1 (only a leaf stands for more)");
    CHECK(changed(s, s + ", \"leaf_count\": [1]") ==
          "t.json: /leaf_count: has 1 number, expected 2 (one for each body in /parent)");
    CHECK(changed(s, s + ", \"leaf_count\": [1, 1.5]") == "t.json: /leaf_count/1: is 1.5, expected an integer");
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

TEST_CASE("motions name the line of the frame") {
    const std::string head =
        "{\"format\": \"bough-motion\", \"version\": 1, \"fps\": 30, \"bodies\": 1, \"fields\": [\"pose\"]}\n";
    const std::string frame = "{\"frame\": 0, \"time\": 0, \"position\": [0, 0, 0], \"rotation\": [0, 0, 0, 1]}\n";
    const auto wrong = [](const std::string& text) { return error_of([&] { read_motion(text, "m"); }); };
    CHECK(wrong(head + frame + frame) == "");
    CHECK(wrong(head + frame + replaced(frame, "[0, 0, 0]", "[0, 0, 0, 0, 0, 0]")) ==
          "m:3: /position: has 6 numbers, expected 3 (3 for each of 1 body)");
    CHECK(wrong(head + frame + replaced(frame, "\"time\": 0, ", "")) == "m:3: /time: is missing");
    CHECK(wrong(head + replaced(frame, "position", "positions")) ==
          "m:2: /positions: is an unknown field, did you mean \"position\"?");
    CHECK_THAT(wrong(head + frame + frame.substr(0, 30)), StartsWith("m:3: ends here"));
    CHECK_THAT(wrong(head + replaced(frame, "[0, 0, 0]", "[0, 0 0]")), StartsWith("m:2:"));
    CHECK(wrong(replaced(head, "\"pose\"", "\"poses\"")) ==
          "m: /fields/0: is \"poses\", expected pose, velocity, torque, angles or stress");
    CHECK(wrong(head + replaced(frame, "}", ", \"torque\": [0, 0, 0]}")) ==
          "m:2: /torque: has 3 numbers, expected none: /fields does not name it");
}

TEST_CASE("a binary file is believed only as far as it goes") {
    const std::string file = binary_tree();
    REQUIRE(tree_error(file) == "");
    const std::string metadata = "\"__metadata__\":{\"format\":\"bough-tree\",\"version\":\"1\"}";

    std::string longer = file;
    longer[7] = '\x7f';
    CHECK_THAT(tree_error(longer), Contains("longer than the file"));
    CHECK_THAT(tree_error(file.substr(0, 100)), Contains("longer than the file"));
    CHECK_THAT(tree_error(std::string(3, '\0')), StartsWith("t.json: is 3 bytes long"));
    CHECK_THAT(tree_error(file.substr(0, file.size() - 1)), Contains("/data_offsets: ends at byte"));
    CHECK(tree_error(file + "xy") == "t.json: has 2 bytes after its last array, expected none");
    CHECK_THAT(tree_error(changed_header("\"mass\"", "\"masss\"")),
               Equals("t.json: /masss: is an unknown field, did you mean \"mass\"?"));
    CHECK(tree_error(changed_header("{\"dtype\":\"I32\"", "{\"dtype\":\"F32\"")) ==
          "t.json: /parent/dtype: is F32, expected I32");
    CHECK_THAT(tree_error(changed_header("{\"dtype\":\"I32\"", "{\"dtype\":\"X\"")),
               StartsWith("t.json: /parent/dtype: is \"X\""));
    CHECK(tree_error(changed_header("\"shape\":[2,3]", "\"shape\":[3,2]")) ==
          "t.json: /com/shape: is [3, 2], expected [n, 3]");
    CHECK_THAT(tree_error(changed_header("\"shape\":[2,3]", "\"shape\":[2,4]")),
               Contains("/com/data_offsets: hold 48 bytes, expected 64"));
    CHECK_THAT(tree_error(changed_header("\"shape\":[2,3]", "\"shape\":[4611686018427387904,3]")),
               Contains("larger than any file"));
    CHECK_THAT(tree_error(changed_header("\"shape\":[2,3]", "\"shape\":[-2,3]")), Contains("/com/shape/0: is \"-2\""));
    CHECK_THAT(tree_error(changed_header("\"data_offsets\":[16,64]", "\"data_offsets\":[8,56]")),
               Contains("inside another array"));
    CHECK_THAT(tree_error(changed_header("\"data_offsets\":[16,64]", "\"data_offsets\":[64,16]")),
               Contains("is no range"));
    CHECK_THAT(tree_error(changed_header("\"data_offsets\":[16,64]",
                                         "\"data_offsets\":[18446744073709551600,18446744073709551615]")),
               Contains("ends at byte"));
    CHECK_THAT(tree_error(changed_header("\"version\":\"1\"", "\"version\":\"9\"")), Contains("/version: is 9, newer"));
    CHECK_THAT(tree_error(changed_header("\"version\":\"1\"", "\"version\":1")), Contains("/version: is not text"));
    CHECK_THAT(tree_error(changed_header("bough-tree", "bough-splines")), Contains("run treeconvert on it first"));
    CHECK_THAT(tree_error(changed_header("\"name\"", "\"nane\"")), Contains("/__metadata__/nane: is an unknown field"));
    CHECK(tree_error(binary("{" + metadata + "}", "")) == "t.json: /parent: is missing");
    CHECK(tree_error(binary("{}", "")) == "t.json: /__metadata__/format: is missing");
    CHECK_THAT(tree_error(binary("{" + metadata + "," + metadata + "}", "")), Contains("/__metadata__: appears twice"));
    CHECK_THAT(tree_error(binary("{" + metadata, "")), Contains("in its safetensors header"));
    CHECK_THAT(
        tree_error(binary("{" + metadata + ",\"mass\":{\"dtype\":\"F64\",\"shape\":[1],\"data_offsets\":[8,16]}}",
                          std::string(16, '\0'))),
        Contains("after a gap"));
}

TEST_CASE("a saved state has what its solver carries, whole, and nothing of another's") {
    const auto error = [](const std::string& solver, const std::string& carried) {
        const std::string text = "{\"format\": \"bough-state\", \"version\": 1, \"frame\": 3, \"fps\": 30, "
                                 "\"substeps\": 1, \"precision\": \"double\", \"fingerprint\": \"00c0ffee00c0ffee\", "
                                 "\"theta\": [1, 2, 3], \"theta_dot\": [4, 5, 6], \"solver\": \"" +
                                 solver + "\"" + carried + "}";
        return error_of([&] { read_state(text, "s"); });
    };
    const std::string rate = ", \"scaled_rate\": [1, 2, 3]", scheme = ", \"scheme\": \"P12\"",
                      change = ", \"theta_change\": [1, 2, 3]", dot = ", \"theta_dot_change\": [1, 2, 3]";
    for (const std::string solver : {"analytic", "articulated-implicit"}) {
        CHECK(error(solver, rate).empty());
        CHECK(error(solver, "") == "s: /scaled_rate: is missing");
        CHECK(error(solver, rate + change) == "s: /theta_change: is there, but solver \"" + solver + "\" has none");
        CHECK(error(solver, rate + scheme) == "s: /scheme: is there, but solver \"" + solver + "\" has none");
    }
    CHECK(error("coupled", scheme + change + dot).empty());
    CHECK(error("coupled", change + dot) == "s: /scheme: is missing");
    CHECK(error("coupled", scheme + dot) == "s: /theta_change: is missing");
    CHECK(error("coupled", scheme + change) == "s: /theta_dot_change: is missing");
    CHECK(error("coupled", scheme + change + dot + rate) ==
          "s: /scaled_rate: is there, but solver \"coupled\" has none");
    CHECK_THAT(error("coupled", scheme + change + ", \"theta_dot_change\": [1, 2]"), Contains("/theta_dot_change"));
    CHECK(error("a\\nb", change + rate).find('\n') == std::string::npos);
}

TEST_CASE("cut or with any byte changed, a document is read as it stands or refused") {
    Random random;
    const Tree tree = random_tree(2, random);
    Scene scene;
    scene.trees = {{"a", {1, 2, 3}, 4}};
    scene.wind = Wind{};
    scene.wind->grid.emplace();
    scene.wind->grid->cell = 1;
    scene.wind->grid->columns = scene.wind->grid->rows = 1;
    scene.wind->swirl.emplace();
    scene.wind->swirl->angle = {3};
    scene.wind->period = 9;
    scene.pulls.resize(1);
    scene.pulls[0].time = {0};
    scene.pulls[0].force = {{1, 2, 3}};
    scene.root_motion = {random_root_motion(0, 2, true, true, random)};
    const Splines splines = random_splines(2, random);
    const Motion motion = random_motion({true, true, true, true}, 1, 2, random);
    SavedState state;
    state.precision = "double";
    state.theta = state.theta_dot = state.scaled_rate = {Vec3(1, 2, 3)};
    SavedState coupled = state;
    coupled.solver = "coupled";
    coupled.scheme = "P12";
    coupled.theta_change.swap(coupled.scaled_rate);
    coupled.theta_dot_change = coupled.theta_change;

    std::vector<std::string> documents{two_bodies};
    for (const Form form : {Form::json, Form::safetensors}) {
        documents.push_back(written([&](Output& o) { write_tree(o, tree, form); }));
        documents.push_back(written([&](Output& o) { write_splines(o, splines, form); }));
        documents.push_back(written([&](Output& o) { write_scene(o, scene, form); }));
        documents.push_back(written([&](Output& o) { write_state(o, state, form); }));
        documents.push_back(written([&](Output& o) { write_state(o, coupled, form); }));
    }
    for (const MotionForm form : {MotionForm::jsonl, MotionForm::json, MotionForm::safetensors})
        documents.push_back(written([&](Output& o) {
            MotionWriter writer(o, motion.header, form);
            for (const MotionFrame& frame : motion.frame) writer.write(frame);
            writer.finish();
        }));

    std::size_t refused = 0, read = 0, wrong = 0;
    const auto try_all = [&](const std::string& text) {
        const std::string errors[] = {
            error_of([&] { read_tree(text, "f"); }), error_of([&] { read_splines(text, "f"); }),
            error_of([&] { read_scene(text, "f"); }), error_of([&] { read_motion(text, "f"); }),
            error_of([&] { read_state(text, "f"); })};
        for (const std::string& error : errors) {
            error.empty() ? ++read : ++refused;
            if (!error.empty() && (error[0] != 'f' || error[1] != ':' || error.find('\n') != std::string::npos))
                ++wrong;
        }
    };
    for (const std::string& text : documents) {
        try_all(text);
        for (std::size_t i = 0; i < text.size(); i += sanitized ? 7 : 1) {
            try_all(text.substr(0, i));
            for (const int flip : {1, 32, 128}) {
                std::string flipped = text;
                flipped[i] = char(flipped[i] ^ flip);
                try_all(flipped);
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(refused > documents.size());
    CHECK(read >= documents.size());
}
