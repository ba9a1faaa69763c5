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

// A material as programs have it that know no glTF: numbers, and names of images.
struct OwnLook {
    Vec3 color = Vec3::Ones(); // linear
    double metallic = 1, roughness = 1, cutoff = 0.5;
    bool cut = false, two_sided = false;
    std::string color_map, normal_map, roughness_map,
        occlusion_map; // "": none; roughness is the green of its image, occlusion the red
};

struct OwnLooks {
    std::vector<ImageFile> image;
    std::vector<OwnLook> part;
};

// All that of each part's material; `file`: the file that names the images. O(materials).
OwnLooks looks_of(const OwnMesh&, const std::string& file);
// Of one without images: a glTF material as JSON.
OwnLook look_of(const std::string& material);

// Of each material the base colour's image, where it is cut out its alpha (MASK), and the normal map. mtl: the file's name. O(materials).
OwnMaps maps_of(const OwnMesh&, const std::string& mtl);

} // namespace bough
