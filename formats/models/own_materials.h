// own_materials.h: a SpeedTree file's materials as glTF has them, with the textures that stand beside the file.
//
//   Color      base colour: the texture, else the colour (sRGB, written linear)
//   Opacity    the base colour's alpha, MASK at 0.5, double-sided; where it is a map of its own, both become one image at the colour's size:
//              its alpha where it has any, else its red. A colour map with an alpha of its own does without one
//   Normal     normal map, as it is
//   Gloss      roughness 1 - gloss; a map becomes the green channel of a new image
//   AO         occlusion, as it is
// TwoSided becomes doubleSided; nothing is metallic. Other maps (Specular, Height, subsurface, Custom) have no place in core glTF: those
// that name a file are named in a note. A texture that is not found is named once, with where it was looked for; its material keeps its
// colour or number. O(pixels).
#pragma once
#include "formats/exports/own_mesh.h"
#include "formats/imports/import.h"
#include "formats/imports/speedtree_mesh.h"

namespace bough {

// Gives `mesh` a material for each of the file, in order, and one more for what names none. `name`, `folder`: of the file, in messages,
// and where its textures stand ("": nowhere). Throws InputError for a texture that is no image.
void add_materials(const speedtree::MeshFile&, const std::string& name, const std::string& folder, OwnMesh& mesh,
                   ImportNotes&);

// The colour of a material, sRGB.
Vec3 color_of(const speedtree::MeshMaterial&);

} // namespace bough
