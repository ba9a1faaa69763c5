#include "formats/documents/document_parts.h"
#include "gltf_parts.h"
#include "lib/growth/clump.h"
#include "lib/model/drawn_pose.h"
#include <algorithm>
#include <memory>

namespace bough {
namespace {

struct Instance {
    std::int32_t group;
    Kind kind;
    Eigen::Vector3f place, scale; // relative to the group's joint
    Eigen::Vector4f rotation;     // x y z w
};

// In the order of groups, leaves before petals: what stands under one node is one stretch.
std::vector<Instance> instances_of(const Tree& tree, const JointGroups& groups, const GroupFrames& drawn) {
    const auto [R_wb, x_w] = drawn_pose(tree);
    const std::vector<std::int32_t> drawn_as = clump_leaves_drawn(tree);
    std::vector<Instance> all;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        if (!is_flat(tree.kind[i])) continue;
        const std::size_t g = std::size_t(groups.group[i]);
        const Mat3 R_gw = drawn.R_wg[g].transpose();
        const auto add = [&](const Mat3& axes, const Vec3& foot, const Vec3& size) {
            const Quat turn = Quat(Mat3(R_gw * axes)).normalized();
            // A scale of 0 has no normals.
            const Vec3 scale = Vec3(size.y(), size.z(), size.x()).cwiseMax(1e-6 * size.x());
            all.push_back({groups.group[i], tree.kind[i], (R_gw * (foot - drawn.x_w[g])).cast<float>(),
                           scale.cast<float>(), turn.coeffs().cast<float>()});
        };
        if (!is_clump(tree, i)) {
            add(R_wb[i], x_w[i], tree.size[i]);
            continue;
        }
        const std::int32_t count = drawn_as[i];
        for (const ClumpLeaf& leaf : clump_leaves(tree, i, R_wb[i], count))
            add(R_wb[i] * leaf.axes, x_w[i] + R_wb[i] * leaf.foot, clump_leaf_size(tree, i, count));
    }
    std::stable_sort(all.begin(), all.end(), [](const Instance& a, const Instance& b) {
        return a.group != b.group ? a.group < b.group : a.kind < b.kind;
    });
    return all;
}

// A leaf or petal of 1 m, joint at the origin, in the axes of its body.
Skin unit_leaf(Kind kind) {
    Tree tree;
    tree.resize(1);
    tree.parent[0] = -1;
    tree.kind[0] = kind;
    tree.joint_position[0] = Vec3::Zero();
    tree.joint_rotation[0] = Quat::Identity();
    tree.size[0] = Vec3::Ones();
    return build_skin(tree, {});
}

std::string add_mesh(GltfFile& file, Kind kind, const char* name, int material) {
    const auto skin = std::make_shared<const Skin>(unit_leaf(kind));
    const std::uint64_t n = skin->position.size(), triangles = skin->triangle.size();
    Eigen::Vector3f low = skin->position[0].cast<float>(), high = low;
    for (const Vec3& p : skin->position) {
        low = low.cwiseMin(p.cast<float>());
        high = high.cwiseMax(p.cast<float>());
    }
    const auto vectors = [&](const std::vector<Vec3> Skin::*array) {
        return file.add_view(12 * n, GltfTarget::vertices, 12, [skin, array](GltfBytes& to) {
            for (const Vec3& v : (*skin).*array) to.add_all(float(v.x()), float(v.y()), float(v.z()));
        });
    };
    const int position =
        file.add_accessor(vectors(&Skin::position), 0, GltfType::f32, n, "VEC3", gltf_bounds(low, high));
    const int normal = file.add_accessor(vectors(&Skin::normal), 0, GltfType::f32, n, "VEC3");
    const int texture_view = file.add_view(8 * n, GltfTarget::vertices, 8, [skin](GltfBytes& to) {
        for (const auto& [u, v] : skin->texture) to.add_all(u, 1 - v);
    });
    const int texture = file.add_accessor(texture_view, 0, GltfType::f32, n, "VEC2");
    const int index_view = file.add_view(6 * triangles, GltfTarget::indices, 0, [skin](GltfBytes& to) {
        for (const auto& corners : skin->triangle)
            for (const std::int32_t v : corners) to.add(std::uint16_t(v));
    });
    const int index = file.add_accessor(index_view, 0, GltfType::u16, 3 * triangles, "SCALAR");
    return std::string(",\n{\"name\":\"") + name +
           "\",\"primitives\":[{\"attributes\":{\"POSITION\":" + std::to_string(position) +
           ",\"NORMAL\":" + std::to_string(normal) + ",\"TEXCOORD_0\":" + std::to_string(texture) +
           "},\"indices\":" + std::to_string(index) + ",\"material\":" + std::to_string(material) + "}]}";
}

const Vec3& color_of(const Tree& tree, Kind kind) {
    return (tree.color.empty() ? default_colors() : tree.color)[kind == Kind::petal ? 2 : 1];
}

} // namespace

GltfLeaves gltf_leaves(GltfFile& file, const Tree& tree, const JointGroups& groups, const GroupFrames& drawn,
                       int first_node, int first_mesh, int first_material) {
    GltfLeaves made;
    made.children.resize(groups.size());
    const auto all = std::make_shared<const std::vector<Instance>>(instances_of(tree, groups, drawn));
    if (all->empty()) return made;
    const std::uint64_t n = all->size();
    const int place = file.add_view(12 * n, GltfTarget::none, 0, [all](GltfBytes& to) {
        for (const Instance& i : *all) to.add_all(i.place.x(), i.place.y(), i.place.z());
    });
    const int turn = file.add_view(16 * n, GltfTarget::none, 0, [all](GltfBytes& to) {
        for (const Instance& i : *all) to.add_all(i.rotation[0], i.rotation[1], i.rotation[2], i.rotation[3]);
    });
    const int scale = file.add_view(12 * n, GltfTarget::none, 0, [all](GltfBytes& to) {
        for (const Instance& i : *all) to.add_all(i.scale.x(), i.scale.y(), i.scale.z());
    });
    int meshes = 0, mesh_of[2] = {-1, -1};
    for (const Kind kind : {Kind::leaf, Kind::petal}) {
        if (std::none_of(all->begin(), all->end(), [&](const Instance& i) { return i.kind == kind; })) continue;
        const char* const name = kind == Kind::petal ? "petal" : "leaf";
        mesh_of[kind == Kind::petal] = first_mesh + meshes;
        made.meshes += add_mesh(file, kind, name, first_material + meshes);
        made.materials += ",\n" + gltf_material(name, color_of(tree, kind));
        ++meshes;
    }
    int node = first_node;
    for (std::size_t from = 0, to; from < all->size(); from = to) {
        const Instance& first = (*all)[from];
        for (to = from + 1; to < all->size(); ++to)
            if ((*all)[to].group != first.group || (*all)[to].kind != first.kind) break;
        const std::size_t g = std::size_t(first.group);
        const auto accessor = [&](int view, std::uint64_t bytes, const char* type) {
            return std::to_string(file.add_accessor(view, bytes * from, GltfType::f32, to - from, type));
        };
        made.nodes += ",\n{\"name\":\"body_" + std::to_string(groups.first[g]) +
                      (first.kind == Kind::petal ? " petals" : " leaves") +
                      "\",\"mesh\":" + std::to_string(mesh_of[first.kind == Kind::petal]) +
                      ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":" +
                      accessor(place, 12, "VEC3");
        made.nodes += ",\"ROTATION\":" + accessor(turn, 16, "VEC4");
        made.nodes += ",\"SCALE\":" + accessor(scale, 12, "VEC3") + "}}}}";
        made.children[g] += (made.children[g].empty() ? "" : ",") + std::to_string(node++);
    }
    return made;
}

} // namespace bough
