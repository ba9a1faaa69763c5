// meshopt.h: arrays of a glTF document that meshoptimizer's codecs compressed (EXT_meshopt_compression), as plain
// numbers (private to this folder).
#pragma once
#include "gltf_document.h"

namespace bough {

// Puts the decoded bytes of each compressed view behind the binary chunk, has the view name them, and leaves the extension
// out. What a view holds otherwise (a fallback) is no longer named. Does nothing to a document without such views.
// For reading alone: a model that is written again keeps its compressed arrays. O(bytes, decoded).
// Throws std::out_of_range, beginning with the view ("view 3 (EXT_meshopt_compression)"): a mode or filter that the
// extension does not have, elements of a size that they do not allow, a view that is not of that many, bytes that the
// codec does not take or that cannot hold so much; KHR_meshopt_compression, whose codecs are newer. Throws Json exceptions
// for what is missing or of another type.
void decode_meshopt(GltfDocument&);

} // namespace bough
