// skin.h: a tree's bodies to one skin mesh (§10): adjacent pieces never disjoint, texture coordinates continuous.
//
// A branch is a closed tube of rings with n corners: a ring at each joint, moved half by each piece, and, where n > 3, one
// at mid-piece, moved by that piece alone; each ring's centre lies on its bodies' axes however they bend. Tubes do not
// twist along the branch. Twigs of three corners have no mid rings: they are most of a tree. A joint bent by a narrows
// its ring by cos(a/2) in the plane of the bend; the tube as a whole loses about (1 - cos^2(a/2)) / 2 of its volume, 3 %
// at 0.5 rad.
// A side branch begins with a collar, a ring on its parent's axis inside the parent's tube and moved by the parent alone,
// then a root ring where it comes out, moved by both, and flares there to up to 1.18 times its radius, which it has one radius further on (where the
// parent is thicker, the first piece long enough and n > 3); so no gap opens whichever way it bends, nor where a branch was
// drawn starting off the parent's axis. An end ring thinner than 1/1000 of the next is drawn as a point.
// Leaves and petals are drawn as kites of their prism's length, width and area, one for each broad face (no petiole);
// a clump as several of them (clump.h); fruit are spheres with a thin stalk from joints outside them; all are moved by their body alone.
// u runs 0..1 around (one seam column doubled), v is the arc length from the branch's joint over the circumference at its
// base (of its thickest ring where that is a point), so that bark is not stretched; v < 0 inside the parent.
// Reads a checked Tree in the drawn pose. O(bodies * sides). Constant topology: only positions and normals move. Every
// vertex is some triangle's.
// Errors  std::length_error beyond 2^31 - 1 vertices.
#pragma once
#include "clump.h"
#include <array>
#include <string>
#include <vector>

namespace bough {

struct SkinOptions {
    // Corners of a ring on the thickest branch, at least 3. Others take sides * sqrt(radius / thickest radius), so that
    // the distance between polygon and circle is about the same everywhere, never below 3.
    int sides = 8;
    bool leaves = true;            // false: no leaves and petals (for programs that get them as instances)
    std::int64_t clump_leaves = 0; // of all clumps together, but one each; 0: clump.h's
};

struct SkinPart {
    std::string name;        // "bark", "leaf", "petal", "fruit": also the material's; parts without triangles: none
    Vec3 color;              // sRGB 0..1
    std::size_t first_index; // into Skin::triangle
    std::size_t index_count; // triangles
};

// Of a leaf or petal: foot, left and right, tip of its upper face, then those of its lower one.
constexpr std::size_t leaf_vertices = 8, leaf_triangles = 4;

struct Skin {
    std::vector<Vec3> position;                        // [m] world, drawn pose
    std::vector<Vec3> normal;                          // unit, world, drawn pose, outward
    std::vector<std::array<float, 2>> texture;         // u, v
    std::vector<std::array<std::int32_t, 4>> joint;    // bodies that move the vertex; unused entries repeat the first
    std::vector<std::array<float, 4>> weight;          // sum 1, unused 0
    std::vector<std::array<std::int32_t, 3>> triangle; // counterclockwise seen from outside
    std::vector<std::int32_t> clump_leaf;              // first vertex of each leaf of the clumps, rising
    std::vector<SkinPart> part;                        // in order, covering `triangle`: bark, leaf, petal, fruit
};

Skin build_skin(const Tree&, const SkinOptions&);

// Linear blend skinning: positions and normals for the bodies' current frames. R_wb, x_w are arrays over bodies (world
// from body, own joint in world). Keeps the drawn inverse frames, so that a frame costs O(bodies + vertices). Keeps a
// reference to the skin, which must outlive it. Each vertex is worked out alone: thread count cannot change the result.
class SkinDeformer {
public:
    SkinDeformer(const Skin&, const Tree&);
    void deform(const std::vector<Mat3>& R_wb, const std::vector<Vec3>& x_w, std::vector<Vec3>& position,
                std::vector<Vec3>& normal) const;

private:
    const Skin& skin_;
    std::vector<Mat3> drawn_R_bw_;
    std::vector<Vec3> drawn_x_w_;
};

} // namespace bough
