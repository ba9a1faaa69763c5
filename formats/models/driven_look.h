// driven_look.h: the materials of a user's glTF as OwnMesh has them, for writers that show its mesh frame by frame.
//
// Of a material come through: its name, its base colour (written linear, shown as sRGB), metalness and roughness, these with their images, the maps
// of normals and occlusion, alphaMode and doubleSided. A map that lies otherwise on the mesh than the base colour's image is left out.
// Names are fit for an .mtl: blanks and control characters become '_', and a name that is taken gets "_2" and so on.
// Images are PNG and JPEG, with the bytes that the file has of them.
#pragma once
#include "formats/exports/own_mesh.h"

namespace bough {

struct GltfDocument;

// Where a material's image takes its colours from: coordinates (u, v) of TEXCOORD_`set`, as at + turn (u, v) (KHR_texture_transform).
struct MapPlace {
    std::size_t set = 0;
    Eigen::Matrix2d turn = Eigen::Matrix2d::Identity(); // and scale
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
};

// Of the base colour's image, else of the map of normals, of roughness, of occlusion, else the first set. material: of the document, -1: none. O(1).
MapPlace map_place_of(const GltfDocument&, std::int32_t material);

// Gives `mesh` a part, without surfaces, for each of these materials of a checked document (gltf_check.h), in order; -1 is one that is grey.
// Parts share images. Notes: images of other kinds than PNG and JPEG, such as the document has not got, maps that are left out, emission, and opacity
// without an image. O(bytes of the images).
// Throws std::out_of_range and Json exceptions for what is no glTF.
void add_looks(const GltfDocument&, const std::vector<std::int32_t>& materials, OwnMesh& mesh,
               std::vector<std::string>& notes);

} // namespace bough
