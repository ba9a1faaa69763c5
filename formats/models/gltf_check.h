// gltf_check.h: the arrays of a glTF document's meshes and skins, looked at before they are read (private to this folder).
#pragma once
#include "gltf_document.h"

namespace bough {

// What must hold of meshes, skins, and the nodes that name them:
// - a mesh has a primitive or more;
// - POSITION is VEC3 of floats, or of any numbers where the file uses KHR_mesh_quantization: of one vertex or more, finite; indices are SCALAR of
//   unsigned bytes, shorts or ints and name vertices that are there;
// - JOINTS_0 and WEIGHTS_0, and so those of each other set, come together, are VEC4 (unsigned bytes or shorts; floats or
//   normalized unsigned bytes or shorts), one for each vertex;
// - floats in these and in all other attributes of triangles, those of morph targets among them, are finite, one for each vertex;
// - a skin has a MAT4 of floats for each joint, where it has matrices;
// - a node's mesh and skin are there, and no vertex is moved by a joint that its skin does not have. (One that is named
//   with a weight of 0 moves nothing and may be any.)
// Primitives without POSITION are passed over, as nothing is drawn of them. O(numbers in these arrays).
// Throws std::out_of_range for what does not hold, with its place ("mesh 0, primitive 1: JOINTS_0 ...") and what was
// expected, and as count_of and values_of do (gltf_accessor.h).
void check_arrays(const GltfDocument&);

// Materials, textures and images that are named are there, and images that call themselves PNG or JPEG are of one of the known kinds
// (image_type): in the binary chunk or a data: URI. O(JSON). Throws as above, as bytes_of_uri (gltf_uri.h) does, and Json exceptions.
void check_materials(const GltfDocument&);

} // namespace bough
