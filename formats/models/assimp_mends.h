// assimp_mends.h: what assimp's writer of glTF gets wrong, put right (private to this folder).
#pragma once
#include "gltf_document.h"

namespace bough {

// An embedded image whose type is the ending of its file or folder ("image/fbm") gets that of its bytes (image_type), where those
// are known. A mesh whose morph targets have as many vertices as it had before corners were split comes without them, with a note.
// Reads and writes a document that read_gltf has checked. O(images + primitives). Throws nlohmann::json::exception for a mesh
// that names no POSITION or an accessor that is not there.
void mend_assimp(GltfDocument&, ImportNotes&);

} // namespace bough
