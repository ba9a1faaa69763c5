#include "assimp_skin.h"
#include "gltf_accessor.h"
#include "gltf_prune.h"
#include <assimp/scene.h>
#include <map>
#include <stdexcept>
#include <unordered_map>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;
constexpr unsigned low = 1u << 20; // a number in two parts, each exact as a float

TakenSkin skin_of(const aiMesh& mesh) {
    TakenSkin skin;
    if (mesh.mNumBones > 65536) throw std::runtime_error("a mesh is moved by more than 65536 bones");
    skin.share.resize(mesh.mNumVertices);
    std::vector<std::uint8_t> count(mesh.mNumVertices, 0);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
        const aiBone& bone = *mesh.mBones[b];
        skin.bone.emplace_back(bone.mName.C_Str());
        std::array<float, 16> columns;
        for (unsigned k = 0; k < 16; ++k) columns[k] = bone.mOffsetMatrix[k % 4][k / 4];
        skin.offset.push_back(columns);
        for (unsigned k = 0; k < bone.mNumWeights; ++k) {
            const unsigned v = bone.mWeights[k].mVertexId;
            if (v >= mesh.mNumVertices) throw std::runtime_error("a skin names a vertex that is not there");
            if (!(bone.mWeights[k].mWeight > 0) || count[v] == 4) continue;
            skin.share[v].bone[count[v]] = static_cast<std::uint16_t>(b);
            skin.share[v].weight[count[v]++] = bone.mWeights[k].mWeight;
        }
    }
    for (TakenSkin::Share& share : skin.share) {
        float sum = 0;
        for (const float w : share.weight) sum += w;
        for (float& w : share.weight)
            if (sum > 0) w /= sum;
    }
    return skin;
}

// The set of texture coordinates that holds vertices' numbers: the last.
std::string numbered_set(const Json& attributes) {
    std::string name;
    for (int k = 0; attributes.contains("TEXCOORD_" + std::to_string(k)); ++k) name = "TEXCOORD_" + std::to_string(k);
    return name;
}

// Joints of one mesh of the document, which may be several of the scene's.
struct Joints {
    std::vector<std::size_t> node;
    std::vector<float> matrices;
    std::map<std::string, std::size_t> of_bone;
};

class Skinned {
public:
    Skinned(GltfDocument& document, const std::vector<TakenSkin>& skins) : document_(document), skins_(skins) {
        const Json& nodes = document_.json["nodes"];
        for (std::size_t i = 0; i < nodes.size(); ++i) node_of_.try_emplace(nodes[i].value("name", std::string()), i);
    }

    void add() {
        for (std::size_t m = 0; m < entries_of(document_.json, "meshes"); ++m) {
            Joints joints;
            const std::size_t primitives = document_.json["meshes"][m].at("primitives").size();
            for (std::size_t p = 0; p < primitives; ++p) add_to(m, p, joints);
            if (joints.node.empty()) continue;
            Json skin{{"inverseBindMatrices", add_floats(document_, joints.matrices, "MAT4", false)},
                      {"joints", joints.node}};
            Json& list = document_.json["skins"];
            if (!list.is_array()) list = Json::array();
            list.push_back(std::move(skin));
            for (Json& node : document_.json["nodes"])
                if (node.contains("mesh") && node["mesh"] == m) node["skin"] = list.size() - 1;
        }
        prune(document_, gone_);
    }

private:
    std::size_t joint_of(const TakenSkin& skin, std::size_t bone, Joints& joints) {
        const auto [at, fresh] = joints.of_bone.try_emplace(skin.bone[bone], joints.node.size());
        if (!fresh) return at->second;
        const auto node = node_of_.find(skin.bone[bone]);
        if (node == node_of_.end()) throw std::runtime_error("a skin names a joint that is no node");
        joints.node.push_back(node->second);
        joints.matrices.insert(joints.matrices.end(), skin.offset[bone].begin(), skin.offset[bone].end());
        return at->second;
    }

    void add_to(std::size_t mesh, std::size_t number, Joints& joints) {
        const auto attributes = [&]() -> Json& {
            return document_.json["meshes"][mesh]["primitives"][number].at("attributes");
        };
        const std::string set = numbered_set(attributes()), place = primitive_place(mesh, number);
        if (set.empty()) return;
        const std::size_t accessor =
            index_of(attributes(), set.c_str(), place, entries_of(document_.json, "accessors"));
        if (document_.json["accessors"][accessor].at("type") != "VEC3") return; // a mesh without bones
        const std::vector<double> numbers =
            values_of(document_, attributes()[set], {place + ": " + set, "VEC3", GltfNumbers::floats});
        std::vector<std::uint16_t> joint;
        std::vector<float> weight;
        for (std::size_t k = 0; k + 2 < numbers.size(); k += 3) {
            const TakenSkin& skin = skins_.at(static_cast<std::size_t>(numbers[k + 2]));
            // (The exporter turns the second one over.)
            const auto vertex =
                static_cast<std::size_t>(numbers[k]) + low * static_cast<std::size_t>(1 - numbers[k + 1]);
            const TakenSkin::Share& share = skin.share.at(vertex);
            for (std::size_t j = 0; j < 4; ++j) {
                joint.push_back(share.weight[j] > 0 ? static_cast<std::uint16_t>(joint_of(skin, share.bone[j], joints))
                                                    : std::uint16_t(0));
                weight.push_back(share.weight[j]);
            }
        }
        attributes().erase(set);
        gone_.push_back(accessor);
        const std::size_t of_joints = add_shorts(document_, joint, "VEC4"),
                          of_weights = add_floats(document_, weight, "VEC4", false);
        attributes()["JOINTS_0"] = of_joints;
        attributes()["WEIGHTS_0"] = of_weights;
    }

    GltfDocument& document_;
    const std::vector<TakenSkin>& skins_;
    std::unordered_map<std::string, std::size_t> node_of_;
    std::vector<std::size_t> gone_; // accessors
};

} // namespace

std::vector<TakenSkin> take_skins(aiScene& scene) {
    std::vector<TakenSkin> skins(scene.mNumMeshes);
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        aiMesh& mesh = *scene.mMeshes[m];
        if (mesh.mNumBones == 0) continue;
        skins[m] = skin_of(mesh);
        for (unsigned b = 0; b < mesh.mNumBones; ++b) delete mesh.mBones[b];
        delete[] mesh.mBones;
        mesh.mBones = nullptr;
        mesh.mNumBones = 0;
        const unsigned set = mesh.GetNumUVChannels();
        if (set + 1 >= AI_MAX_NUMBER_OF_TEXTURECOORDS)
            throw std::runtime_error("a mesh has more than six sets of texture coordinates");
        mesh.mTextureCoords[set] = new aiVector3D[mesh.mNumVertices];
        mesh.mNumUVComponents[set] = 3;
        for (unsigned v = 0; v < mesh.mNumVertices; ++v)
            mesh.mTextureCoords[set][v] = {static_cast<ai_real>(v % low), static_cast<ai_real>(v / low),
                                           static_cast<ai_real>(m)};
    }
    return skins;
}

std::string with_skins(const std::string& glb, const std::vector<TakenSkin>& skins, const std::string& name) {
    ImportNotes none;
    GltfDocument document = read_gltf(glb, name, "", GltfImages::leave, none);
    Skinned(document, skins).add();
    return glb_of(document, name);
}

} // namespace bough
