// skin_attributes.h: what a skin's vertices have beside places and normals.
#pragma once
#include "own_mesh.h"

namespace bough {

struct SkinAttributes {
    std::vector<std::vector<std::array<float, 2>>> uv; // sets, at least one; v from the top of an image down
    std::vector<std::array<float, 4>> color;           // or empty
};

// own: what the skin was made of (skin_of), or its look alone, without surfaces; null: none. O(vertices).
SkinAttributes attributes_of(const Skin&, const OwnMesh* own);

} // namespace bough
