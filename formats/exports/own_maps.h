// own_maps.h: the images of a mesh's materials as files beside an .mtl, which names them.
#pragma once
#include "obj.h"
#include "own_mesh.h"

namespace bough {

struct ImageFile {
    std::string name; // in the folder of the .mtl: NAME_textures/bark.png
    const std::string* bytes;
};

struct OwnMaps {
    std::vector<ImageFile> image; // those that are named, each once; their bytes are the mesh's
    std::vector<MtlMaps> part;    // of each part of the mesh, as write_mtl takes them
};

// Of each material the base colour's image, where it is cut out its alpha (MASK), and the normal map. mtl: the file's name. O(materials).
OwnMaps maps_of(const OwnMesh&, const std::string& mtl);

} // namespace bough
