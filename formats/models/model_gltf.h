// model_gltf.h: a glTF document cut down to what an armature is read from (private to this folder).
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
// which assimp does not know, become x of TEXCOORD_0. What stays is looked at (gltf_check.h), and what the file leaves out
// is put in (gltf_complete.h). O(JSON + numbers of the arrays that stay).
// Throws Json exceptions for types that are wrong; std::out_of_range for indices, for what check_arrays refuses, and for
// radii that are not one for each vertex.
GltfJoints cut_down(GltfDocument&);

} // namespace bough
