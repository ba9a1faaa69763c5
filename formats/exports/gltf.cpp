#include "gltf.h"
#include "formats/documents/document_parts.h"
#include "gltf_parts.h"
#include <algorithm>
#include <cassert>
#include <limits>
#include <stdexcept>

namespace bough {
namespace {

constexpr int mesh_node = 0, armature_node = 1, first_joint = 2;

// What is taken off all positions: nothing, or the first joint's place where floats would be too coarse.
Vec3 origin_of(const Skin* skin, const OwnMesh* own, const GroupFrames& drawn) {
    Vec3 low = drawn.x_w[0], high = low;
    const auto add = [&](const Vec3& p) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    };
    if (skin)
        for (const Vec3& p : skin->position) add(p);
    if (own)
        for (const OwnPart& part : own->part)
            each_vertex(*own, part, [&](const OwnSurface& from, std::size_t v, const OwnPlace* place) {
                add(position_of(from, v, place).cast<double>());
            });
    const double farthest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
    const bool suffices = farthest * std::numeric_limits<float>::epsilon() <= 1e-6 * (high - low).maxCoeff();
    return suffices ? Vec3(Vec3::Zero()) : drawn.x_w[0];
}

// The joints' nodes: the drawn pose, children by name of body; `children` holds those that are no joints.
std::string joint_nodes(const JointGroups& groups, const GroupFrames& drawn, const Vec3& origin,
                        std::vector<std::string> children, const std::vector<std::string>& rods) {
    children.resize(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups.parent[g] < 0) continue;
        std::string& list = children[std::size_t(groups.parent[g])];
        list += (list.empty() ? "" : ",") + std::to_string(first_joint + int(g));
    }
    std::string text;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const Vec3 place = groups.parent[g] < 0 ? Vec3(drawn.position[g] - origin) : drawn.position[g];
        text += ",\n{\"name\":\"body_" + std::to_string(groups.first[g]) +
                "\",\"translation\":" + gltf_list(Eigen::Vector3f(place.cast<float>())) +
                ",\"rotation\":" + gltf_list(Eigen::Vector4f(drawn.rotation[g].coeffs().cast<float>()));
        if (!children[g].empty()) text += ",\"children\":[" + children[g] + "]";
        text += rods[g] + '}';
    }
    return text;
}

std::string nodes(const Tree& tree, const JointGroups& groups, const GroupFrames& drawn, const Vec3& origin,
                  const GltfLeaves& leaves) {
    const std::string name = tree.name.empty() ? "tree" : tree.name;
    std::string text = "{\"name\":";
    append_string(text, name);
    text += ",\"mesh\":0,\"skin\":0},\n{\"name\":";
    append_string(text, name + " joints");
    if (!origin.isZero(0)) text += ",\"translation\":" + gltf_list(origin);
    text += ",\"children\":[";
    bool first = true;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups.parent[g] >= 0) continue;
        text += (first ? "" : ",") + std::to_string(first_joint + int(g));
        first = false;
    }
    return text + "]}" + joint_nodes(groups, drawn, origin, leaves.children, gltf_rods(tree, groups, drawn)) +
           leaves.nodes;
}

// The file's joints as one skin; inverse bind matrices take the mesh's frame (the world less `origin`) to the joints'.
std::string skin_of(GltfFile& file, const GroupFrames& drawn, const Vec3& origin) {
    const std::uint64_t n = drawn.x_w.size();
    const int view = file.add_view(64 * n, GltfTarget::none, 0, [&drawn, origin](GltfBytes& to) {
        for (std::size_t g = 0; g < drawn.x_w.size(); ++g) {
            const Mat3 R = drawn.R_wg[g].transpose();
            const Vec3 t = -(R * (drawn.x_w[g] - origin));
            for (int c = 0; c < 3; ++c) to.add_all(float(R(0, c)), float(R(1, c)), float(R(2, c)), 0.0f);
            to.add_all(float(t.x()), float(t.y()), float(t.z()), 1.0f);
        }
    });
    const int accessor = file.add_accessor(view, 0, GltfType::f32, n, "MAT4");
    std::string text = "{\"inverseBindMatrices\":" + std::to_string(accessor) +
                       ",\"skeleton\":" + std::to_string(armature_node) + ",\"joints\":[";
    for (std::uint64_t g = 0; g < n; ++g) text += (g > 0 ? "," : "") + std::to_string(first_joint + int(g));
    return text + "]}";
}

// The skin's meshes: one, or two where leaves rustle beside what does not.
struct LeafMesh {
    std::string meshes;
    bool own = false;     // the leaves have a mesh, and a node, of their own
    int node = mesh_node; // which has the morph targets
};

LeafMesh leaf_mesh(GltfFile& file, const Skin& skin, const JointGroups& groups, const Vec3& origin,
                   const Rustle* rustle) {
    std::vector<std::string> targets(skin.part.size());
    for (std::size_t m = 0; m < skin.part.size() && rustle; ++m)
        if (skin.part[m].name == "leaf") targets[m] = gltf_targets(file, skin, skin.part[m], *rustle);
    const std::vector<std::string> primitives = gltf_primitives(file, skin, groups, origin, targets);
    std::string still, moving;
    for (std::size_t m = 0; m < primitives.size(); ++m) {
        std::string& list = targets[m].empty() ? still : moving;
        list += (list.empty() ? "" : ",\n") + primitives[m];
    }
    const auto mesh = [](const char* name, const std::string& more, const std::string& list) {
        return std::string("{\"name\":\"") + name + "\"," + more + "\"primitives\":[\n" + list + "]}";
    };
    LeafMesh made;
    if (moving.empty()) {
        made.meshes = mesh("skin", "", still);
    } else if (still.empty()) {
        made.meshes = mesh("skin", gltf_target_weights() + ",", moving);
    } else {
        made.meshes = mesh("skin", "", still) + ",\n" + mesh("leaves", gltf_target_weights() + ",", moving);
        made.own = true;
        made.node = first_joint + int(groups.size());
    }
    return made;
}

std::string leaf_node(const Tree& tree) {
    std::string text = ",\n{\"name\":";
    append_string(text, (tree.name.empty() ? "tree" : tree.name) + " leaves");
    return text + ",\"mesh\":1,\"skin\":0}";
}

// The joints' own axes in their groups' frames: with x along the branch z is x, x is y, y is z.
std::vector<Quat> axes_of(const GltfOptions& options, std::size_t joints) {
    if (!options.x_along) return {};
    Mat3 turn;
    turn.col(0) = Vec3::UnitZ();
    turn.col(1) = Vec3::UnitX();
    turn.col(2) = Vec3::UnitY();
    std::vector<Quat> axes(joints, Quat(turn));
    for (const std::int32_t j : options.tilted)
        axes[std::size_t(j)] = axes[std::size_t(j)] * Quat(Eigen::AngleAxisd(1e-3, Vec3::UnitY()));
    return axes;
}

// The same joints with their own axes turned.
GroupFrames turned(GroupFrames frames, const JointGroups& groups, const std::vector<Quat>& axes) {
    for (std::size_t g = 0; g < axes.size(); ++g) {
        const std::int32_t p = groups.parent[g];
        frames.R_wg[g] = frames.R_wg[g] * axes[g].toRotationMatrix();
        frames.rotation[g] = frames.rotation[g] * axes[g];
        if (p < 0) continue;
        frames.rotation[g] = axes[std::size_t(p)].conjugate() * frames.rotation[g];
        frames.position[g] = axes[std::size_t(p)].conjugate() * frames.position[g];
    }
    return frames;
}

} // namespace

GltfWriter::GltfWriter(Output& output, const Skin& skin, const Tree& tree, const JointGroups& groups,
                       const GltfOptions& options, Rustle* rustle)
    : GltfWriter(output, &skin, nullptr, tree, groups, options, rustle) {}

GltfWriter::GltfWriter(Output& output, const OwnMesh& own, const Tree& tree, const JointGroups& groups,
                       const GltfOptions& options)
    : GltfWriter(output, nullptr, &own, tree, groups, options, nullptr) {}

GltfWriter::GltfWriter(Output& output, const Skin* skin, const OwnMesh* own, const Tree& tree,
                       const JointGroups& groups, const GltfOptions& options, Rustle* rustle)
    : output_(output), skin_(skin), own_(own), tree_(tree), groups_(groups), options_(options),
      axes_(axes_of(options, groups.size())), drawn_(turned(drawn_frames(tree, groups), groups, axes_)),
      keys_(groups.parent, drawn_.rotation), rotation_(groups.size()), rustle_(rustle) {
    if (groups.size() > 65536)
        throw std::length_error("a skin of " + std::to_string(groups.size()) +
                                " joints, but a .glb can number 65536; merge some");
    for (std::size_t g = 0; g < groups.size(); ++g)
        if (groups.parent[g] < 0) paths_.push_back({g, {}});
}

void GltfWriter::write(const MotionFrame& frame) {
    assert(frame.rotation.size() == tree_.size_bodies());
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        rotation_[g] = frame.rotation[std::size_t(groups_.lead[g])];
        if (!axes_.empty()) rotation_[g] = rotation_[g] * axes_[g];
    }
    for (RootPath& path : paths_) {
        const Vec3 &is = frame.position[std::size_t(groups_.first[path.joint])], &drawn = drawn_.x_w[path.joint];
        path.place.push_back(is);
        path.leaves |= is != path.place.front() || !((is - drawn).norm() <= 1e-6 * (1 + drawn.norm()));
    }
    keys_.add(rotation_);
    if (!rustle_) return;
    rustle_->go_to(frame.frame);
    for (const double w : rustle_->weights()) weights_.push_back(float(w));
}

// Nodes, materials and meshes, as elements of the document.
std::string GltfWriter::shown(GltfFile& file, const Vec3& origin, std::string& extensions, int& weights_node) const {
    GltfLeaves leaves;
    if (own_) {
        const std::string mesh = gltf_own_mesh(file, *own_, groups_, origin);
        return "[\n" + nodes(tree_, groups_, drawn_, origin, leaves) + "],\n" + gltf_own_materials(file, *own_) +
               ",\n\"meshes\":[" + mesh + "]";
    }
    if (options_.leaf_instances)
        leaves =
            gltf_leaves(file, tree_, groups_, drawn_, first_joint + int(groups_.size()), 1, int(skin_->part.size()));
    const LeafMesh rustling = leaf_mesh(file, *skin_, groups_, origin, weights_.empty() ? nullptr : rustle_);
    if (!leaves.nodes.empty())
        extensions =
            ",\n\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\"],\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\"]";
    weights_node = rustling.node;
    return "[\n" + nodes(tree_, groups_, drawn_, origin, leaves) + (rustling.own ? leaf_node(tree_) : "") +
           "],\n\"materials\":[\n" + gltf_materials(*skin_) + leaves.materials + "],\n\"meshes\":[" + rustling.meshes +
           leaves.meshes + "]";
}

void GltfWriter::finish() {
    GltfFile file;
    const std::string json = finish(file);
    file.write(output_, json);
}

std::string GltfWriter::finish_in_memory() {
    GltfFile file;
    const std::string json = finish(file);
    std::string bytes(file.bytes(json), 0);
    Output to(bytes.data(), bytes.size(), output_.name());
    file.write(to, json);
    to.finish();
    return bytes;
}

// What the JSON holds beside arrays, which go into the file.
std::string GltfWriter::finish(GltfFile& file) {
    keys_.thin(options_.key_tolerance, true);
    const Vec3 origin = origin_of(skin_, own_, drawn_);
    // Still air moves nothing: no targets.
    if (std::all_of(weights_.begin(), weights_.end(), [](float w) { return w == 0; })) weights_.clear();
    std::string extensions;
    int weights_node = mesh_node;
    const std::string elements = shown(file, origin, extensions, weights_node);
    std::string json = gltf_asset(options_.generator, options_.source) + extensions +
                       ",\n\"scene\":0,\"scenes\":[{\"nodes\":[" + std::to_string(mesh_node) + "," +
                       std::to_string(armature_node) +
                       (weights_node > armature_node ? "," + std::to_string(weights_node) : "") +
                       "]}],\n\"nodes\":" + elements + ",\n\"skins\":[" + skin_of(file, drawn_, origin) + "]";
    const std::string animation =
        gltf_animation(file, keys_, paths_, origin, options_.fps, first_joint, weights_, weights_node);
    if (!animation.empty()) json += ",\n\"animations\":[" + animation + "]";
    return json;
}

} // namespace bough
