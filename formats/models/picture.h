// picture.h: pictures of our own making for a tree's materials, from its species' forms: leaves with veins, bark that tiles. The same numbers give
// the same pixels on any machine that rounds as IEEE 754 has it.
#pragma once
#include "lib/base/math.h"
#include "lib/growth/bark_form.h"
#include "lib/growth/leaf_form.h"
#include <cstdint>
#include <vector>

namespace bough {

struct Picture {
    int size = 0, channels = 3;
    std::vector<std::uint8_t> pixel; // rows from the top down
};

// Four squares (blade.h): a leaf from above, from below, two sprays. RGBA: alpha is what a leaf covers; colours go on beyond its edge. sRGB
// of leaf and of bark, for the twig. size: of all four, 64 and more. O(pixels).
Picture leaf_picture(const LeafForm&, double width, const Vec3& leaf, const Vec3& bark, int size);

// [1] The alpha above which such a picture is to be shown, so that from afar, where programs show the mean of many pixels, sprays cover as much as
// from near: that of a tenth of a square's side which as large a share of them exceeds as the leaves cover. 0.03 to 0.5. O(pixels).
double alpha_cutoff(const Picture& leaves);

// What bark is a stem's width around (u) and as far along it (v) again tiles in both: its colour, and the normals of its relief in the axes of glTF
// (x along u, y along v, up in the image), half as many a side from 512 on, as they are smoother and larger.
struct BarkPictures {
    Picture color, normal;
};
BarkPictures bark_pictures(const BarkForm&, const Vec3& bark, int size);

} // namespace bough
