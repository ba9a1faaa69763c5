// bark.h: how thick the wood of bones is, by the surface around them.
//
// A ring. The plane across a bone at a place on its axis cuts the triangles that the bone moves; those that hang together by cut edges are
// one cut: the bark's, and one for each twig, leaf or collar that the plane meets. The corners of a cut's triangles before and beyond the
// plane are two rings of vertices, on whose circles (least squares, seen along the way from one ring's middle to the other's) the
// surface lies; radius and centre are those between them at the plane. One corner alone is a tube's point. No circle: corners all
// on one side of it, off it by more than 0.3 of its radius (root mean square), or more than 2.6 times as wide one way as the other, as those of
// a fork, a card or a twig cut lengthwise are.
// Of the cuts whose circle is not twice as far from the axis as it is thick the thickest is the bark: no twig is thicker than what it grows on.
#pragma once
#include "speedtree_xml.h"
#include <array>

namespace bough {

struct BarkSurface {
    std::vector<Vec3> point; // corners in one place are one
    std::vector<std::array<std::int32_t, 3>> triangle;
    std::vector<std::int32_t> bone; // of each point: which moves it most; -1: none
};

struct BarkRing {
    double radius = 0;
    Vec3 center = Vec3::Zero();
    std::int32_t piece = -1; // of the surface, connected, that it is on
    bool square = false;     // four corners before and four beyond, no two farther apart than 100 degrees
};

class Bark {
public:
    // O(n log n) of points and triangles. Indices must be within their lists.
    Bark(BarkSurface, std::size_t bones);

    // `across`: unit. No ring: radius 0. O(triangles of the bone).
    BarkRing ring(std::int32_t bone, const Vec3& place, const Vec3& across) const;

    // How far those points of a piece that the bone moves reach along a direction from a place that stand within a cone around
    // it: no farther off than `within` and a third of the way. 0: none. O(triangles of the bone).
    double reach(std::int32_t bone, std::int32_t piece, const Vec3& place, const Vec3& direction, double within) const;

    const BarkSurface& surface() const { return surface_; } // triangles name one point of those in one place
    std::int32_t piece(std::int32_t point) const { return piece_[point]; }

private:
    BarkSurface surface_;
    std::vector<std::int32_t> first_,
        of_bone_;                     // triangles of bone b: of_bone_[first_[b]] to before of_bone_[first_[b + 1]]
    std::vector<std::int32_t> piece_; // of each point
};

// A bone's radii where it starts and ends: the line through its rings at 0.1, 0.3 ... 0.9 of its length whose slope is the
// median of those between any two (Theil and Sen), at least a tenth of their median. 0: no ring.
struct BarkTaper {
    double start = 0, end = 0;
    int rings = 0, square = 0;        // how many there are, and of them square ones
    std::vector<std::int32_t> pieces; // that they are on
};
std::vector<BarkTaper> bark_tapers(const Bark&, const std::vector<speedtree::Bone>&);

} // namespace bough
