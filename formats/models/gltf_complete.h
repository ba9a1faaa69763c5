// gltf_complete.h: what a glTF 2.0 file may leave out or say in several ways, put into the document (private to this
// folder).
#pragma once
#include "gltf_document.h"

namespace bough {

// A file may leave its scenes out: then all its nodes that are no node's children make one. Reads and writes the list
// "nodes", which must be there, "scenes" and "scene". O(nodes). Throws std::out_of_range for a child that is no node, Json
// exceptions for types that are wrong.
void add_missing_scene(nlohmann::ordered_json& document);

// A skin may leave its matrices out, which then are identities. Appends them to the document
// of the skins that do. O(joints). Throws Json exceptions for types that are wrong.
void add_missing_matrices(GltfDocument&);

} // namespace bough
