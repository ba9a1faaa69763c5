// blade.h: a leaf as a surface, made of its outline: what is drawn at each leaf's place.
//
// In a leaf's own axes: x across, y the upper face's normal, z from the foot to the tip; its length is 1. Folded along the midrib and
// curled downward. Texture coordinates run over the squares of a leaf picture (picture_*), v from the top of an image.
#pragma once
#include "leaf_form.h"
#include <array>
#include <cstdint>

namespace bough {

struct Blade {
    std::vector<Vec3> position, normal;
    std::vector<std::array<float, 2>> uv;
    std::vector<std::array<std::int32_t, 3>> triangle;
    double area = 0; // [1] of the leaf that it shows, laid flat: of one face
};

// The picture of a species' leaves is four squares: a leaf's upper face at the top left, its lower one at the top right, a spray and
// another, which mirrors it, below them. In a square a leaf is as long as picture_share of its side, its foot in the middle of the lower
// edge, and as wide: a leaf of picture_width [1] of its length across. Both sides of a spray look alike.
constexpr double picture_share = 0.96;
double picture_width(const LeafForm&, double width);

// Of each outline's point a corner, on both faces. O(points^2).
Blade blade_mesh(const LeafForm&, double width);
// A rectangle around the leaf, both faces, 8 corners.
Blade blade_card(const LeafForm&, double width);
// A rectangle around a spray of leaves whose blades have this width over length: 4 corners, one face; z 1 is the spray's length.
Blade spray_card(const LeafForm&, double width, bool mirrored = false);

} // namespace bough
