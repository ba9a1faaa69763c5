// gltf_prune.h: arrays that a glTF document has no use for any more, once something that named them was taken out
// (private to this folder).
#pragma once
#include "gltf_document.h"

namespace bough {

// Leaves out those of these accessors that nothing names, views that only they had, and bytes that only those views had;
// moves the indices and places of what stays, whose bytes and alignment (to 4) stay as they are. Looked through are
// meshes, skins, animations, images and the extensions that are known to name arrays. Where the document uses an
// extension that may name some and is not known, all of it stays; returned is that extension's name, else "".
// O(JSON + bytes). Throws Json exceptions for types that are wrong, std::out_of_range for indices.
std::string prune(GltfDocument&, const std::vector<std::size_t>& accessors);

} // namespace bough
