#include "assimp_mesh.h"
#include "assimp_scene.h"
#include "packed.h"
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <stdexcept>

namespace bough {
namespace {

void add_mesh(const aiMesh& mesh, const aiMatrix4x4& to_world, AssimpMesh& out) {
    const auto first = static_cast<std::int32_t>(out.vertex.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiVector3D p = to_world * mesh.mVertices[i];
        out.vertex.emplace_back(p.x, p.y, p.z);
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices != 3) continue;
        Triangle t;
        for (unsigned k = 0; k < 3; ++k) {
            if (face.mIndices[k] >= mesh.mNumVertices)
                throw std::runtime_error("a face names a vertex that is not there");
            t[k] = first + static_cast<std::int32_t>(face.mIndices[k]);
        }
        out.triangle.push_back(t);
    }
}

} // namespace

AssimpMesh read_by_assimp(std::string_view content, AssimpKind kind, bool up_given) {
    Assimp::Importer importer;
    const aiScene* scene = load_by_assimp(importer, content, kind, up_given);
    AssimpMesh out;
    std::vector<std::pair<const aiNode*, aiMatrix4x4>> stack{{scene->mRootNode, aiMatrix4x4()}};
    while (!stack.empty()) {
        const auto [node, above] = stack.back();
        stack.pop_back();
        const aiMatrix4x4 to_world = above * node->mTransformation;
        for (unsigned i = 0; i < node->mNumMeshes; ++i) add_mesh(*scene->mMeshes[node->mMeshes[i]], to_world, out);
        for (unsigned i = node->mNumChildren; i-- > 0;) stack.push_back({node->mChildren[i], to_world});
    }
    const ModelFrame frame = stated_frame(*scene, kind);
    out.axes = frame.axes;
    out.unit = frame.unit;
    return out;
}

std::string packed(const AssimpMesh& mesh) {
    std::string bytes;
    pack(bytes, mesh.axes.data(), 9);
    pack(bytes, &mesh.unit, 1);
    pack_all<double, 3>(bytes, mesh.vertex);
    pack_all<std::int32_t, 3>(bytes, mesh.triangle);
    return bytes;
}

AssimpMesh unpacked(const std::string& bytes) {
    AssimpMesh mesh;
    std::size_t from = 0;
    unpack(bytes, from, mesh.axes.data(), 9);
    unpack(bytes, from, &mesh.unit, 1);
    unpack_all<double, 3>(bytes, from, mesh.vertex);
    unpack_all<std::int32_t, 3>(bytes, from, mesh.triangle);
    return mesh;
}

} // namespace bough
