// Clumps in a .glb: read back by the specification alone they stand and rustle as rustle.h has it, on no joint more.
#include "formats/exports/gltf.h"
#include "lib/growth/clump.h"
#include "tests/support/written_glb.h"
#include <assimp/Importer.hpp>
#include <assimp/scene.h>

using namespace bough;
using namespace skin_checks;
using namespace written_glb;

namespace {

// A random tree whose leaves are clumps.
Tree clumps(unsigned seed) {
    Tree tree = make_tree::random_tree(40, seed);
    for (const Kind kind : tree.kind) tree.leaf_count.push_back(kind == Kind::leaf ? 12 : 1);
    REQUIRE(std::count(tree.leaf_count.begin(), tree.leaf_count.end(), 12) > 3);
    return tree;
}

struct Rustled {
    Skin skin;
    Glb glb;
    GlbFile file;
    Rustled(const Tree& tree, const std::vector<SkinPose>& poses, double wind, bool instances = false)
        : skin(build_skin(tree, {8, !instances})) {
        const JointGroups groups = merge_joints(tree, 1000, !instances);
        GltfOptions options;
        options.fps = fps;
        options.leaf_instances = instances;
        Rustle rustle(skin, [wind](double, std::vector<double>& all) { std::fill(all.begin(), all.end(), wind); },
                      {fps, {}, true});
        Output output(file.path);
        GltfWriter writer(output, skin, tree, groups, options, instances ? nullptr : &rustle);
        for (std::size_t f = 0; f < poses.size(); ++f) writer.write(frame_of(poses[f], f));
        writer.finish();
        output.finish();
        glb = gltf_reader::parse(read_input(file.path));
    }
};

} // namespace

TEST_CASE("leaves of clumps rustle in a .glb as the law has it, to first order") {
    const Tree tree = clumps(7);
    std::vector<SkinPose> poses;
    for (unsigned f = 0; f < 12; ++f) poses.push_back(bent(tree, 0.2, f));
    const double wind = 1.2;
    const Rustled w(tree, poses, wind);
    CHECK(w.glb.json["skins"][0]["joints"].size() == tree.size_bodies());
    REQUIRE(w.glb.json["meshes"].size() == 2);
    CHECK(w.glb.json["meshes"][1]["primitives"][0]["targets"].size() == Rustle::targets);

    Rustle rustle(w.skin, [wind](double, std::vector<double>& all) { std::fill(all.begin(), all.end(), wind); },
                  {fps, {}, true});
    const SkinDeformer deformer(w.skin, tree);
    // In the file the leaves come behind what does not rustle, which is fruit here.
    const SkinPart leaf = *part(w.skin, "leaf");
    const auto first = std::size_t(w.skin.clump_leaf.front());
    const std::size_t leaves = leaf_vertices * w.skin.clump_leaf.size();
    REQUIRE(leaf.index_count == leaves / 2);
    for (std::size_t f = 0; f < poses.size(); ++f) {
        std::vector<Vec3> position, normal;
        deformer.deform(poses[f].R_wb, poses[f].x_w, position, normal);
        const std::vector<Vec3> still = position;
        rustle.go_to(std::int64_t(f));
        rustle.turn(position, normal);
        const auto read = gltf_reader::skinned(w.glb, double(f) / fps);
        REQUIRE(read.size() == position.size());
        double off = 0, moved = 0, size = 0;
        for (std::size_t k = 0; k < leaves; ++k) {
            off = std::max(off, (read[read.size() - leaves + k] - position[first + k]).norm());
            moved = std::max(moved, (position[first + k] - still[first + k]).norm());
        }
        for (std::size_t i = 0; i < tree.size_bodies(); ++i)
            if (tree.kind[i] == Kind::leaf) size = std::max(size, clump_leaf_size(tree, i, 12).x());
        const double largest = 2 * rustle_amplitude(wind);
        CHECK(moved > 0.2 * largest * size);
        CHECK(off < 0.6 * largest * largest * size + 1e-5);
        for (std::size_t v = 0; v < first; ++v) REQUIRE((read[v] - position[v]).norm() < 1e-4);
    }
}

TEST_CASE("in still air, and at rest, a .glb has no morph targets") {
    const Tree tree = clumps(7);
    const SkinPose drawn = posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
    const Rustled calm(tree, {drawn, drawn}, 0), rest(tree, {}, 8);
    for (const Rustled* w : {&calm, &rest}) {
        CHECK(w->glb.json["meshes"].size() == 1);
        CHECK_FALSE(w->glb.json["meshes"][0].contains("weights"));
        CHECK(w->glb.json.dump().find("targets") == std::string::npos);
    }
}

TEST_CASE("another program reads a .glb whose leaves rustle") {
    const Tree tree = clumps(7);
    const SkinPose drawn = posed(tree, [](std::size_t) { return Vec3(Vec3::Zero()); });
    const Rustled w(tree, {drawn, drawn, drawn}, 8);
    Assimp::Importer importer;
    const aiScene* const scene = importer.ReadFile(w.file.path, 0);
    INFO(importer.GetErrorString());
    REQUIRE(scene);
    unsigned moving = 0;
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) moving += scene->mMeshes[m]->mNumAnimMeshes == Rustle::targets;
    CHECK(moving == 1);
    REQUIRE(scene->mNumAnimations == 1);
    CHECK(scene->mAnimations[0]->mNumMorphMeshChannels == 1);
}

TEST_CASE("as instances a clump is its leaves too, of the clump's area") {
    const Tree tree = clumps(7);
    const Rustled w(tree, {}, 8, true);
    double area = 0, truth = 0;
    std::size_t count = 0;
    for (const auto& node : w.glb.json["nodes"]) {
        if (!node.contains("extensions") || node["name"].get<std::string>().find("leaves") == std::string::npos)
            continue;
        const auto scale =
            gltf_reader::numbers(w.glb, node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"]);
        for (std::size_t k = 0; k < scale.size(); k += 3) area += scale[k] * scale[k + 2], ++count;
    }
    std::size_t bodies = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == Kind::leaf) truth += tree.size[i].x() * tree.size[i].y(), ++bodies;
    CHECK(count == 12 * bodies);
    CHECK(area == Approx(truth).epsilon(1e-5));
}
