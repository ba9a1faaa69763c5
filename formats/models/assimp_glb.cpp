#include "assimp_scene.h"
#include "assimp_skin.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include "model_collada.h"
#include "reader_limits.h"
#include "user_model.h"
#include <algorithm>
#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <set>
#include <stdexcept>

namespace bough {
namespace {

aiMatrix4x4 in_root(const aiNode* node) {
    aiMatrix4x4 m;
    for (; node->mParent; node = node->mParent) m = node->mTransformation * m;
    return m;
}

const aiNode* node_with(const aiNode* root, unsigned mesh) {
    std::vector<const aiNode*> stack{root};
    while (!stack.empty()) {
        const aiNode* node = stack.back();
        stack.pop_back();
        if (std::find(node->mMeshes, node->mMeshes + node->mNumMeshes, mesh) != node->mMeshes + node->mNumMeshes)
            return node;
        stack.insert(stack.end(), node->mChildren, node->mChildren + node->mNumChildren);
    }
    return nullptr;
}

template <class T> void append(T**& list, unsigned& count, T* item) {
    T** longer = new T*[count + 1];
    std::copy(list, list + count, longer);
    longer[count++] = item;
    delete[] list;
    list = longer;
}

// The node that a mesh's bones hang on.
aiNode* above_bones(aiScene& scene, const aiMesh& mesh) {
    std::set<std::string_view> names;
    for (unsigned b = 0; b < mesh.mNumBones; ++b) names.insert(mesh.mBones[b]->mName.C_Str());
    aiNode* node = scene.mRootNode->FindNode(mesh.mBones[0]->mName);
    while (node && names.contains(node->mName.C_Str())) node = node->mParent;
    return node ? node : scene.mRootNode;
}

// assimp finds a skin's bones by name (COLLADA: by sid): of two armatures with the same names it would move one twice.
void refuse_names_used_twice(const aiScene& scene, std::string_view content, AssimpKind kind, const std::string& file) {
    const auto collada =
        kind == AssimpKind::dae ? collada_joints(content) : std::unordered_map<std::string, ColladaJoint>();
    const auto skin_name = [&](const aiString& name) {
        const auto found = collada.find(name.C_Str());
        return found == collada.end() || found->second.sid.empty() ? std::string(name.C_Str()) : found->second.sid;
    };
    std::set<std::string> bones, seen;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m)
        for (unsigned b = 0; b < scene.mMeshes[m]->mNumBones; ++b)
            bones.insert(skin_name(scene.mMeshes[m]->mBones[b]->mName));
    std::vector<const aiNode*> stack{scene.mRootNode};
    while (!stack.empty()) {
        const aiNode* node = stack.back();
        stack.pop_back();
        const std::string name = skin_name(node->mName);
        if (bones.contains(name) && !seen.insert(name).second)
            throw InputError(file, "two of its nodes are called " + in_ascii_quotes(name) +
                                       ", as a skin's bone is; give the bones of each armature names of their own, or "
                                       "export glTF");
        stack.insert(stack.end(), node->mChildren, node->mChildren + node->mNumChildren);
    }
}

// Vertices of a skinned mesh that no bone moves stand still where their mesh stands; glTF wants a bone for them, too.
void hold_unweighted(aiScene& scene) {
    constexpr const char* name = "neutral_bone";
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        aiMesh& mesh = *scene.mMeshes[m];
        if (mesh.mNumBones == 0) continue;
        std::vector<char> weighted(mesh.mNumVertices, false);
        for (unsigned b = 0; b < mesh.mNumBones; ++b)
            for (unsigned k = 0; k < mesh.mBones[b]->mNumWeights; ++k) {
                const aiVertexWeight& w = mesh.mBones[b]->mWeights[k];
                if (w.mVertexId >= mesh.mNumVertices)
                    throw std::runtime_error("a skin names a vertex that is not there");
                if (w.mWeight > 0) weighted[w.mVertexId] = true;
            }
        std::vector<aiVertexWeight> held;
        for (unsigned v = 0; v < mesh.mNumVertices; ++v)
            if (!weighted[v]) held.emplace_back(v, 1.0f);
        const aiNode* const node = node_with(scene.mRootNode, m);
        if (held.empty() || !node) continue;
        aiNode* const armature = above_bones(scene, mesh);
        if (!scene.mRootNode->FindNode(name)) {
            auto* still = new aiNode(name);
            still->mParent = armature;
            append(armature->mChildren, armature->mNumChildren, still);
        }
        auto* bone = new aiBone;
        bone->mName = name;
        bone->mOffsetMatrix = in_root(scene.mRootNode->FindNode(name)).Inverse() * in_root(node);
        bone->mNumWeights = static_cast<unsigned>(held.size());
        bone->mWeights = new aiVertexWeight[held.size()];
        std::copy(held.begin(), held.end(), bone->mWeights);
        append(mesh.mBones, mesh.mNumBones, bone);
    }
}

constexpr const char* moves_lines = "its bones move lines, no mesh of faces; give the curves a thickness (a bevel) and "
                                    "make a mesh of them before it is "
                                    "exported";
constexpr const char* moves_nothing = "its bones move no mesh of faces, expected a skinned mesh";

// assimp writes a line as a triangle with a corner at the origin: what is no face is left out.
void keep_faces(aiScene& scene, const std::string& file) {
    std::vector<int> place(scene.mNumMeshes, -1);
    unsigned kept = 0;
    bool skinned = false, lines = false;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        aiMesh* mesh = scene.mMeshes[m];
        if (mesh->mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON)) {
            skinned = skinned || mesh->mNumBones > 0;
            place[m] = static_cast<int>(kept);
            scene.mMeshes[kept++] = mesh;
        } else {
            lines = lines || (mesh->mNumBones > 0 && mesh->mPrimitiveTypes & aiPrimitiveType_LINE);
            delete mesh;
        }
    }
    scene.mNumMeshes = kept;
    if (!skinned) throw InputError(file, lines ? moves_lines : moves_nothing);
    std::vector<aiNode*> stack{scene.mRootNode};
    while (!stack.empty()) {
        aiNode* node = stack.back();
        stack.pop_back();
        unsigned count = 0;
        for (unsigned i = 0; i < node->mNumMeshes; ++i)
            if (const int m = place[node->mMeshes[i]]; m >= 0) node->mMeshes[count++] = static_cast<unsigned>(m);
        node->mNumMeshes = count;
        stack.insert(stack.end(), node->mChildren, node->mChildren + node->mNumChildren);
    }
}

std::string convert(std::string_view content, AssimpKind kind, const std::string& file) {
    Assimp::Importer importer;
    load_by_assimp(importer, content, kind, false);
    const aiScene* scene = importer.ApplyPostProcessing(aiProcess_JoinIdenticalVertices | aiProcess_LimitBoneWeights |
                                                        aiProcess_SortByPType);
    if (!scene) throw std::runtime_error(importer.GetErrorString());
    // The importer's own scene is changed: a copy would be a second one in memory.
    keep_faces(const_cast<aiScene&>(*scene), file);
    hold_unweighted(const_cast<aiScene&>(*scene));
    refuse_names_used_twice(*scene, content, kind, file);
    const ModelFrame frame = stated_frame(*scene, kind);
    aiMatrix4x4& root = scene->mRootNode->mTransformation;
    aiMatrix4x4 to_metres;
    for (unsigned r = 0; r < 3; ++r)
        for (unsigned c = 0; c < 3; ++c)
            to_metres[r][c] = static_cast<ai_real>((frame.unit > 0 ? frame.unit : 1) * frame.axes(r, c));
    root = to_metres * root;
    const std::vector<TakenSkin> skins = take_skins(const_cast<aiScene&>(*scene));
    // What this says of joined vertices would have the exporter take them apart, and not join them again.
    const_cast<aiScene*>(scene)->mFlags &= ~unsigned(AI_SCENE_FLAGS_NON_VERBOSE_FORMAT);
    Assimp::Exporter exporter;
    const aiExportDataBlob* blob = exporter.ExportToBlob(scene, "glb2", 0u);
    if (!blob) throw std::runtime_error(exporter.GetErrorString());
    return with_skins({static_cast<const char*>(blob->data), blob->size}, skins, file);
}

} // namespace

std::string not_turned(const std::string& why) {
    const bool said = !why.empty() && why != unnamed_failure;
    return std::string("assimp could not turn it into glTF") +
           (said ? ": " + valid_utf8(why) : ", and does not say why") +
           "; export glTF (.glb) from the program that wrote it, which is taken as it is";
}

std::string glb_by_assimp(std::string_view content, AssimpKind kind, const ImportOptions& options) {
    const ChildResult child =
        run_forked([&] { return convert(content, kind, options.name); }, reader_limits(content.size()));
    if (child.failure.empty()) return child.bytes;
    const std::string own = options.name + ": "; // of an InputError in the child
    for (const char* none : {moves_lines, moves_nothing})
        if (child.failure == own + none) throw NoSkinnedMesh(options.name, none);
    if (child.failure.starts_with(own)) throw InputError(options.name, child.failure.substr(own.size()));
    if (child.limited) throw LimitError(options.name, not_turned(child.failure));
    throw InputError(options.name, not_turned(child.failure));
}

} // namespace bough
