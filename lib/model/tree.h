// tree.h: a tree as articulated rigid bodies (§3), constant after load. There is one array per quantity, over bodies.
//
// Order. A parent stands before its children (parent[i] < i). So a loop over rising indices is the sweep from the root, and one over falling indices
// the sweep from the leaves. Bodies keep this order in every output. Body i has one joint, to its parent or (parent -1) to the ground, with three
// rotational springs about the joint frame's axes. The body frame has its origin at that joint and z along the branch, the leaf's length or the
// fruit's stalk.
//
// The geometry is the drawn pose: theta = 0 puts every body where it was drawn. The scene's `pose` (pose.h) decides the springs' rest pose: the drawn
// one, or the one that gravity bends into the drawn one.
#pragma once
#include "../base/math.h"
#include "kind.h"
#include "splines.h"
#include <optional>
#include <string>
#include <vector>

namespace bough {

struct Tree {
    std::vector<std::int32_t> parent; // body index < own, -1: the ground
    std::vector<Kind> kind;
    std::vector<double> mass;         // [kg] > 0
    std::vector<Vec3> com;            // [m] centre of mass, body frame
    std::vector<Mat3> inertia;        // [kg m^2] about the centre of mass, body axes; symmetric, not negative
    std::vector<Vec3> joint_position; // [m] own joint in the parent's body frame (world for roots): d_j^p of (10)
    // Parent's body frame (world for roots) from joint frame, drawn pose: R_j^p of (7)
    std::vector<Quat> joint_rotation;
    // [N m/rad] K about the joint frame's x, y, z: bend, bend, twist (leaf: flap, sway, twist)
    std::vector<Vec3> stiffness;
    std::vector<double> damping; // [s] beta of (5), the stiffness-proportional Rayleigh coefficient
    std::vector<Vec3> size;      // [m] branch: length, base radius, tip radius; leaf, petal: length, width, thickness;
                                 //     fruit: joint to centre, radius, radius
    std::vector<std::int32_t> branch; // branch of the splines that the body belongs to (a leaf or fruit: grows on)
    std::vector<std::int32_t> level;  // that branch's level, 0 for trunks
    std::vector<double> s;            // fraction of that branch's arc length at the body's own joint, 0..1

    // Each of these may be empty: none.
    std::vector<std::uint8_t> rigid; // 1: the body moves as its parent does, its joint holds the drawn pose (reduce.h)
    std::vector<double> load; // [kg] what of the mass lies on the drawn tree and is not carried in its equilibrium
    // How many leaves a leaf or petal body stands for; 1 for other kinds. From 2 on: a clump
    std::vector<std::int32_t> leaf_count;
    std::vector<double> leaf_length,
        leaf_width; // [m] of each leaf of a clump whose size says how far they spread (resolve.h); 0: the size is that of a
                    // blade of all their area
    // [1] 0..1, of a clump: (3 <m_y^2> - 1) / 2, the mean over its leaves, m their normals: 0 facing all ways, 1 all up and down (air.h);
    // not read of other bodies
    std::vector<double> leaf_facing;
    std::vector<double> drag; // [1] the air takes hold of so many times the area of its size; empty: 1 each

    std::string name;        // what the tree is called
    std::string material;    // wood preset or file that gave mass and stiffness
    std::string source;      // command lines that made it, oldest first, one a line
    std::vector<Vec3> color; // as Splines::color

    std::size_t size_bodies() const { return parent.size(); }
    void resize(std::size_t bodies); // every array to this length, values unspecified
};

// True if body i continues its parent's branch (both are pieces of one branch) rather than leaving it.
inline bool continues_parent(const Tree& tree, std::size_t i) {
    const std::int32_t p = tree.parent[i];
    return p >= 0 && tree.kind[i] == Kind::branch && tree.kind[std::size_t(p)] == Kind::branch &&
           tree.branch[i] == tree.branch[std::size_t(p)];
}

// True for a body that stands for several leaves on their twigs. It is porous, where a leaf is a plate (leaf_air.h).
inline bool is_clump(const Tree& tree, std::size_t i) {
    return !tree.leaf_count.empty() && tree.leaf_count[i] > 1;
}

// [1] Width over length of a leaf or petal, or of each that a clump stands for; of a clump that does not say, its own.
inline double leaf_proportion(const Tree& tree, std::size_t i) {
    if (!is_clump(tree, i) || tree.leaf_length.empty() || !(tree.leaf_length[i] > 0))
        return tree.size[i][1] / tree.size[i][0];
    return tree.leaf_width[i] / tree.leaf_length[i];
}

// Returns how the air sees several leaves of this width over length: those below a seventh, needles and leaflets of palms, do not
// turn with the wind (air.h).
inline Kind kind_of_many(double proportion) {
    return 7 * proportion < 1 ? Kind::tuft : Kind::clump;
}

// [m^2] Returns one side's area of all the leaves or petals that a flat body stands for: length times width / 2 each.
inline double foliage_area(const Tree& tree, std::size_t i) {
    if (!is_clump(tree, i) || tree.leaf_length.empty() || !(tree.leaf_length[i] > 0))
        return tree.size[i][0] * tree.size[i][1] / 2;
    return tree.leaf_count[i] * tree.leaf_length[i] * tree.leaf_width[i] / 2;
}

// Returns the first broken rule, or none. The rules: at least one body, array lengths equal, parent before child, mass > 0, inertia symmetric and
// positive semidefinite with the triangle inequality (to rounding, 1e-9 of its trace), stiffness and damping >= 0, unit quaternions (1e-6), sizes >=
// 0 with a length > 0, finite numbers, s in 0..1. O(bodies).
std::optional<Defect> check(const Tree&);

} // namespace bough
