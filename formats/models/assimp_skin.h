// assimp_skin.h: skins past assimp's exporter, whose time grows with the product of corners and weights: a mesh of 2.7 MB took it half a
// minute (private to this folder).
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

struct aiScene;

namespace bough {

// What the bones of one of the scene's meshes say. Empty: it has none.
struct TakenSkin {
    struct Share {
        std::array<std::uint16_t, 4> bone{};
        std::array<float, 4> weight{};
    };
    std::vector<std::string> bone;             // name of its node
    std::vector<std::array<float, 16>> offset; // inverse bind matrix, columns first
    std::vector<Share> share;                  // of each vertex
};

// Takes the bones out of the scene's meshes, whose vertices get their number and their mesh's as one more set of texture coordinates. A
// vertex has at most four bones. Throws std::runtime_error: more than 65 536 bones or more than six sets of texture coordinates on a mesh that has
// any.
std::vector<TakenSkin> take_skins(aiScene&);

// The scene's .glb with its skins, and without that set. Throws as read_gltf and values_of do, std::runtime_error for a bone that is no node.
std::string with_skins(const std::string& glb, const std::vector<TakenSkin>&, const std::string& name);

} // namespace bough
