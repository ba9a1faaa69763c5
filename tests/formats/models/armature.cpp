#include "formats/models/user_model.h"
#include "tests/support/import_support.h"
#include <functional>
#include <nlohmann/json.hpp>

using namespace bough;
using namespace bough::test;
using Json = nlohmann::ordered_json;

namespace {

ImportOptions beside_fixtures() {
    ImportOptions options;
    options.folder = std::string(BOUGH_DATA_DIR) + "/fixtures";
    return options;
}

// The text of the one-line error that a file of the fixtures' folder gives.
std::string error_beside(const std::string& content, const std::string& name) {
    try {
        imported(content, name, beside_fixtures());
    } catch (const InputError& error) {
        const std::string text = error.what();
        CHECK(text.find('\n') == std::string::npos);
        CHECK(text.rfind(name + ":", 0) == 0); // a line may follow
        return text;
    }
    return {};
}

std::string changed(const std::string& text, const std::function<void(Json&)>& change) {
    Json json = Json::parse(text);
    change(json);
    return json.dump();
}

} // namespace

TEST_CASE("an armature with its mesh: a mark, a bone that begins midway, a control, an end from the mesh") {
    const Imported in = imported(fixture("twig_armature.gltf"), "twig.gltf", beside_fixtures());
    const Splines& s = in.splines;
    REQUIRE(s.branches() == 2);
    CHECK(s.parent == std::vector<std::int32_t>{-1, 0});
    CHECK(s.parent_at[1] == Approx(0.25)); // 0.5 of 2 m
    CHECK(s.first_point == std::vector<std::int32_t>{0, 3, 6});
    const std::vector<Vec3> point{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 0.5, 0}, {0.4, 0.5, 0}, {0.7, 0.5, 0}};
    for (std::size_t k = 0; k < point.size(); ++k) CHECK(near(s.point[k], point[k], 1e-6));
    // Each bone has a tube of its own, whose four corners stand this far off: a square of wood that is half its side thick.
    const std::vector<double> corner{0.1, 0.08, 0.08, 0.04, 0.03, 0.03};
    for (std::size_t k = 0; k < corner.size(); ++k)
        CHECK(s.radius[k] == Approx(std::sqrt(0.5) * corner[k]).epsilon(1e-6));
    CHECK(in.notes_hold("1 bone that moves no vertex"));
    CHECK(in.notes_hold("1 bone without an end: it reaches as far as its bark"));
    CHECK(in.notes_hold("radii of 4 of 4 bones measured"));
    CHECK(in.notes.lines.size() == 3); // unit and up axis are the format's
}

TEST_CASE("joints alone: COLLADA's unit, axis and tips; a node beside them is none") {
    const Imported in = imported(fixture("twig_joints.dae"), "twig.dae");
    const Splines& s = in.splines;
    REQUIRE(s.branches() == 1);
    REQUIRE(s.points() == 3);
    CHECK(near(s.point[0], {0.5, 0, 0}, 1e-6));
    CHECK(near(s.point[1], {0.5, 2, 0}, 1e-6));
    CHECK(near(s.point[2], {0.8, 3, 0}, 1e-6));
    ImportOptions inches;
    inches.unit = 0.0254; // in place of the file's centimetres
    CHECK(imported(fixture("twig_joints.dae"), "twig.dae", inches).splines.point[1].y() == Approx(200 * 0.0254));
    CHECK(in.notes_hold("by the pipe rule"));
}

TEST_CASE("where the file says nothing of joints, a topmost node whose bones begin beside it is no bone") {
    const std::string bare = changed(fixture("twig_armature.gltf"), [](Json& json) {
        for (const char* gone : {"skins", "meshes", "animations", "materials", "accessors", "bufferViews", "buffers"})
            json.erase(gone);
        json["nodes"][7].erase("mesh"), json["nodes"][7].erase("skin");
        json["nodes"][1]["translation"] = {3, 0, 1};
    });
    const Imported in = imported(bare, "bare.gltf");
    CHECK(in.notes_hold("1 node taken as the armature's frame"));
    CHECK(near(in.splines.point[0], {3, 0, 1}, 1e-6));
    CHECK(in.splines.branches() == 2);
    // Without the mark the last bone of the trunk is as long as the one before it.
    const Splines s = imported(changed(bare, [](Json& json) { json["nodes"][2].erase("children"); }), "m.gltf").splines;
    CHECK(near(s.point[2], {3, 2, 1}, 1e-6));
}

TEST_CASE("scales, nodes between bones, another bone axis and several roots") {
    // Halved by the armature, doubled again by its child; the side branch hangs on a node that is no bone.
    const std::string scaled = changed(fixture("twig_armature.gltf"), [](Json& json) {
        json["nodes"][0]["scale"] = {0.5, 0.5, 0.5};
        json["nodes"][1]["scale"] = {2, 2, 2};
    });
    const Splines s = imported(scaled, "s.gltf", beside_fixtures()).splines;
    CHECK(near(s.point[2], {0, 2, 0}, 1e-6));
    CHECK(near(s.point[3], {0, 0.5, 0}, 1e-6));
    const std::string between = changed(fixture("twig_armature.gltf"), [](Json& json) {
        json["nodes"][1]["children"] = {2, 8};
        json["nodes"].push_back(Json{{"name", "holder"}, {"translation", {0, 0.25, 0}}, {"children", {4}}});
        json["nodes"][4]["translation"] = {0, 0.25, 0};
    });
    const Splines b = imported(between, "b.gltf", beside_fixtures()).splines;
    REQUIRE(b.branches() >= 2);
    CHECK(near(b.point[std::size_t(b.first_point[1])], {0, 0.5, 0}, 1e-6));
    const std::string roots = changed(fixture("twig_armature.gltf"), [](Json& json) {
        json["nodes"][0]["children"] = {1, 4, 6};
        json["nodes"][1]["children"] = {2};
    });
    CHECK(imported(roots, "r.gltf", beside_fixtures()).splines.parent == std::vector<std::int32_t>{-1, -1});
}

TEST_CASE("of two armatures with bones of the same names each skin has its own") {
    const Imported in = imported(fixture("two_armatures.dae"), "two.dae");
    const Splines& s = in.splines;
    REQUIRE(s.parent == std::vector<std::int32_t>{-1, -1});
    std::vector<double> x{s.point[0].x(), s.point[std::size_t(s.first_point[1])].x()};
    std::sort(x.begin(), x.end());
    CHECK(near({x[0], x[1], 0}, {0, 3, 0}, 1e-6));
    CHECK(total_length(s) == Approx(4 + 2));
    for (const double r : s.radius) CHECK(r == Approx(0.1 * std::sqrt(0.5)));
    // assimp cannot tell them apart when it writes glTF.
    CHECK_THROWS_AS(glb_by_assimp(fixture("two_armatures.dae"), AssimpKind::dae, {}), InputError);
}

TEST_CASE("a second armature that moves no vertex is told from controls") {
    const auto with = [](int bones) {
        return changed(fixture("twig_armature.gltf"), [bones](Json& json) {
            const int first = int(json["nodes"].size());
            for (int k = 0; k < bones; ++k) {
                json["nodes"].push_back(Json{{"name", "bare " + std::to_string(k)}, {"translation", {0, 1, 0}}});
                if (k > 0) json["nodes"][std::size_t(first + k - 1)]["children"] = {first + k};
            }
            json["skins"].push_back(Json{{"joints", Json::array()}}); // its matrices are identities
            for (int k = 0; k < bones; ++k) json["skins"][1]["joints"].push_back(first + k);
            json["scenes"][0]["nodes"].push_back(first);
        });
    };
    const Imported three = imported(with(3), "t.gltf", beside_fixtures()),
                   two = imported(with(2), "t.gltf", beside_fixtures());
    CHECK(three.notes_hold("3 bones of 1 armature that move no vertex left out (\"bare 0\")"));
    CHECK(three.notes_hold("1 bone that moves no vertex"));
    CHECK(two.notes_hold("3 bones that move no vertex, nor anything below them, left out (controls)"));
    CHECK(three.splines.branches() == 2);
    CHECK(two.splines.branches() == 2);
}

TEST_CASE("without a mesh, bones that are named as controls are no branches, unless all are") {
    const std::string bare = changed(fixture("twig_armature.gltf"), [](Json& json) {
        for (const char* gone : {"skins", "meshes", "animations", "materials", "accessors", "bufferViews", "buffers"})
            json.erase(gone);
        json["nodes"][7].erase("mesh"), json["nodes"][7].erase("skin");
    });
    const auto add = [&](const std::string& name) {
        return changed(bare, [&](Json& json) {
            const int first = int(json["nodes"].size());
            json["nodes"].push_back(Json{{"name", name}, {"translation", {0.5, 0, 0}}, {"children", {first + 1}}});
            json["nodes"].push_back(Json{{"name", name + ".001"}, {"translation", {0, 0.5, 0}}});
            json["nodes"][1]["children"].push_back(first);
        });
    };
    const std::size_t without = imported(bare, "b.gltf").splines.branches();
    for (const char* name : {"IK_tip", "CTRL-top", "PoleTarget", "branch.ik.L", "mch", "Control_3"}) {
        INFO(name);
        const Imported in = imported(add(name), "b.gltf");
        CHECK(in.splines.branches() == without);
        CHECK(in.notes_hold("3 bones left out as controls by their names (")); // and the one that is called so
    }
    for (const char* name : {"stick", "twig", "Mikado", "controls_not", "polestar"}) {
        INFO(name);
        const Imported in = imported(add(name), "b.gltf");
        CHECK(in.splines.branches() == without + 1);
        CHECK_FALSE(in.notes_hold("by their names"));
    }
    const std::string all = changed(bare, [](Json& json) {
        for (Json& node : json["nodes"]) node["name"] = "ctrl_" + node["name"].get<std::string>();
    });
    CHECK(imported(all, "b.gltf").splines.branches() == without);
}

TEST_CASE("lines of glTF: radii of a custom attribute, vertices that are not there") {
    const std::string good = fixture("lines.gltf");
    const auto with = [&](
                          const char* name, const std::function<void(Json&)>& also = [](Json&) {}) {
        return changed(good, [&](Json& json) {
            // 1/2, 1/4, 1/8, 1/16, 1/32, 1/8, 1/2 as floats.
            json["buffers"].push_back(
                Json{{"byteLength", 28}, {"uri", "data:;base64,AAAAPwAAgD4AAAA+AACAPQAAAD0AAAA+AAAAPw=="}});
            json["bufferViews"].push_back(Json{{"buffer", 1}, {"byteLength", 28}});
            json["accessors"].push_back(
                Json{{"bufferView", 3}, {"componentType", 5126}, {"count", 7}, {"type", "SCALAR"}});
            for (Json& primitive : json["meshes"][0]["primitives"]) primitive["attributes"][name] = 3;
            also(json);
        });
    };
    // The strip is 2 1 0; pairs are 4 3 and 5 6, of which 3 and 5 stand at 1 and 2: the thicker counts. The node doubles.
    const Splines s = imported(with("_RADIUS"), "l.gltf").splines;
    REQUIRE(s.first_point == std::vector<std::int32_t>{0, 4, 6});
    const std::vector<double> radius{1, 0.5, 0.25, 1, 0.0625, 0.0625};
    for (std::size_t k = 0; k < radius.size(); ++k) CHECK(s.radius[k] == Approx(radius[k]));
    const Splines half = imported(with("_diameter"), "l.gltf").splines;
    for (std::size_t k = 0; k < radius.size(); ++k) CHECK(half.radius[k] == Approx(0.5 * radius[k]));
    CHECK(imported(with("_AGE"), "l.gltf").notes_hold("by the pipe rule"));
    // Bytes that stand for 0 to 1: 63 of 255.
    const Splines bytes = imported(with("_RADIUS",
                                        [](Json& json) {
                                            json["accessors"][3]["componentType"] = 5121;
                                            json["accessors"][3]["normalized"] = true;
                                            json["bufferViews"][3]["byteStride"] = 4;
                                            json["bufferViews"][3]["byteOffset"] =
                                                3; // the last byte of the first: 0x3f
                                            json["bufferViews"][3]["byteLength"] = 25;
                                        }),
                                   "l.gltf")
                              .splines;
    CHECK(bytes.radius[0] == Approx(2 * 63 / 255.0));
    // Nothing but two numbers that are put in their places.
    const Splines sparse = imported(with("_RADIUS",
                                         [](Json& json) {
                                             json["accessors"][3].erase("bufferView");
                                             json["accessors"][3]["sparse"] = Json::parse(
                                                 R"({"count": 2, "indices": {"bufferView": 1, "componentType": 5123},
                                                     "values": {"bufferView": 3}})");
                                         }),
                                    "l.gltf")
                               .splines;
    CHECK(sparse.radius[2] == Approx(1)); // the strip is 2 1 0: number 2 becomes 1/2, number 1 becomes 1/4
    CHECK(sparse.radius[1] == Approx(0.5));
    const auto says = [&](const std::string& file, const std::string& text) {
        const std::string error = error_of(file, "l.gltf");
        INFO(error);
        CHECK(error.find(text) != std::string::npos);
    };
    says(with("_RADIUS", [](Json& json) { json["accessors"][3]["count"] = 6; }),
         "mesh 0, primitive 0: _RADIUS has 6 numbers, expected one for each of 7 vertices");
    says(with("_RADIUS", [](Json& json) { json["accessors"][3]["count"] = 8; }),
         "_RADIUS (accessor 3) ends beyond its view: 8 elements");
    says(with("_RADIUS", [](Json& json) { json["accessors"][3]["type"] = "VEC2"; }),
         "is \"VEC2\" of floats, expected SCALAR");
    says(with("_RADIUS", [](Json& json) { json["accessors"][3]["componentType"] = 1; }), "componentType is 1");
    says(changed(good, [](Json& json) { json["accessors"][0]["count"] = 6; }),
         "mesh 0, primitive 1: a line names vertex 6, expected 0 to 5");
}

TEST_CASE("scenes: the default one is read, others are told of, without any all nodes are") {
    const std::string good = fixture("twig_armature.gltf");
    const auto with_other = [&](int shown) {
        return changed(good, [shown](Json& json) {
            json["scenes"].push_back(Json{{"nodes", {int(json["nodes"].size())}}});
            json["nodes"].push_back(Json{{"name", "pot"}, {"mesh", 0}});
            json["scene"] = shown;
        });
    };
    const Imported first = imported(with_other(0), "s.gltf", beside_fixtures());
    CHECK(first.splines.branches() == 2);
    CHECK(first.notes_hold("1 scene beside the default one not read"));
    CHECK(error_beside(with_other(1), "s.gltf").find("(its default scene; 1 other is not read)") != std::string::npos);
    const std::string none = changed(good, [](Json& json) { json.erase("scenes"), json.erase("scene"); });
    CHECK(imported(none, "s.gltf", beside_fixtures()).splines.point ==
          imported(good, "s.gltf", beside_fixtures()).splines.point);
}

TEST_CASE("nodes in a row that no skin names are told of") {
    const std::string beside = changed(fixture("twig_armature.gltf"), [](Json& json) {
        const int first = int(json["nodes"].size());
        json["nodes"].push_back(Json{{"name", "a"}, {"children", {first + 1}}});
        json["nodes"].push_back(Json{{"name", "b"}, {"translation", {0, 1, 0}}});
        json["scenes"][0]["nodes"].push_back(first);
    });
    CHECK(imported(beside, "b.gltf", beside_fixtures()).notes_hold("2 nodes in a row that no skin names"));
    const Imported alone = imported(fixture("twig_armature.gltf"), "t.gltf", beside_fixtures());
    CHECK(!alone.notes_hold("that no skin names"));
}

TEST_CASE("an error found in the child names file and line once") {
    const std::string text = error_beside("{\"asset\": {},\n\"nodes\": [,]}", "broken.gltf");
    CHECK(text.rfind("broken.gltf:2: ", 0) == 0);
    CHECK(text.find("assimp") == std::string::npos);
}

TEST_CASE("line meshes are welded into a tree, strips and pairs, scaled by their node") {
    const Imported in = imported(fixture("lines.gltf"), "lines.gltf");
    const Splines& s = in.splines;
    REQUIRE(s.branches() == 2);
    CHECK(near(s.point[0], {0, 0, 0}, 1e-6));
    CHECK(top_of(s) == Approx(6));
    CHECK(total_length(s) == Approx(2 * (3 + std::sqrt(0.5))));
    CHECK(s.parent_at[1] == Approx(1.0 / 3));
}

TEST_CASE("damaged glTF is refused in one line") {
    const std::string good = fixture("twig_armature.gltf");
    const auto says = [&](const std::function<void(Json&)>& change, const std::string& text) {
        const std::string error = error_beside(changed(good, change), "d.gltf");
        INFO(error);
        CHECK(error.find(text) != std::string::npos);
    };
    says([](Json& j) { j["buffers"][0]["uri"] = "gone.bin"; }, "\"gone.bin\" is not beside the file");
    says([](Json& j) { j["buffers"][0]["uri"] = "https://example.org/a.bin"; }, "expected a relative path");
    says([](Json& j) { j["buffers"][0]["uri"] = "/etc/passwd"; }, "expected a relative path");
    says([](Json& j) { j["buffers"][0]["uri"] = "data:;base64,A*"; }, "expected base64");
    says([](Json& j) { j["buffers"][0]["byteLength"] = 99999; }, "has 1576 bytes, expected 99999");
    says([](Json& j) { j["bufferViews"][0]["byteLength"] = 9999; }, "of a buffer of 1576");
    says([](Json& j) { j["bufferViews"][0]["buffer"] = 3; }, "buffer is 3, expected less than 1");
    says([](Json& j) { j["asset"]["version"] = "1.0", j["scene"] = "first", j["meshes"] = Json::object(); },
         "asset version is \"1.0\"");
    says([](Json& j) { j["skins"][0]["joints"][0] = 77; }, "d.gltf: ");
    // Of another kind than glTF has it: the place, what it is and what was expected.
    says([](Json& j) { j["nodes"] = 7; }, "is no glTF 2.0: /nodes: is a number, expected a list of objects");
    says([](Json& j) { j["nodes"][1] = nullptr; }, "/nodes/1: is null, expected an object");
    says([](Json& j) { j["skins"][0]["joints"] = "all"; }, "/skins/0/joints: is a text, expected a list of numbers");
    says([](Json& j) { j["skins"][0]["joints"][1] = "a"; }, "/skins/0/joints/1: is a text, expected a number");
    says(
        [](Json& j) {
            j["meshes"][0]["primitives"] = Json::object({{"a", 1}});
        },
        "/meshes/0/primitives: is an object, expected a list of objects");
    says([](Json& j) { j["meshes"][0]["primitives"][0]["attributes"] = true; },
         "/meshes/0/primitives/0/attributes: is true or false, expected an object");
    says([](Json& j) { j["accessors"][0].erase("count"); }, "/accessors/0/count: is missing, expected a number");
    says([](Json& j) { j["buffers"][0].erase("byteLength"); }, "/buffers/0/byteLength: is missing");
    says([](Json& j) { j["animations"][0]["channels"][0]["target"] = 3; },
         "/animations/0/channels/0/target: is a number, expected an object");
    says([](Json& j) { j["extensionsRequired"] = Json::array({1}); },
         "/extensionsRequired/0: is a number, expected a text");
    CHECK(error_beside(good.substr(0, good.size() / 2), "d.gltf").find("JSON is broken") != std::string::npos);
    const std::string deep(100000, '[');
    CHECK(error_beside("{\"asset\":{\"version\":\"2.0\"},\"extras\":" + deep, "d.gltf").find("nested deeper") !=
          std::string::npos);
    const auto with_large = [&](const char* number) {
        return error_beside(replaced(good, "\"asset\": {", std::string("\"asset\": {\"x\": ") + number + ", "),
                            "d.gltf");
    };
    CHECK(with_large("1e308").empty());
    CHECK(with_large("1e309") == "d.gltf: JSON holds a number too large for double precision, expected glTF 2.0");
    CHECK(error_beside(good, "d.gltf").empty());
    ImportOptions pipe; // without a folder
    ImportNotes none;
    pipe.name = "<stdin>";
    CHECK_THROWS_WITH(import_splines(good, pipe, none), Catch::Matchers::Contains("read from a pipe"));
    const std::string bom = "\xEF\xBB\xBF \r\n" + good;
    CHECK(error_beside(bom, "d.gltf").empty());
    std::string glb = "glTF";
    CHECK(error_beside(glb, "d.glb").find("cut off") != std::string::npos);
    glb += std::string("\1\0\0\0\40\0\0\0", 8) + std::string(40, ' ');
    CHECK(error_beside(glb, "d.glb").find("glTF 1.0") != std::string::npos);
}

TEST_CASE("what holds no skeleton is refused with advice") {
    const auto refused = [](const std::string& content, const std::string& name) {
        CHECK(error_beside(content, name).find("armature") != std::string::npos);
    };
    refused(changed(fixture("twig_armature.gltf"),
                    [](Json& json) {
                        json.erase("skins");
                        json["nodes"][7].erase("skin");
                    }),
            "mesh.gltf");
    CHECK_FALSE(error_beside("{\"asset\": {\"version\": \"2.0\"}}", "empty.gltf").empty());
    CHECK_FALSE(error_beside("; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n}\n", "empty.fbx").empty());
    for (const char* name : {"eztree/eztree_ash_small.glb", "models/global_settings.fbx", "models/cube_UTF8BOM.dae",
                             "invalid/cubes_with_outofrange_float.fbx"})
        if (const auto content = foreign_case(name)) refused(*content, name);
    for (const char* name : {"invalid/wrongTypes/badArray.gltf", "invalid/wrongTypes/badString.gltf"})
        if (const auto content = foreign_case(name)) CHECK_FALSE(error_beside(*content, "x.gltf").empty());
}

TEST_CASE("a chain of many bones, deeper than a stack of the usual size") {
    constexpr int n = 30000;
    Json json{{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};
    for (int i = 0; i < n; ++i) {
        json["nodes"].push_back(Json{{"translation", {0, 0.001, 0}}});
        if (i + 1 < n) json["nodes"][std::size_t(i)]["children"] = {i + 1};
    }
    const Splines s = imported(json.dump(), "chain.gltf").splines;
    CHECK(segments(s) == n);
    CHECK(top_of(s) == Approx(0.001 * (n + 1)).epsilon(1e-4)); // the last bone is as long as the one before it
}

TEST_CASE("any damage to a binary FBX is read or refused in one line") {
    const auto content = foreign_case("sapling/sapling_quaking_aspen_s0_armleaf.armonly.fbx");
    if (!content) return;
    std::mt19937 random(11);
    int refused = 0;
    for (int round = 0; round < 40; ++round) {
        std::string broken = *content;
        for (int flips = 0; flips < 20; ++flips) broken[random() % broken.size()] = char(random() % 256);
        if (round % 4 == 0) broken.resize(random() % broken.size());
        refused += !error_beside(broken, "b.fbx").empty();
    }
    CHECK(refused > 0);
}
