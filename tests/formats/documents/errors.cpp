// Each way a document can be wrong, with the place and the message (scenes: scene_errors.cpp); then every cut and every flipped byte.
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
    CHECK_THAT(wrong("[1,1,1,1]", "[1,1,-1,1]"), StartsWith("s: /radius/2: is -1, expected 0 to 1e+15"));
    CHECK_THAT(wrong("[1], \"leaf_at\"", "[2], \"leaf_at\""), StartsWith("s: /leaf_branch/0: is 2, expected a branch"));
    CHECK_THAT(wrong("\"leaf_width\": [1]", "\"leaf_width\": [0]"),
               StartsWith("s: /leaf_width/0: is 0, expected more"));
    CHECK_THAT(wrong(", \"leaf_width\": [1]", ""),
               StartsWith("s: /leaf_width: is missing, expected 1 (one for each leaf"));
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

TEST_CASE("leaf_facing names body and what is expected") {
    const std::string s = "\"s\": [0, 0.5]";
    CHECK(changed(s, s + ", \"leaf_facing\": [0, 1]") == "");
    CHECK(changed(s, s + ", \"leaf_facing\": [0, 1.5]") == "t.json: /leaf_facing/1: is 1.5, expected 0 to 1");
    CHECK(changed(s, s + ", \"leaf_facing\": [-0.25, 0]") == "t.json: /leaf_facing/0: is -0.25, expected 0 to 1");
    CHECK(changed(s, s + ", \"leaf_facing\": [0]") ==
          "t.json: /leaf_facing: has 1 number, expected 2 (one for each body in /parent)");
    CHECK(changed(s, s + ", \"leaf_facing\": [0, 1e999]") != "");
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
    const auto at = [](const std::string& frame, const std::string& substeps) {
        return error_of([&] {
            read_state("{\"format\": \"bough-state\", \"version\": 1, \"frame\": " + frame +
                           ", \"fps\": 30, \"substeps\": " + substeps +
                           ", \"precision\": \"double\", \"fingerprint\": \"00c0ffee00c0ffee\", \"theta\": [1, 2, 3], "
                           "\"theta_dot\": [4, 5, 6], \"solver\": \"analytic\", \"scaled_rate\": [1, 2, 3]}",
                       "s");
        });
    };
    CHECK(at("9000000000000000", "1").empty());
    CHECK_THAT(at("9223372036854775807", "1"), Contains("s: /frame: is 9223372036854775807"));
    CHECK_THAT(at("9000000000000", "1000000"), Contains("expected at most 9e15 steps"));
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
            error_of([&] { read_scene_document(text, "f"); }), error_of([&] { read_motion(text, "f"); }),
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
