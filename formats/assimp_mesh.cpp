#include "assimp_mesh.h"
#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cstring>
#include <optional>
#include <stdexcept>

namespace bough {
namespace {

const char* ending(AssimpKind kind) {
    switch (kind) {
    case AssimpKind::obj:
        return "obj";
    case AssimpKind::fbx:
        return "fbx";
    case AssimpKind::gltf:
        return "gltf";
    case AssimpKind::glb:
        return "glb";
    default:
        return "dae";
    }
}

// Only the readers that take this ending stay: assimp would try others by a look at the content.
void keep_reader(Assimp::Importer& importer, const std::string& wanted) {
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        const aiImporterDesc* about = importer.GetImporterInfo(i);
        const std::string list = about && about->mFileExtensions ? " " + std::string(about->mFileExtensions) + " " : "";
        if (list.find(" " + wanted + " ") == std::string::npos) importer.UnregisterLoader(importer.GetImporter(i));
    }
}

const aiScene* load(Assimp::Importer& importer, std::string_view content, const std::string& path, AssimpKind kind) {
    const std::string wanted = ending(kind);
    keep_reader(importer, wanted);
    const unsigned flags = aiProcess_Triangulate;
    // Buffers of a .gltf stand beside it; the rest is whole in memory, whatever its name.
    const aiScene* scene = kind == AssimpKind::gltf && path != "-" && path.ends_with(".gltf")
                               ? importer.ReadFile(path, flags)
                               : importer.ReadFileFromMemory(content.data(), content.size(), flags, wanted.c_str());
    if (!scene || !scene->mRootNode) {
        std::string why = importer.GetErrorString();
        std::replace_if(
            why.begin(), why.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
        throw std::runtime_error(why.empty() ? "no scene in it" : why);
    }
    return scene;
}

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

std::optional<double> metadata(const aiScene& scene, const char* key) {
    if (!scene.mMetaData) return {};
    double real = 0;
    float single = 0;
    std::int32_t whole = 0;
    if (scene.mMetaData->Get(key, real)) return real;
    if (scene.mMetaData->Get(key, single)) return single;
    if (scene.mMetaData->Get(key, whole)) return whole;
    return {};
}

// FBX: which file axis, with which sign, points right, up and to the viewer.
void state_fbx(const aiScene& scene, AssimpMesh& out) {
    Mat3 axes = Mat3::Zero();
    const char* const names[3][2] = {
        {"CoordAxis", "CoordAxisSign"}, {"UpAxis", "UpAxisSign"}, {"FrontAxis", "FrontAxisSign"}};
    for (int row = 0; row < 3; ++row) {
        const auto axis = metadata(scene, names[row][0]), sign = metadata(scene, names[row][1]);
        if (axis && *axis >= 0 && *axis <= 2) axes(row, static_cast<int>(*axis)) = sign && *sign < 0 ? -1 : 1;
    }
    if (std::abs(axes.determinant()) > 0.5) out.axes = axes;
    const double scale = metadata(scene, "UnitScaleFactor").value_or(1);
    out.unit = scale > 0 ? 0.01 * scale : 0;
}

template <class T> void add(std::string& bytes, const T* data, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(data), count * sizeof(T));
}

template <class T> void take(const std::string& bytes, std::size_t& from, T* data, std::size_t count) {
    if (bytes.size() - from < count * sizeof(T)) throw std::runtime_error("a child process sent too little");
    if (count > 0) std::memcpy(data, bytes.data() + from, count * sizeof(T));
    from += count * sizeof(T);
}

} // namespace

AssimpMesh read_by_assimp(std::string_view content, const std::string& path, AssimpKind kind, bool up_given) {
    Assimp::Importer importer;
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, up_given);
    const aiScene* scene = load(importer, content, path, kind);
    AssimpMesh out;
    std::vector<std::pair<const aiNode*, aiMatrix4x4>> stack{{scene->mRootNode, aiMatrix4x4()}};
    while (!stack.empty()) {
        const auto [node, above] = stack.back();
        stack.pop_back();
        const aiMatrix4x4 to_world = above * node->mTransformation;
        for (unsigned i = 0; i < node->mNumMeshes; ++i) add_mesh(*scene->mMeshes[node->mMeshes[i]], to_world, out);
        for (unsigned i = node->mNumChildren; i-- > 0;) stack.push_back({node->mChildren[i], to_world});
    }
    if (kind == AssimpKind::fbx)
        state_fbx(*scene, out);
    else if (kind != AssimpKind::obj)
        out.unit = 1;
    return out;
}

std::string packed(const AssimpMesh& mesh) {
    const std::uint64_t counts[2] = {mesh.vertex.size(), mesh.triangle.size()};
    std::string bytes;
    add(bytes, counts, 2);
    add(bytes, mesh.axes.data(), 9);
    add(bytes, &mesh.unit, 1);
    for (const Vec3& p : mesh.vertex) add(bytes, p.data(), 3);
    add(bytes, mesh.triangle.data(), mesh.triangle.size());
    return bytes;
}

AssimpMesh unpacked(const std::string& bytes) {
    AssimpMesh mesh;
    std::uint64_t counts[2];
    std::size_t from = 0;
    take(bytes, from, counts, 2);
    take(bytes, from, mesh.axes.data(), 9);
    take(bytes, from, &mesh.unit, 1);
    mesh.vertex.resize(counts[0]);
    for (Vec3& p : mesh.vertex) take(bytes, from, p.data(), 3);
    mesh.triangle.resize(counts[1]);
    take(bytes, from, mesh.triangle.data(), mesh.triangle.size());
    return mesh;
}

} // namespace bough
