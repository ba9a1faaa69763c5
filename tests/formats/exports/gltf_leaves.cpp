#include "formats/exports/gltf.h"
#include "tests/support/written_glb.h"

using namespace bough;
using namespace skin_checks;
using namespace written_glb;
using gltf_reader::Json;
using make_tree::branched;
using make_tree::random_tree;

namespace {

// Written at rest and, as the one frame, in the given pose.
Glb written(const Tree& tree, const SkinPose& pose, GltfOptions options, std::size_t joints = 10000) {
    const GlbFile file;
    const Skin skin = build_skin(tree, {8, !options.leaf_instances});
    const JointGroups groups = merge_joints(tree, joints, !options.leaf_instances);
    Output output(file.path);
    GltfWriter writer(output, skin, tree, groups, options);
    writer.write(frame_of(pose, 0));
    writer.finish();
    output.finish();
    return gltf_reader::parse(read_input(file.path));
}

// Vertices of all instances as the extension has it: node's world matrix * (T * R * S of the instance) * vertex.
std::vector<Vec3> instanced(const Glb& glb, double time) {
    const auto world = gltf_reader::node_matrices(glb, time);
    std::vector<Vec3> all;
    for (std::size_t i = 0; i < glb.json["nodes"].size(); ++i) {
        const Json& node = glb.json["nodes"][i];
        if (!node.contains("extensions")) continue;
        const Json& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
        const auto t = gltf_reader::numbers(glb, attributes["TRANSLATION"]);
        const auto r = gltf_reader::numbers(glb, attributes["ROTATION"]);
        const auto s = gltf_reader::numbers(glb, attributes["SCALE"]);
        REQUIRE((t.size() == s.size() && 4 * t.size() == 3 * r.size()));
        const Json& primitive = glb.json["meshes"][std::size_t(node["mesh"])]["primitives"][0];
        const auto vertices = gltf_reader::numbers(glb, primitive["attributes"]["POSITION"]);
        for (std::size_t k = 0; k < t.size() / 3; ++k) {
            Eigen::Affine3d place = Eigen::Translation3d(t[3 * k], t[3 * k + 1], t[3 * k + 2]) *
                                    gltf_reader::quaternion(&r[4 * k]) *
                                    Eigen::Scaling(s[3 * k], s[3 * k + 1], s[3 * k + 2]);
            for (std::size_t v = 0; v < vertices.size(); v += 3) {
                const Vec3 at = place * Vec3(vertices[v], vertices[v + 1], vertices[v + 2]);
                all.push_back((world[i] * at.homogeneous()).head<3>());
            }
        }
    }
    return all;
}

// Where leaves and petals are in a skin that has them in it.
std::vector<Vec3> in_skin(const Tree& tree, const SkinPose& pose) {
    const Skin skin = build_skin(tree, {});
    std::vector<Vec3> position, normal, all;
    SkinDeformer(skin, tree).deform(pose.R_wb, pose.x_w, position, normal);
    std::vector<char> flat(position.size(), 0);
    for (const char* name : {"leaf", "petal"})
        for (const auto& corners : triangles(skin, name))
            for (const std::int32_t v : corners) flat[std::size_t(v)] = 1;
    for (std::size_t v = 0; v < flat.size(); ++v)
        if (flat[v]) all.push_back(position[v]);
    return all;
}

double apart(std::vector<Vec3> a, std::vector<Vec3> b) {
    REQUIRE(a.size() == b.size());
    double most = 0; // each has one of the other beside it
    for (const Vec3& p : a) {
        double least = INFINITY;
        for (const Vec3& q : b) least = std::min(least, (p - q).norm());
        most = std::max(most, least);
    }
    return most;
}

Tree with_petals(Tree tree) {
    std::size_t count = 0;
    for (Kind& kind : tree.kind)
        if (kind == Kind::leaf && count++ % 3 == 0) kind = Kind::petal;
    return tree;
}

SkinPose still(const Tree& tree) {
    return posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
}

// All joints of wood bent, none of leaves.
SkinPose bent_wood(const Tree& tree) {
    return posed(tree, [&](std::size_t i) {
        return is_flat(tree.kind[i]) ? Vec3(Vec3::Zero()) : Vec3(0.1 * std::sin(double(i)), 0.07, 0.02);
    });
}

GltfOptions instances() {
    GltfOptions options;
    options.leaf_instances = true;
    return options;
}

} // namespace

TEST_CASE("instances stand where the skin's leaves do, drawn and moved with what bears them") {
    for (const Tree& tree : {branched(), with_petals(branched()), with_petals(random_tree(80, 2))}) {
        for (const bool x_along : {false, true}) {
            GltfOptions options = instances();
            options.x_along = x_along;
            const SkinPose pose = bent_wood(tree);
            const Glb glb = written(tree, pose, options);
            CHECK(apart(instanced(glb, -1), in_skin(tree, still(tree))) < 1e-6);
            CHECK(apart(instanced(glb, 0), in_skin(tree, pose)) < 1e-5);
            // The bark is the same mesh as without.
            const Skin bark = build_skin(tree, {8, false});
            std::vector<Vec3> position, normal;
            SkinDeformer(bark, tree).deform(pose.R_wb, pose.x_w, position, normal);
            const auto skinned = gltf_reader::skinned(glb, 0);
            CHECK(apart({skinned.begin(), skinned.end()}, position) < 1e-5);
        }
    }
}

TEST_CASE("merged joints carry the leaves of all their bodies") {
    const Tree tree = random_tree(300, 5);
    const Glb glb = written(tree, still(tree), instances(), 20);
    CHECK(glb.json["skins"][0]["joints"].size() == 20);
    CHECK(apart(instanced(glb, -1), in_skin(tree, still(tree))) < 1e-6);
}

TEST_CASE("the file says what it needs, and holds a mesh and material a kind") {
    const Json json = written(with_petals(branched()), still(branched()), instances()).json;
    CHECK(json["extensionsUsed"] == Json{"EXT_mesh_gpu_instancing"});
    CHECK(json["extensionsRequired"] == Json{"EXT_mesh_gpu_instancing"});
    REQUIRE(json["meshes"].size() == 3);
    REQUIRE(json["materials"].size() == 4); // bark, fruit, then these
    for (const auto& [mesh, name] : {std::pair(1, "leaf"), std::pair(2, "petal")}) {
        CHECK(json["meshes"][std::size_t(mesh)]["name"] == name);
        const Json& material = json["meshes"][std::size_t(mesh)]["primitives"][0]["material"];
        CHECK(json["materials"][std::size_t(material)]["name"] == name);
    }
    Tree bare = make_tree::chain(3, 1, 0.1, 0.1);
    CHECK_FALSE(written(bare, still(bare), instances()).json.contains("extensionsUsed"));
    CHECK_FALSE(written(branched(), still(branched()), {}).json.contains("extensionsUsed"));
}

TEST_CASE("no leaf has a joint of its own, unless it stands alone") {
    const Tree tree = with_petals(random_tree(400, 9));
    const JointGroups groups = merge_joints(tree, 100000, false);
    for (std::size_t g = 0; g < groups.size(); ++g) CHECK_FALSE(is_flat(tree.kind[std::size_t(groups.first[g])]));
    std::size_t wood = 0;
    for (const Kind kind : tree.kind) wood += !is_flat(kind);
    CHECK(groups.size() == wood);
    Tree fallen = branched();
    for (std::size_t i = 0; i < fallen.size_bodies(); ++i)
        if (fallen.kind[i] == Kind::leaf) fallen.parent[i] = -1;
    CHECK(merge_joints(fallen, 100000, false).size() == fallen.size_bodies());
}

TEST_CASE("with x along the branch the joints' x axes are what their z axes were, and the mesh moves alike") {
    const Tree tree = random_tree(200, 3);
    const SkinPose pose = bent_wood(tree);
    GltfOptions options;
    const Glb z = written(tree, pose, options);
    options.x_along = true;
    const Glb x = written(tree, pose, options);
    for (const double time : {-1.0, 0.0}) {
        const auto a = gltf_reader::node_matrices(z, time), b = gltf_reader::node_matrices(x, time);
        REQUIRE(a.size() == b.size());
        double off = 0;
        for (std::size_t i = 2; i < a.size(); ++i)
            off = std::max({off, (a[i].col(2) - b[i].col(0)).norm(), (a[i].col(3) - b[i].col(3)).norm()});
        CHECK(off < 1e-5);
        const auto from = gltf_reader::skinned(z, time), to = gltf_reader::skinned(x, time);
        REQUIRE(from.size() == to.size());
        for (std::size_t v = 0; v < from.size(); ++v) off = std::max(off, (from[v] - to[v]).norm());
        CHECK(off < 1e-5);
    }
}
