// skin.h: a tree's bodies to one skin mesh (§10): adjacent pieces never disjoint, texture coordinates continuous.
//
// A branch is a tube of rings with `sides` corners: rings at joints and within pieces, twist-free along the branch, each
// vertex bound to up to four bodies, blending between the pieces on either side of a joint; the first ring of a side
// branch lies inside its parent and is bound to both; tips are closed. Leaves are two-sided triangles bound to their
// body alone, fruit are spheres likewise. u runs 0..1 around (one seam column doubled), v is the arc length from the
// branch's base over the base's circumference, so that bark is not stretched.
// Reads a checked Tree in the drawn pose. O(bodies * sides). Constant topology: only positions and normals move.
#pragma once
#include "../model/tree.h"
#include <array>
#include <string>
#include <vector>

namespace bough {

struct SkinOptions {
    int sides = 8;  // corners of a ring on the thickest branch, at least 3; thinner levels take fewer, never below 3
};

struct SkinPart {
    std::string name;         // "bark", "leaf", "fruit": also the material's name
    std::size_t first_index;  // into Skin::index
    std::size_t index_count;
};

struct Skin {
    std::vector<Vec3> position;                       // [m] world, drawn pose
    std::vector<Vec3> normal;                         // unit, world, drawn pose, outward
    std::vector<std::array<float, 2>> texture;        // u, v
    std::vector<std::array<std::int32_t, 4>> joint;   // bodies that move the vertex; unused entries repeat the first
    std::vector<std::array<float, 4>> weight;         // sum 1, unused 0
    std::vector<std::array<std::int32_t, 3>> triangle;  // counterclockwise seen from outside
    std::vector<SkinPart> part;                       // in order, covering `triangle` (first_index, index_count in triangles)
};

Skin build_skin(const Tree&, const SkinOptions&);

// Where each body stands when drawn (theta = 0): R_wb and joint position x_w, one forward sweep of (7) and (10).
void drawn_pose(const Tree&, std::vector<Mat3>& R_wb, std::vector<Vec3>& x_w);

// Linear blend skinning: positions and normals for the bodies' current frames. R_wb, x_w are arrays over bodies (world
// from body, own joint in world). Keeps the drawn inverse frames, so that a frame costs O(vertices).
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
