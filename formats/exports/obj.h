// obj.h: a skin mesh as Wavefront OBJ, at rest or as a numbered sequence with one mtl.
#pragma once
#include "formats/open.h"
#include "lib/growth/skin.h"
#include "sequence.h"
#include <string>
#include <vector>

namespace bough {

// The mesh with the given positions and normals (arrays over the skin's vertices) and a mtllib line naming `mtl`, the
// file's name as seen from the OBJ's folder. Vertex k of the skin is v, vt and vn k + 1; a group and material a part, all one
// object, so that programs make one mesh of it, with the vertices in this order (what point caches and sequences need).
// Coordinates are the shortest decimals that give the same float (double where the mesh lies so far from the origin that
// a float is coarser than 1e-6 of its size), normals have 4 decimals; the locale does not matter. O(vertices + triangles).
// Throws OutputError.
void write_obj(Output&, const Skin&, const std::vector<Vec3>& position, const std::vector<Vec3>& normal,
               const std::string& mtl);

// The images of a part's material, by their names from the folder of the .mtl; "" where there is none.
struct MtlMaps {
    std::string color, normal;
    bool cut = false; // what the colour's alpha leaves out is not there
};
// Materials of the skin's parts (bark, leaf, fruit): a diffuse colour each, or, where maps has entries (one a part), white and the images.
void write_mtl(Output&, const Skin&, const std::vector<MtlMaps>& maps = {});

} // namespace bough
