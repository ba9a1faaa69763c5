// model_gltf.h: a glTF document cut down to what an armature is read from (private to formats/).
#pragma once
#include "gltf_document.h"
#include "own_rods.h"

namespace bough {

struct GltfJoints {
    std::vector<char> joint;       // of each node: whether a skin names it
    std::vector<std::string> name; // of each node: its own
    OwnRods own;                   // what our own files say of them
    bool any = false;
    bool mesh_encoded = false;
    std::size_t other_scenes = 0; // beside the default one, which is what is read
};

// Leaves nodes, meshes, skins and their arrays; names each node "#" and its index, because assimp knows joints by name
// and names need not differ. Meshes in a form that assimp does not decode (Draco, meshopt, quantized positions) go too.
// Radii of lines (a custom attribute _RADIUS, or _DIAMETER, _WIDTH, _THICKNESS of twice that, in upper or lower case),
// which assimp does not know, become x of TEXCOORD_0. Indices of lines are looked at, as assimp passes over wrong ones;
// matrices of skins that leave them out become identities, as the format has it. Without scenes all nodes are one.
// Throws Json exceptions for types that are wrong, std::out_of_range for indices.
GltfJoints cut_down(GltfDocument&);

} // namespace bough
