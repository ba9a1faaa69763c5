// model_gltf.h: what a glTF document says of joints, and its arrays made ready to be read (private to this folder).
#pragma once
#include "gltf_document.h"
#include "own_rods.h"

namespace bough {

struct GltfJoints {
    std::vector<char> joint;       // of each node: whether a skin names it
    std::vector<std::string> name; // of each node
    OwnRods own;                   // what our own files say of them
    bool mesh_encoded = false;     // a mesh in Draco's form: meshes and skins were left out
    std::size_t other_scenes = 0;  // beside the default one, which is what is read
};

// Decodes what meshoptimizer compressed (meshopt.h), puts in what the file leaves out (gltf_complete.h), leaves meshes out
// of a file that has one in Draco's form, and looks at what stays (gltf_check.h). O(JSON + numbers of the arrays that stay).
// Throws Json exceptions for types that are wrong; std::out_of_range for indices, and as decode_meshopt and check_arrays do.
GltfJoints joints_of(GltfDocument&);

} // namespace bough
