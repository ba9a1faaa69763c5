// skin_mesh.h: what the builders of a skin share (private to skin*.cpp): appending vertices, and the shapes that
// build_skin puts together. All take the drawn pose R_wb, x_w (arrays over bodies) and append to a Skin.
#pragma once
#include "../model/drawn_pose.h"
#include "skin.h"

namespace bough {

// Which bodies move a vertex: the first with weight 1 - second's.
struct Binding {
    std::int32_t first, second;
    float second_weight = 0;
};

inline Binding bound_to(std::size_t body) {
    return {std::int32_t(body), std::int32_t(body), 0};
}

// Appends one vertex and returns its index. Throws std::length_error beyond 2^31 - 1 vertices.
std::int32_t add_vertex(Skin&, const Vec3& position, const Vec3& normal, double u, double v, const Binding&);

// One branch: its pieces from base to tip.
struct BranchTube {
    std::vector<std::int32_t> piece;
    int sides = 3;            // corners of a ring
    int parent_sides = 0;     // of the tube that it grows on, 0 where it stands alone (ground, leaf, fruit)
    bool parent_base = false; // the parent piece has a free end at its base (it stands on the ground) ...
    bool parent_tip = false;  // ... and at its tip (it is its branch's last)
};

// The closed tube of a branch (skin.h). O(pieces * sides).
void add_tube(Skin&, const Tree&, const DrawnPose&, const BranchTube&);

constexpr std::size_t fruit_columns = 8, fruit_bands = 4;
constexpr std::size_t fruit_vertices = (fruit_columns + 1) * (fruit_bands + 3); // at most: with a stalk
constexpr std::size_t fruit_triangles = 2 * fruit_columns * (fruit_bands + 2);

// The two broad faces of a leaf or petal.
void add_leaf(Skin&, const Tree&, const DrawnPose&, std::size_t body);

// The leaves of a clump, `leaves` of them (clump.h).
void add_clump(Skin&, const Tree&, const DrawnPose&, std::size_t body, std::int32_t leaves);

// A sphere, drawn out to the joint by a thin stalk where the joint lies outside it.
void add_fruit(Skin&, const Tree&, const DrawnPose&, std::size_t body);

} // namespace bough
