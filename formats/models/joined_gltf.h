// joined_gltf.h: glTF documents of several trees as one (private to this folder, and to tools' sinks by driven_forest.h).
//
// What a document's lists name of each other is followed as gltf_references.h says. Of a scene other than the default one nothing is drawn, and the
// joined document has none.
#pragma once
#include "gltf_document.h"
#include "lib/base/math.h"

namespace bough {

// Where the document's default scene stands, each time it is drawn.
struct GltfStand {
    std::string name; // of the node that places it
    Vec3 position = Vec3::Zero();
    double yaw = 0; // [rad] about +Y
};

// Draws the default scene once for each stand: nodes, skins and the animations that are there are copied, all else is shared. Node i of the document
// is node i + k n of stand k, n the nodes that there were. What is at the scene's top hangs on the stand's node, but for skinned meshes without
// children: their joints place them. O(stands * JSON of nodes, skins and animations). Throws std::out_of_range, Json exceptions.
void draw_at(GltfDocument&, const std::vector<GltfStand>&);

// Throws InputError (place `name`) for an extension that may name what joining moves, and is not known. Json exceptions.
void require_joinable(const GltfDocument&, const std::string& name);

// Puts `more` behind what `to` holds; its default scene becomes part of the other's. Its copyright is added to the other's, and its extras are kept
// by its name.
// O(JSON + bytes of more). Throws as require_joinable does; std::out_of_range.
void join(GltfDocument& to, GltfDocument&& more, const std::string& name);

// A document that draws nothing. generator, source: of its asset; source is left out when empty.
GltfDocument empty_gltf(const std::string& generator, const std::string& source);

} // namespace bough
