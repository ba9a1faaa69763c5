#include "formats/models/driven_model.h"
#include "formats/forked.h"
#include "formats/models/gltf_prune.h"
#include "lib/growth/segment.h"
#include "lib/model/append.h"
#include "lib/model/drawn_pose.h"
#include "lib/model/wood.h"
#include "tests/support/gltf_reader.h"
#include "tests/support/import_support.h"
#include <filesystem>
#include <set>
#include <unistd.h>

using namespace bough;
using namespace bough::test;
using OrderedJson = nlohmann::json;
using gltf_reader::Glb;

namespace {

const std::string fixtures = std::string(BOUGH_DATA_DIR) + "/fixtures/";

struct BonePose {
    std::vector<Mat3> R;
    std::vector<Vec3> x;
    MotionFrame frame() const {
        MotionFrame f;
        f.position = x;
        for (const Mat3& r : R) f.rotation.emplace_back(r);
        return f;
    }
};

BonePose drawn(const Tree& tree) {
    const DrawnPose pose = bough::drawn_pose(tree);
    return {pose.R_wb, pose.x_w};
}

Mat3 about_z(double angle) {
    return Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
}

Tree tree_of(const std::string& file, double segment_length, double unit = 0) {
    ImportOptions options;
    options.folder = std::filesystem::path(file).parent_path();
    if (unit > 0) options.unit = unit;
    SegmentOptions cut;
    cut.segment_length = segment_length;
    return segment(imported(content_of(file), file, options).splines, wood_presets().front(), cut);
}

// The written file, after these frames at 1 a second.
Glb driven(const std::string& file, const Tree& tree, const std::vector<BonePose>& poses,
           const DrivenOptions& asked = {}) {
    DrivenOptions options = asked;
    options.fps = 1;
    ImportNotes notes;
    std::vector<std::string> lines;
    DrivenModel model(read_user_model(file, notes), tree, options, lines);
    for (const BonePose& pose : poses) model.write(pose.frame());
    return gltf_reader::parse(model.finish("out.glb"));
}

// The bodies whose names begin at `first` on branch b turned about a place in the world.
void turn_branch(const Tree& tree, std::int32_t branch, const Mat3& R, const Vec3& about, BonePose& pose) {
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        if (branch >= 0 && tree.branch[i] != branch) continue;
        pose.R[i] = R * pose.R[i];
        pose.x[i] = about + R * (pose.x[i] - about);
    }
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, (a[k] - b[k]).norm());
    return most;
}

const std::string twig = fixtures + "twig_armature.gltf";
const Vec3 joint_of_side(0, 0.5, 0);

// The fixture's rings as its bones draw them: 8 vertices a bone, the side branch's from number 16.
std::vector<Vec3> ring_corners() {
    std::vector<Vec3> all;
    const auto ring = [&](const Vec3& at, double r, bool upright) {
        for (const auto& [u, v] : {std::pair(r, 0.0), {0.0, r}, {-r, 0.0}, {0.0, -r}})
            all.push_back(at + (upright ? Vec3(u, 0, v) : Vec3(0, u, v)));
    };
    for (const double y : {0.0, 1.0}) ring({0, y, 0}, 0.1, true);
    for (const double y : {1.0, 2.0}) ring({0, y, 0}, 0.08, true);
    for (const double x : {0.0, 0.4}) ring({x, 0.5, 0}, 0.04, false);
    for (const double x : {0.4, 0.7}) ring({x, 0.5, 0}, 0.03, false);
    return all;
}

} // namespace

TEST_CASE("a model at rest is as it was drawn, and a branch that turns takes its vertices along") {
    for (const double piece : {0.0, 0.07}) {
        const Tree tree = tree_of(twig, piece);
        const BonePose rest = drawn(tree);
        BonePose bent = rest, whole = rest;
        turn_branch(tree, 1, about_z(0.7), joint_of_side, bent);
        turn_branch(tree, -1, about_z(-0.4), Vec3::Zero(), whole);
        const Glb glb = driven(twig, tree, {rest, bent, whole});
        const std::vector<Vec3> corners = ring_corners();
        CHECK(farthest(gltf_reader::skinned(glb, -1), corners) < 1e-6);
        CHECK(farthest(gltf_reader::skinned(glb, 0), corners) < 1e-6);
        std::vector<Vec3> turned = corners, tilted = corners;
        for (std::size_t v = 16; v < 32; ++v) turned[v] = joint_of_side + about_z(0.7) * (corners[v] - joint_of_side);
        for (Vec3& v : tilted) v = about_z(-0.4) * v;
        CHECK(farthest(gltf_reader::skinned(glb, 1), turned) < 1e-6);
        CHECK(farthest(gltf_reader::skinned(glb, 2), tilted) < 1e-6);
    }
}

TEST_CASE("what is not the motion stays as it is in the file") {
    const Tree tree = tree_of(twig, 0);
    DrivenOptions options;
    options.source = "treesim twig.json";
    const Glb glb = driven(twig, tree, {drawn(tree), drawn(tree)}, options);
    const OrderedJson before = OrderedJson::parse(content_of(twig));
    for (const char* part : {"asset", "scenes", "nodes", "meshes", "materials", "skins", "extensionsUsed"})
        CHECK(glb.json[part] == before[part]);
    // The file's own animation moved the same bones: it goes, with its two arrays (the last) and their 40 bytes.
    for (std::size_t k = 0; k < 5; ++k) CHECK(glb.json["accessors"][k] == before["accessors"][k]);
    const std::string bytes = content_of(fixtures + "twig_bark.bin");
    CHECK(glb.binary.compare(0, bytes.size() - 40, bytes, 0, bytes.size() - 40) == 0);
    REQUIRE(glb.json["animations"].size() == 1);
    std::set<std::size_t> named;
    for (const OrderedJson& sampler : glb.json["animations"][0]["samplers"]) {
        named.insert(sampler["input"].get<std::size_t>());
        named.insert(sampler["output"].get<std::size_t>());
    }
    CHECK(glb.json["accessors"].size() == 5 + named.size());
    CHECK(glb.json["bufferViews"].size() == glb.json["accessors"].size());
    CHECK(glb.json["animations"][0]["name"] == "motion");
    CHECK(glb.json["animations"][0]["extras"]["source"] == "treesim twig.json");
}

TEST_CASE("arrays that only a left out animation named go, what anything else has of them stays") {
    GltfDocument document;
    for (char c = 0; c < 60; ++c) document.binary += c;
    document.json = nlohmann::ordered_json::parse(R"({
        "buffers": [{"byteLength": 60}, {"byteLength": 99}],
        "bufferViews": [{"buffer": 0, "byteLength": 10}, {"buffer": 0, "byteOffset": 8, "byteLength": 8},
                        {"buffer": 0, "byteOffset": 16, "byteLength": 8}, {"buffer": 0, "byteOffset": 24, "byteLength": 21},
                        {"buffer": 0, "byteOffset": 30, "byteLength": 4}, {"buffer": 0, "byteOffset": 44, "byteLength": 8},
                        {"buffer": 1, "byteOffset": 8, "byteLength": 8}, {"buffer": 0, "byteOffset": 52, "byteLength": 8}],
        "accessors": [{"bufferView": 0}, {"bufferView": 1}, {"bufferView": 2}, {"bufferView": 3}, {"bufferView": 4},
                      {"bufferView": 6}, {"sparse": {"indices": {"bufferView": 7}, "values": {"bufferView": 1}}}],
        "images": [{"bufferView": 5}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 4, "targets": [{"POSITION": 2}]}]}],
        "nodes": [{"extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"SCALE": 6}}}}],
        "animations": [{"samplers": [{"input": 2, "output": 5}]}]})");
    const auto before = document;
    CHECK(prune(document, {0, 2, 3, 3}).empty());
    CHECK(document.json["accessors"].size() == 5); // 0 and 3 are gone
    CHECK(document.json["meshes"][0]["primitives"][0] ==
          nlohmann::ordered_json::parse(
              R"({"attributes": {"POSITION": 0}, "indices": 2, "targets": [{"POSITION": 1}]})"));
    CHECK(document.json["animations"][0]["samplers"][0] ==
          nlohmann::ordered_json::parse(R"({"input": 1, "output": 3})"));
    CHECK(document.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] == 4);
    // Each view that is left has its bytes, at a place as well aligned as before.
    const std::size_t kept[] = {1, 2, 4, 5, 6, 7};
    REQUIRE(document.json["bufferViews"].size() == 6);
    for (std::size_t k = 0; k < 6; ++k) {
        const auto &now = document.json["bufferViews"][k], &then = before.json["bufferViews"][kept[k]];
        const std::size_t at = now["byteOffset"], was = then["byteOffset"];
        if (then["buffer"] == 1) {
            CHECK(now == then);
            continue;
        }
        CHECK(at % 4 == was % 4);
        CHECK(document.binary.substr(at, 8).substr(0, now["byteLength"]) ==
              before.binary.substr(was, 8).substr(0, then["byteLength"]));
    }
    CHECK(document.json["images"][0]["bufferView"] == 3);
    // Of view 0 its first 8 bytes, of view 3 those from 24 to 28 and from 36 to 44: no part of any other.
    CHECK(document.binary.size() == 60 - 8 - 4 - 8);
    // What may name arrays in a way that is not known leaves all as it was.
    GltfDocument strange = before;
    strange.json["nodes"].push_back({{"extensions", {{"ACME_points", {{"list", 0}}}}}});
    const auto json = strange.json;
    CHECK(prune(strange, {0}) == "ACME_points");
    CHECK(strange.json == json);
    CHECK(strange.binary == before.binary);
}

TEST_CASE("why assimp could not turn a model is said, and what to do") {
    CHECK(not_turned("no memory").find("could not turn it into glTF: no memory; export glTF") != std::string::npos);
    for (const char* nothing : {"", unnamed_failure})
        CHECK(not_turned(nothing).find("and does not say why; export glTF (.glb)") != std::string::npos);
}

TEST_CASE("a tree that lies is as large as its bones") {
    const std::string folder = std::filesystem::temp_directory_path() / ("bough_lying_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    OrderedJson json = OrderedJson::parse(content_of(twig));
    json["nodes"][0]["rotation"] = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)}; // all bones in the plane y = 0
    std::ofstream(folder + "/t.gltf") << json.dump();
    std::filesystem::copy_file(fixtures + "twig_bark.bin", folder + "/twig_bark.bin",
                               std::filesystem::copy_options::overwrite_existing);
    const Tree tree = tree_of(folder + "/t.gltf", 0);
    CHECK_NOTHROW(driven(folder + "/t.gltf", tree, {drawn(tree)}));
    std::filesystem::remove_all(folder);
}

TEST_CASE("animations of other nodes stay, those of the bones are named as left out; meshes that nothing moves, too") {
    const std::string folder = std::filesystem::temp_directory_path() / ("bough_driven_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    OrderedJson json = OrderedJson::parse(content_of(twig));
    json["animations"].push_back(json["animations"][0]);
    json["animations"][1]["name"] = "leaf fall";
    json["animations"][1]["channels"][0]["target"]["node"] = 6; // the control
    json["nodes"].push_back({{"name", "pot"}, {"mesh", 0}});
    json["scenes"][0]["nodes"].push_back(8);
    json["images"] = {{{"uri", "bark.png"}}, {{"uri", "gone.png"}}};
    std::ofstream(folder + "/t.gltf") << json.dump();
    std::ofstream(folder + "/bark.png") << "\x89PNG\r\n, nearly";
    std::filesystem::copy_file(fixtures + "twig_bark.bin", folder + "/twig_bark.bin",
                               std::filesystem::copy_options::overwrite_existing);
    const Tree tree = tree_of(twig, 0);
    ImportNotes read;
    std::vector<std::string> lines;
    DrivenModel model(read_user_model(folder + "/t.gltf", read), tree, {}, lines);
    model.write(drawn(tree).frame());
    const Glb glb = gltf_reader::parse(model.finish("out.glb"));
    REQUIRE(glb.json["animations"].size() == 2);
    CHECK(glb.json["animations"][1]["name"] == "leaf fall");
    const auto noted = [&](const std::string& text) {
        return std::any_of(lines.begin(), lines.end(),
                           [&](const std::string& line) { return line.find(text) != std::string::npos; });
    };
    CHECK(noted("left out for the new one: \"sway\""));
    CHECK(noted("1 mesh stays still"));
    REQUIRE(read.lines.size() == 1);
    CHECK(read.lines[0].find("\"gone.png\"") != std::string::npos);
    const OrderedJson& image = glb.json["images"][0];
    CHECK(image["mimeType"] == "image/png");
    const OrderedJson& view = glb.json["bufferViews"][std::size_t(image["bufferView"])];
    CHECK(glb.binary.substr(view["byteOffset"], view["byteLength"]) == "\x89PNG\r\n, nearly");
    CHECK(glb.json["images"][1]["uri"] == "gone.png");
    std::filesystem::remove_all(folder);
}

TEST_CASE("a bone along several bodies turns as the middle one and begins where the first has been taken") {
    const Tree tree = tree_of(twig, 0.1);
    const BonePose rest = drawn(tree);
    BonePose bent = rest;
    // An arc: each body of the trunk turns 0.02 rad further than the one before it; the side branch stands still.
    std::vector<std::size_t> trunk;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.branch[i] == 0) trunk.push_back(i);
    REQUIRE(trunk.size() >= 20);
    for (std::size_t k = 0; k < trunk.size(); ++k) {
        const std::size_t i = trunk[k];
        bent.R[i] = about_z(-0.02 * double(k + 1)) * rest.R[i];
        if (k > 0) {
            const std::size_t p = trunk[k - 1];
            bent.x[i] = bent.x[p] + bent.R[p] * rest.R[p].transpose() * (rest.x[i] - rest.x[p]);
        }
    }
    const Glb glb = driven(twig, tree, {rest, bent});
    const std::vector<Eigen::Matrix4d> world = gltf_reader::node_matrices(glb, 1);
    const auto body_at = [&](double y) { // that holds this height, drawn
        std::size_t at = 0;
        for (std::size_t k = 0; k < trunk.size(); ++k)
            if (rest.x[trunk[k]].y() <= y + 1e-9) at = k;
        return at;
    };
    // The second trunk bone, node 2, runs from y = 1 to 2.
    const std::size_t middle = body_at(1.5), first = body_at(1.0);
    const double angle = -std::atan2(world[2](1, 0), world[2](0, 0));
    CHECK(std::min(std::abs(angle - 0.02 * double(middle + 1)), std::abs(angle - 0.02 * double(middle))) < 1e-6);
    const std::size_t f = trunk[first];
    const Vec3 begins = bent.x[f] + bent.R[f] * rest.R[f].transpose() * (Vec3(0, 1, 0) - rest.x[f]);
    CHECK((Vec3(world[2].topRightCorner<3, 1>()) - begins).norm() < 1e-6);
}

TEST_CASE("scaled nodes, a matrix, and a tree that a scene has moved") {
    const std::string file =
        std::filesystem::temp_directory_path() / ("bough_scaled_" + std::to_string(::getpid()) + ".gltf");
    OrderedJson json = OrderedJson::parse(content_of(twig));
    json["buffers"][0]["uri"] = "file"; // put in below
    json["nodes"][0]["scale"] = {0.01, 0.01, 0.01};
    json["nodes"][0]["rotation"] = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
    // The bone under it undoes both, as Blender's FBX does.
    json["nodes"][1] = {
        {"name", "trunk"}, {"children", {2, 4}}, {"matrix", {100, 0, 0, 0, 0, 0, 100, 0, 0, -100, 0, 0, 0, 0, 0, 1}}};
    json["buffers"][0]["uri"] = "twig_bark.bin";
    std::ofstream(file) << json.dump();
    const std::string beside = std::filesystem::path(file).parent_path().string() + "/twig_bark.bin";
    std::filesystem::copy_file(fixtures + "twig_bark.bin", beside, std::filesystem::copy_options::overwrite_existing);
    const Tree tree = tree_of(file, 0);
    const Vec3 position(5, 1, -2);
    const double yaw = 0.9;
    Tree moved;
    append(moved, tree, position, yaw);
    const BonePose rest = drawn(moved);
    BonePose bent = rest;
    const Mat3 to_world = Eigen::AngleAxisd(yaw, Vec3::UnitY()).toRotationMatrix();
    turn_branch(moved, 1, to_world * about_z(0.5) * to_world.transpose(), position + to_world * joint_of_side, bent);
    DrivenOptions options;
    options.place.position = position;
    options.place.yaw = yaw;
    const Glb glb = driven(file, moved, {rest, bent}, options);
    CHECK_FALSE(glb.json["nodes"][1].contains("matrix"));
    const std::vector<Vec3> corners = ring_corners();
    std::vector<Vec3> turned = corners;
    for (std::size_t v = 16; v < 32; ++v) turned[v] = joint_of_side + about_z(0.5) * (corners[v] - joint_of_side);
    CHECK(farthest(gltf_reader::skinned(glb, 0), corners) < 1e-5);
    CHECK(farthest(gltf_reader::skinned(glb, 1), turned) < 1e-5);
    std::filesystem::remove(file);
    std::filesystem::remove(beside);
}

TEST_CASE("a model that is not the tree's is refused") {
    ImportNotes notes;
    std::vector<std::string> lines;
    const Tree large = tree_of(twig, 0, 3); // as three metres a unit
    CHECK_THROWS_WITH(DrivenModel(read_user_model(twig, notes), large, {}, lines),
                      Catch::Matchers::Contains("its bones are 2 m large, the tree is 6 m"));
    Tree beside;
    append(beside, tree_of(twig, 0), Vec3(3, 0, 0), 0);
    CHECK_THROWS_WITH(DrivenModel(read_user_model(twig, notes), beside, {}, lines),
                      Catch::Matchers::Contains("4 of its 4 bones lie beside the tree"));
    CHECK_THROWS_WITH(read_user_model(fixtures + "lines.gltf", notes), Catch::Matchers::Contains("has no armature"));
    if (const char* folder = std::getenv("BOUGH_CASES_DIR")) // bones that move a mesh of lines
        CHECK_THROWS_WITH(read_user_model(std::string(folder) + "/sapling/sapling_quaking_aspen_s0_skin.dae", notes),
                          Catch::Matchers::Contains("no mesh of faces"));
    CHECK_THROWS_WITH(read_user_model(fixtures + "shuffled.swc", notes), Catch::Matchers::Contains("is no model"));
}

TEST_CASE("the users' own trees at rest, from glTF and FBX") {
    const char* folder = std::getenv("BOUGH_CASES_DIR");
    if (folder == nullptr) {
        WARN("BOUGH_CASES_DIR is not set: not tested");
        return;
    }
    const std::string sapling = std::string(folder) + "/sapling/sapling_quaking_aspen_s0_skin.";
    const Glb original = gltf_reader::parse(content_of(sapling + "glb"));
    const std::vector<Vec3> vertices = gltf_reader::skinned(original, -1);
    for (const char* kind : {"glb", "fbx"}) {
        INFO(kind);
        const Tree tree = tree_of(sapling + kind, 0);
        const BonePose rest = drawn(tree);
        BonePose tilted = rest;
        turn_branch(tree, -1, about_z(0.3), Vec3::Zero(), tilted);
        const Glb glb = driven(sapling + kind, tree, {rest, tilted});
        const std::vector<Vec3> at_rest = gltf_reader::skinned(glb, 0), after = gltf_reader::skinned(glb, 1);
        // assimp splits FBX vertices by normal, so the bounds are compared; in glTF each vertex is.
        if (std::string(kind) == "glb") CHECK(farthest(at_rest, vertices) < 1e-5);
        Vec3 low = at_rest[0], high = low, want_low = vertices[0], want_high = want_low;
        for (const Vec3& v : at_rest) low = low.cwiseMin(v), high = high.cwiseMax(v);
        for (const Vec3& v : vertices) want_low = want_low.cwiseMin(v), want_high = want_high.cwiseMax(v);
        CHECK((low - want_low).norm() < 1e-4);
        CHECK((high - want_high).norm() < 1e-4);
        std::size_t still = 0; // the few that no bone moves in the file
        for (std::size_t v = 0; v < at_rest.size(); ++v) still += (about_z(0.3) * at_rest[v] - after[v]).norm() > 1e-4;
        CHECK(still < at_rest.size() / 100);
    }
}
