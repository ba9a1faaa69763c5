#include "model_scene.h"
#include "assimp_scene.h"
#include "model_collada.h"
#include "reader_limits.h"
#include "skin_joint.h"
#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <limits>
#include <new>
#include <unordered_map>

namespace bough {
namespace {

using Matrix = Eigen::Matrix4d;

Matrix matrix_of(const aiMatrix4x4& m) {
    Matrix result;
    for (unsigned r = 0; r < 4; ++r)
        for (unsigned c = 0; c < 4; ++c) result(r, c) = static_cast<double>(m[r][c]);
    return result;
}

Vec3 placed(const Matrix& m, const aiVector3D& v) {
    return (m * Eigen::Vector4d(v.x, v.y, v.z, 1)).head<3>();
}

struct Reading {
    const aiScene& scene;
    ModelScene& out;
    std::vector<const aiNode*> node;
    std::vector<Matrix> world;
    NodesByName by_name;
    const std::unordered_map<std::string, ColladaJoint>& collada;
    // By which a skin means it: assimp names all COLLADA joints of one sid by the id of the first.
    std::string_view skin_name(const char* name) const {
        const auto found = collada.find(name);
        return found == collada.end() || found->second.sid.empty() ? name : std::string_view(found->second.sid);
    }
};

bool is_null(const aiNode& node) {
    bool null = false;
    return node.mMetaData && node.mMetaData->Get("IsNull", null) && null;
}

// A root that assimp makes where a file has none, or several: without a place and of a name of its own.
bool made_up(const aiNode& root, AssimpKind kind) {
    const std::string_view name = root.mName.C_Str();
    if (root.mNumMeshes > 0) return false;
    return kind != AssimpKind::fbx || name == "RootNode";
}

void read_nodes(Reading& r, AssimpKind kind) {
    struct Open {
        const aiNode* node;
        std::int32_t parent;
        Matrix above;
    };
    std::vector<Open> stack{{r.scene.mRootNode, -1, Matrix::Identity()}};
    while (!stack.empty()) {
        const Open at = stack.back();
        stack.pop_back();
        const Matrix world = at.above * matrix_of(at.node->mTransformation);
        std::int32_t self = -1;
        if (at.parent >= 0 || at.node != r.scene.mRootNode || !made_up(*at.node, kind)) {
            self = static_cast<std::int32_t>(r.node.size());
            const std::string_view name = at.node->mName.C_Str();
            r.node.push_back(at.node);
            r.world.push_back(world);
            r.by_name.add(r.skin_name(at.node->mName.C_Str()));
            r.out.parent.push_back(at.parent);
            r.out.name.emplace_back(name);
            r.out.role.push_back(at.node->mNumMeshes > 0 || is_null(*at.node) ? NodeRole::holder : NodeRole::open);
        }
        for (unsigned i = at.node->mNumChildren; i-- > 0;) stack.push_back({at.node->mChildren[i], self, world});
    }
    for (const Matrix& world : r.world) {
        r.out.place.push_back(world.topRightCorner<3, 1>());
        Mat3 axes = world.topLeftCorner<3, 3>();
        for (int k = 0; k < 3; ++k) axes.col(k).normalize();
        r.out.axes.push_back(axes);
    }
    r.out.tip.assign(r.node.size(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    const auto hold = [&](const aiString& name) {
        const std::int32_t node = r.by_name.first(name.C_Str());
        if (node >= 0) r.out.role[static_cast<std::size_t>(node)] = NodeRole::holder;
    };
    for (unsigned i = 0; i < r.scene.mNumCameras; ++i) hold(r.scene.mCameras[i]->mName);
    for (unsigned i = 0; i < r.scene.mNumLights; ++i) hold(r.scene.mLights[i]->mName);
}

// Vertices as the joints move them (linear blend), and which joint moves each most.
void read_skinned(Reading& r, const aiMesh& mesh, const Matrix& mesh_world, std::vector<Vec3>& moved) {
    const std::size_t n = mesh.mNumVertices;
    std::vector<std::int32_t> most(n, -1);
    std::vector<double> most_weight(n, 0), sum(n, 0);
    moved.assign(n, Vec3::Zero());
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        const aiBone& bone = *mesh.mBones[b];
        const Matrix offset = matrix_of(bone.mOffsetMatrix);
        const std::int32_t node =
            joint_of(r.by_name, r.skin_name(bone.mName.C_Str()), r.world, r.out.role, offset, mesh_world);
        if (node < 0) throw std::runtime_error("a skin names a joint that is no node");
        const auto joint = static_cast<std::size_t>(node);
        r.out.role[joint] = NodeRole::joint;
        const Matrix move = r.world[joint] * offset;
        for (unsigned k = 0; k < bone.mNumWeights; ++k) {
            const std::size_t v = bone.mWeights[k].mVertexId;
            const double weight = static_cast<double>(bone.mWeights[k].mWeight);
            if (v >= n) throw std::runtime_error("a skin names a vertex that is not there");
            if (!(weight > 0)) continue;
            moved[v] += weight * placed(move, mesh.mVertices[v]);
            sum[v] += weight;
            if (weight > most_weight[v]) most_weight[v] = weight, most[v] = node;
        }
    }
    std::vector<std::int32_t> taken(n, -1);
    for (std::size_t v = 0; v < n; ++v) {
        if (!(sum[v] > 0)) continue;
        moved[v] /= sum[v];
        if (mesh.mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON) && moved[v].allFinite()) {
            taken[v] = static_cast<std::int32_t>(r.out.vertex.size());
            r.out.vertex.push_back(moved[v]);
            r.out.vertex_node.push_back(most[v]);
            r.out.vertex_by_node.push_back(placed(mesh_world, mesh.mVertices[v]));
        }
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices != 3) continue;
        std::array<std::int32_t, 3> corner;
        for (unsigned k = 0; k < 3; ++k) corner[k] = face.mIndices[k] < n ? taken[face.mIndices[k]] : -1;
        if (std::min({corner[0], corner[1], corner[2]}) >= 0) r.out.face.push_back(corner);
    }
}

void read_mesh(Reading& r, const aiMesh& mesh, const Matrix& world, bool first_time) {
    std::vector<Vec3> moved;
    if (mesh.mNumBones > 0 && !first_time) return;
    if (mesh.mNumBones > 0) {
        ++r.out.skinned_meshes;
        read_skinned(r, mesh, world, moved);
    }
    const auto first = static_cast<std::int32_t>(r.out.line_point.size());
    bool lines = false;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        r.out.triangles += face.mNumIndices == 3;
        if (face.mNumIndices != 2) continue;
        for (unsigned k = 0; k < 2; ++k)
            if (face.mIndices[k] >= mesh.mNumVertices)
                throw std::runtime_error("a line names a vertex that is not there");
        r.out.line.push_back(
            {first + static_cast<std::int32_t>(face.mIndices[0]), first + static_cast<std::int32_t>(face.mIndices[1])});
        lines = true;
    }
    if (!lines) return;
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        r.out.line_point.push_back(moved.empty() ? placed(world, mesh.mVertices[v]) : moved[v]);
        r.out.line_radius.push_back(0);
    }
}

void read_meshes(Reading& r) {
    std::vector<char> seen(r.scene.mNumMeshes, false);
    const auto read = [&](const aiNode& node, const Matrix& world) {
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            const unsigned m = node.mMeshes[i];
            read_mesh(r, *r.scene.mMeshes[m], world, !seen[m]);
            seen[m] = true;
        }
    };
    for (std::size_t i = 0; i < r.node.size(); ++i) read(*r.node[i], r.world[i]);
    std::vector<Vec3>& by_node = r.out.vertex_by_node;
    constexpr double rounding = 1e-5; // of single precision
    bool apart = false;
    for (std::size_t v = 0; v < by_node.size(); ++v)
        apart = apart || (by_node[v] - r.out.vertex[v]).norm() > rounding * (1 + r.out.vertex[v].norm());
    if (!apart) by_node = {};
}

// Roles and tips that COLLADA states. A tip is a vector from the bone's start in the armature's axes.
void mark_collada(Reading& r) {
    const auto& joints = r.collada;
    for (std::size_t i = 0; i < r.node.size(); ++i) {
        const auto found = joints.find(r.out.name[i]);
        if (found == joints.end()) continue;
        r.out.role[i] = NodeRole::joint;
        if (!found->second.tip) continue;
        std::int32_t above = r.out.parent[i]; // the armature: the nearest node that is no joint
        while (above >= 0 && joints.contains(r.out.name[static_cast<std::size_t>(above)]))
            above = r.out.parent[static_cast<std::size_t>(above)];
        const Matrix frame =
            above >= 0 ? r.world[static_cast<std::size_t>(above)] : matrix_of(r.scene.mRootNode->mTransformation);
        r.out.tip[i] = r.out.place[i] + frame.topLeftCorner<3, 3>() * *found->second.tip;
    }
}

ModelScene read_in_child(std::string_view content, AssimpKind kind, const ImportOptions& options) {
    ModelScene out;
    Assimp::Importer importer;
    const aiScene& scene = *load_by_assimp(importer, content, kind, options.up != 0);
    const auto collada =
        kind == AssimpKind::dae ? collada_joints(content) : std::unordered_map<std::string, ColladaJoint>();
    Reading reading{scene, out, {}, {}, {}, collada};
    const ModelFrame frame = stated_frame(scene, kind);
    out.to_y_up = frame.axes;
    out.unit = frame.unit;
    read_nodes(reading, kind);
    read_meshes(reading);
    reading.out.index.assign(reading.node.size(), -1);
    mark_collada(reading);
    // In an FBX file what is no joint is a Null or holds something.
    const bool stated = std::count(out.role.begin(), out.role.end(), NodeRole::joint) > 0;
    out.open_are_joints = kind == AssimpKind::fbx || (!stated && out.triangles == 0);
    return out;
}

} // namespace

ModelScene read_model(std::string_view content, AssimpKind kind, const ImportOptions& options) {
    ChildResult child;
    try {
        if (kind == AssimpKind::glb || kind == AssimpKind::gltf) return scene_of_gltf(content, options);
        child =
            run_forked([&] { return bytes_of(read_in_child(content, kind, options)); }, reader_limits(content.size()));
        if (child.failure.empty()) return model_scene_of(child.bytes);
    } catch (const std::bad_alloc&) { // here, of what the child could read
        throw InputError(options.name, "what is in it needs more memory than there is");
    }
    const std::string own = options.name + ":"; // of an InputError in the child, with a line or without
    const std::size_t place = child.failure.find(": ", options.name.size());
    if (child.failure.starts_with(own) && place != std::string::npos)
        throw InputError(child.failure.substr(0, place), child.failure.substr(place + 2));
    throw InputError(options.name,
                     "assimp could not read it: " + child.failure + "; expected " + model_kind_name(kind));
}

} // namespace bough
