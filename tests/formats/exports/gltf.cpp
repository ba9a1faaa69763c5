#include "formats/exports/gltf.h"
#include "tests/support/sanitized.h"
#include "tests/support/written_glb.h"
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <set>

using namespace bough;
using namespace skin_checks;
using namespace written_glb;
using gltf_reader::Json;
using make_tree::branched;
using make_tree::forest;
using make_tree::random_tree;

namespace {

constexpr double degree = std::numbers::pi / 180;

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
    return most;
}

std::vector<Vec3> deformed(const Written& w, const SkinPose& pose) {
    std::vector<Vec3> position, normal;
    SkinDeformer(w.skin, w.tree).deform(pose.R_wb, pose.x_w, position, normal);
    return position;
}

// The pose in which each body stands as its group takes it.
SkinPose as_groups(const Written& w, const SkinPose& is) {
    const SkinPose drawn = posed(w.tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
    std::vector<Mat3> turn(w.groups.size());
    std::vector<Vec3> place(w.groups.size()); // of the group's joint
    for (std::size_t g = 0; g < w.groups.size(); ++g) {
        const std::size_t lead = std::size_t(w.groups.lead[g]), first = std::size_t(w.groups.first[g]);
        turn[g] = is.R_wb[lead] * drawn.R_wb[lead].transpose();
        place[g] = drawn.x_w[first];
        if (w.groups.parent[g] < 0) continue;
        const std::size_t p = std::size_t(w.groups.parent[g]);
        place[g] = place[p] + turn[p] * (drawn.x_w[first] - drawn.x_w[std::size_t(w.groups.first[p])]);
    }
    SkinPose pose;
    for (std::size_t i = 0; i < w.tree.size_bodies(); ++i) {
        const std::size_t g = std::size_t(w.groups.group[i]);
        pose.R_wb.push_back(turn[g] * drawn.R_wb[i]);
        pose.x_w.push_back(place[g] + turn[g] * (drawn.x_w[i] - drawn.x_w[std::size_t(w.groups.first[g])]));
    }
    return pose;
}

} // namespace

TEST_CASE("the file's skinning is the deformer's, at every frame and at rest") {
    for (const Tree& tree : {branched(), random_tree(500, 3), forest({branched(), random_tree(200, 4)})}) {
        const Written w = written(tree, 9);
        CHECK(farthest(gltf_reader::skinned(w.glb, -1), w.skin.position) < 1e-6 * w.height());
        for (const std::size_t f : {0u, 1u, 5u, 8u})
            CHECK(farthest(gltf_reader::skinned(w.glb, double(f) / fps), deformed(w, swinging(tree, f))) <
                  1e-5 * w.height());
    }
}

TEST_CASE("merged joints move their bodies rigidly with the leading one") {
    const Tree tree = random_tree(500, 5);
    for (const std::size_t joints : {1u, 30u, 200u}) {
        const Written w = written(tree, 5, joints);
        CHECK(w.glb.json["skins"][0]["joints"].size() == w.groups.size());
        for (const std::size_t f : {0u, 4u})
            CHECK(farthest(gltf_reader::skinned(w.glb, double(f) / fps), deformed(w, as_groups(w, swinging(tree, f)))) <
                  1e-5 * w.height());
    }
}

TEST_CASE("with keys left out no vertex is off by more than the angle over its way from the ground") {
    const Tree tree = random_tree(300, 6);
    std::vector<double> way(tree.size_bodies());
    double longest = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        if (tree.parent[i] >= 0) way[i] = way[std::size_t(tree.parent[i])] + tree.joint_position[i].norm();
        longest = std::max(longest, way[i] + tree.size[i].norm());
    }
    const std::size_t frames = sanitized ? 10 : 40;
    std::size_t before = tree.size_bodies() * frames;
    for (const double tolerance : {0.1, 1.0}) {
        const Written w = written(tree, frames, 100000, tolerance * degree);
        CHECK(w.keys < before);
        before = w.keys;
        double most = 0;
        for (std::size_t f = 0; f < frames; ++f)
            most =
                std::max(most, farthest(gltf_reader::skinned(w.glb, double(f) / fps), deformed(w, swinging(tree, f))));
        CHECK(most <= 2 * std::sin(tolerance * degree / 2) * longest + 1e-5 * w.height());
        CHECK(most > 0.1 * tolerance * degree * w.height()); // keys were left out
    }
}

TEST_CASE("the scene: a skinned mesh at the root beside the joints") {
    const Written w = written(branched(), 4);
    const Json& json = w.glb.json;
    CHECK(json["asset"]["version"] == "2.0");
    CHECK(json["asset"]["generator"] == "bough 1.2.3");
    CHECK(json["asset"]["extras"]["source"] == "treegen \"a\"\ntreesim -");
    CHECK(json["scenes"][0]["nodes"] == Json({0, 1}));
    CHECK(json["nodes"][0]["skin"] == 0);
    CHECK(!json["nodes"][0].contains("children"));
    CHECK(json["nodes"].size() == 2 + w.tree.size_bodies());
    CHECK(json["skins"][0]["skeleton"] == 1);
    std::set<std::string> names;
    for (const Json& node : json["nodes"]) names.insert(node["name"]);
    CHECK(names.size() == json["nodes"].size());
    CHECK(names.count("body_13") == 1);
    for (std::size_t i = 0; i < w.tree.size_bodies(); ++i) {
        const std::int32_t p = w.tree.parent[i];
        const Json& children = json["nodes"][p < 0 ? 1 : std::size_t(p) + 2]["children"];
        CHECK(std::count(children.begin(), children.end(), i + 2) == 1);
    }
}

TEST_CASE("attributes: limits, weights, joints, indices, targets") {
    for (const std::size_t joints : {std::size_t(3), std::size_t(100000)}) {
        const Written w = written(random_tree(600, 7), 3, joints);
        const Json& json = w.glb.json;
        const Json& primitives = json["meshes"][0]["primitives"];
        REQUIRE(primitives.size() == w.skin.part.size());
        std::size_t seen = 0;
        for (std::size_t m = 0; m < primitives.size(); ++m) {
            const Json& attributes = primitives[m]["attributes"];
            const Json& accessor = json["accessors"][std::size_t(attributes["POSITION"])];
            const std::vector<double> position = gltf_reader::numbers(w.glb, attributes["POSITION"]);
            for (std::size_t k = 0; k < 3; ++k) {
                double low = INFINITY, high = -INFINITY;
                for (std::size_t v = k; v < position.size(); v += 3)
                    low = std::min(low, position[v]), high = std::max(high, position[v]);
                CHECK(accessor["min"][k].get<float>() == float(low));
                CHECK(accessor["max"][k].get<float>() == float(high));
            }
            // A program that counts v from the bottom, as OBJ does, reads back the skin's.
            const std::vector<double> texture = gltf_reader::numbers(w.glb, attributes["TEXCOORD_0"]);
            for (std::size_t k = 0; k < 2; ++k)
                CHECK(std::abs((k == 0 ? texture[0] : 1 - texture[1]) - double(w.skin.texture[seen][k])) < 1e-6);
            seen += position.size() / 3;
            const std::vector<double> joint = gltf_reader::numbers(w.glb, attributes["JOINTS_0"]);
            const std::vector<double> weight = gltf_reader::numbers(w.glb, attributes["WEIGHTS_0"]);
            CHECK(json["accessors"][std::size_t(attributes["JOINTS_0"])]["componentType"] ==
                  (w.groups.size() > 256 ? 5123 : 5121));
            std::int64_t wrong = 0;
            for (std::size_t v = 0; v < position.size() / 3; ++v) {
                double sum = 0;
                std::set<double> used;
                for (std::size_t k = 4 * v; k < 4 * v + 4; ++k) {
                    sum += weight[k];
                    if (weight[k] > 0)
                        wrong += !used.insert(joint[k]).second;
                    else
                        wrong += joint[k] != 0;
                    wrong += joint[k] >= double(w.groups.size());
                }
                wrong += std::abs(sum - 1) > 1e-7;
                if (w.skin.part[m].name != "bark") wrong += used.size() != 1; // rigid
            }
            CHECK(wrong == 0);
            const std::vector<double> index = gltf_reader::numbers(w.glb, primitives[m]["indices"]);
            REQUIRE(index.size() == 3 * w.skin.part[m].index_count);
            CHECK(*std::max_element(index.begin(), index.end()) < double(position.size() / 3));
            for (const auto& [name, a] : attributes.items()) {
                const std::size_t view = json["accessors"][std::size_t(a)]["bufferView"];
                CHECK(json["bufferViews"][view]["target"] == 34962);
            }
            const std::size_t view = json["accessors"][std::size_t(primitives[m]["indices"])]["bufferView"];
            CHECK(json["bufferViews"][view]["target"] == 34963);
        }
    }
}

TEST_CASE("bodies of one group are one joint of a vertex, with their weights together") {
    Written w{branched(), build_skin(branched(), {}), merge_joints(branched(), 2), {}};
    REQUIRE(w.groups.group[1] == 0);
    REQUIRE(w.groups.group[2] == 1);
    w.skin.joint[0] = {0, 2, 1, 0};
    w.skin.weight[0] = {0.125f, 0.5f, 0.375f, 0};
    const GlbFile file;
    Output output(file.path);
    GltfWriter(output, w.skin, w.tree, w.groups, {}).finish();
    output.finish();
    w.glb = gltf_reader::parse(read_input(file.path));
    const Json& attributes = w.glb.json["meshes"][0]["primitives"][0]["attributes"];
    const std::vector<double> joint = gltf_reader::numbers(w.glb, attributes["JOINTS_0"]);
    const std::vector<double> weight = gltf_reader::numbers(w.glb, attributes["WEIGHTS_0"]);
    CHECK(std::vector<double>(joint.begin(), joint.begin() + 4) == std::vector<double>{0, 1, 0, 0});
    // A half is none of 65535: one of the two has what is left, so that they add up to 1.
    CHECK(std::lround(65535 * (weight[0] + weight[1])) == 65535);
    CHECK(std::abs(weight[0] - 0.5) < 0.6 / 65535);
    CHECK(weight[2] == 0);
    CHECK(weight[3] == 0);
    for (std::size_t v = 0; v < weight.size(); v += 4)
        CHECK(std::lround(65535 * (weight[v] + weight[v + 1] + weight[v + 2] + weight[v + 3])) == 65535);
}

TEST_CASE("triangles are the skin's, in u32 where u16 is too small") {
    const Tree tree = make_tree::forest({branched(), make_tree::chain(2000, 100, 0.1, 0.1)});
    Written w{tree, build_skin(tree, {24}), merge_joints(tree, 1000), {}};
    REQUIRE(w.skin.position.size() > 65536);
    const GlbFile file;
    Output output(file.path);
    GltfWriter(output, w.skin, w.tree, w.groups, {}).finish();
    output.finish();
    w.glb = gltf_reader::parse(read_input(file.path));
    const auto at = gltf_reader::skinned(w.glb, -1);
    CHECK(farthest(at, w.skin.position) < 1e-6 * w.height());
    std::size_t first = 0;
    bool wide = false;
    for (std::size_t m = 0; m < w.skin.part.size(); ++m) {
        const Json& primitive = w.glb.json["meshes"][0]["primitives"][m];
        const std::vector<double> index = gltf_reader::numbers(w.glb, primitive["indices"]);
        wide = wide || w.glb.json["accessors"][std::size_t(primitive["indices"])]["componentType"] == 5125;
        std::int64_t wrong = 0;
        for (std::size_t t = 0; t < index.size(); ++t)
            wrong += std::size_t(index[t]) + first !=
                     std::size_t(w.skin.triangle[w.skin.part[m].first_index + t / 3][t % 3]);
        CHECK(wrong == 0);
        first += w.glb.json["accessors"][std::size_t(primitive["attributes"]["POSITION"])]["count"].get<std::size_t>();
    }
    CHECK(wide);
    CHECK(!w.glb.json.contains("animations"));
    CHECK(!w.glb.json["asset"].contains("extras"));
}

TEST_CASE("materials: linear colours, leaves seen from both sides") {
    Tree tree = branched();
    tree.color = {{0.5, 0, 1}, {0.02, 0.2, 0.8}, {1, 1, 1}, {0.735, 0.5, 0.5}};
    tree.kind[12] = Kind::petal;
    const Written w = written(tree, 0);
    std::map<std::string, Json> materials;
    for (const Json& material : w.glb.json["materials"]) materials[material["name"]] = material;
    REQUIRE(materials.size() == 4);
    for (const auto& [name, material] : materials) {
        CHECK(material.value("doubleSided", false) == (name == "leaf" || name == "petal"));
        CHECK(material["pbrMetallicRoughness"]["metallicFactor"] == 0);
    }
    const auto color = [&](const char* name) -> std::vector<double> {
        return materials[name]["pbrMetallicRoughness"]["baseColorFactor"];
    };
    // sRGB 0.5 is 0.21404 linear, 0.735 is 0.5; below 0.04045 a line of slope 1 / 12.92 (IEC 61966-2-1).
    CHECK(color("bark")[0] == Approx(0.21404).epsilon(1e-4));
    CHECK(color("bark")[1] == 0);
    CHECK(color("bark")[2] == Approx(1));
    CHECK(color("leaf")[0] == Approx(0.02 / 12.92));
    CHECK(color("fruit")[0] == Approx(0.5).epsilon(2e-3));
    CHECK(color("petal")[3] == 1);
}

TEST_CASE("times: from 0, shared, with their limits") {
    const Written all = written(branched(), 7), thinned = written(branched(), 40, 100, 0.5 * degree);
    const Json& animation = all.glb.json["animations"][0];
    REQUIRE(animation["channels"].size() == all.tree.size_bodies());
    std::set<std::size_t> inputs;
    for (const Json& sampler : animation["samplers"]) inputs.insert(sampler["input"].get<std::size_t>());
    REQUIRE(inputs.size() == 1);
    const std::vector<double> times = gltf_reader::numbers(all.glb, *inputs.begin());
    REQUIRE(times.size() == 7);
    for (std::size_t f = 0; f < 7; ++f) CHECK(times[f] == double(float(double(f) / fps)));
    double longest = 0;
    for (const Json& sampler : thinned.glb.json["animations"][0]["samplers"]) {
        const std::vector<double> own = gltf_reader::numbers(thinned.glb, sampler["input"]);
        const Json& accessor = thinned.glb.json["accessors"][std::size_t(sampler["input"])];
        CHECK(std::is_sorted(own.begin(), own.end(), std::less_equal<>()));
        CHECK(accessor["min"][0].get<float>() == float(own.front())); // bounds are in the accessor's own precision
        CHECK(accessor["max"][0].get<float>() == float(own.back()));
        CHECK(gltf_reader::numbers(thinned.glb, sampler["output"]).size() == 4 * own.size());
        longest = std::max(longest, own.back());
    }
    CHECK(longest == Approx(39 / fps));
}

TEST_CASE("far from the origin the mesh keeps its digits") {
    Tree tree = branched();
    const Vec3 away(4.5e5, 120, -5.2e6);
    tree.joint_position[0] += away;
    Written w = written(tree, 3);
    Json& armature = w.glb.json["nodes"][1];
    CHECK(armature["translation"] == Json({away.x(), away.y(), away.z()}));
    // In the armature's frame: out there a weight's rounding alone, 3e-8 of 5000 km, is 0.15 m.
    armature.erase("translation");
    for (const double time : {-1.0, 2 / fps}) {
        const SkinPose pose =
            time < 0 ? posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); }) : swinging(tree, 2);
        std::vector<Vec3> wanted = deformed(w, pose);
        for (Vec3& p : wanted) p -= away;
        CHECK(farthest(gltf_reader::skinned(w.glb, time), wanted) < 1e-5 * w.height());
    }
}

TEST_CASE("roots that leave their places are moved in every frame, the others not at all") {
    const Tree one = branched();
    Tree tree = make_tree::forest({one, one});
    const Vec3 away = GENERATE(Vec3(0, 0, 0), Vec3(5e6, 0, 0));
    const std::size_t second = one.size_bodies();
    tree.joint_position[0] += away;
    tree.joint_position[second] += away;
    Written w{tree, build_skin(tree, {}), merge_joints(tree, 100), {}};
    const GlbFile file;
    Output output(file.path);
    GltfOptions options;
    options.fps = fps;
    GltfWriter writer(output, w.skin, w.tree, w.groups, options);
    std::vector<SkinPose> poses;
    for (std::size_t f = 0; f < 5; ++f) {
        poses.push_back(swinging(tree, f));
        for (std::size_t i = second; i < tree.size_bodies(); ++i)
            poses.back().x_w[i] += Vec3(0.3 * double(f), 1 - 0.1 * double(f), 0);
        writer.write(frame_of(poses.back(), f));
    }
    writer.finish();
    output.finish();
    w.glb = gltf_reader::parse(read_input(file.path));
    std::size_t translations = 0;
    for (const auto& channel : w.glb.json["animations"][0]["channels"]) {
        if (channel["target"]["path"] != "translation") continue;
        ++translations;
        const std::size_t node = channel["target"]["node"];
        CHECK(w.glb.json["nodes"][node]["name"] == "body_" + std::to_string(second));
    }
    CHECK(translations == 1);
    // What floats of 5000 km cannot say is compared in the armature's frame.
    if (w.glb.json["nodes"][1].contains("translation")) w.glb.json["nodes"][1].erase("translation");
    for (std::size_t f = 0; f < 5; ++f) {
        std::vector<Vec3> wanted = deformed(w, poses[f]);
        for (Vec3& p : wanted) p -= away;
        CHECK(farthest(gltf_reader::skinned(w.glb, double(f) / fps), wanted) < 1e-5 * w.height());
    }
}

TEST_CASE("more joints than a file can number are refused") {
    const Skin skin = build_skin(branched(), {});
    const GlbFile file;
    Output output(file.path);
    const Tree long_chain = make_tree::chain(65537, 100, 0.1, 0.1);
    const JointGroups many = merge_joints(long_chain, 100000);
    CHECK_THROWS_AS(GltfWriter(output, skin, long_chain, many, {}), std::length_error);
}

TEST_CASE("assimp reads the joints, the mesh and the animation") {
    const GlbFile file;
    const Written w = written(random_tree(300, 9), 6, 120, 0, file);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(file.path, 0);
    REQUIRE(scene);
    CHECK(scene->mNumMeshes == w.skin.part.size());
    CHECK(scene->mNumMaterials >= w.skin.part.size()); // and one of its own
    REQUIRE(scene->mNumAnimations == 1);
    CHECK(scene->mAnimations[0]->mNumChannels == w.groups.size());
    std::set<std::string> bones;
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
        CHECK(scene->mMeshes[m]->mNumBones > 0);
        for (unsigned b = 0; b < scene->mMeshes[m]->mNumBones; ++b) {
            bones.insert(scene->mMeshes[m]->mBones[b]->mName.C_Str());
            CHECK(scene->mRootNode->FindNode(scene->mMeshes[m]->mBones[b]->mName));
        }
    }
    CHECK(bones.size() == w.groups.size());
    for (unsigned c = 0; c < scene->mAnimations[0]->mNumChannels; ++c)
        CHECK(scene->mAnimations[0]->mChannels[c]->mNumRotationKeys == 6);
}
