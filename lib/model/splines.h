// splines.h: a tree as branches: the document that treegen and the importers make and treeconvert reads.
//
// A branch is a curve of points with radii from its base to its tip. Parents stand before children. The points of branch b are first_point[b] ..
// first_point[b+1]-1. All positions are in the world, in SI units, Y up.
#pragma once
#include "../base/math.h"
#include <optional>
#include <string>
#include <vector>

namespace bough {

struct Splines {
    // Per branch.
    std::vector<std::int32_t> parent;      // branch index, -1: stands on the ground
    std::vector<double> parent_at;         // where on the parent, fraction of its arc length, 0..1 (0 for roots)
    std::vector<std::int32_t> level;       // 0 for trunks, parent's level + 1 or the generator's own count
    std::vector<std::int32_t> first_point; // branches + 1 entries; a branch has at least 2 points

    // Per point.
    std::vector<Vec3> point;    // [m]; a branch's first point is its joint, which may lie off the parent's axis
    std::vector<double> radius; // [m], >= 0

    // Per leaf, needle or petal: a triangle, its base edge (width) centred on the joint, its apex at length along z.
    std::vector<std::int32_t> leaf_branch; // the branch it grows on
    std::vector<double> leaf_at;           // fraction of that branch's arc length
    std::vector<Vec3> leaf_position;       // [m] where it is attached
    std::vector<Quat> leaf_rotation;       // world from leaf: x width, y normal, z length
    std::vector<double> leaf_length;       // [m]
    std::vector<double> leaf_width;        // [m]
    std::vector<std::int32_t> leaf_kind;   // 0 leaf or needle, 1 petal; may be empty: all leaves
    std::vector<std::int32_t> leaf_count;  // how many leaves it stands for, from 2 on a clump; may be empty: not said

    // Per fruit: a sphere hanging from a joint.
    std::vector<std::int32_t> fruit_branch;
    std::vector<double> fruit_at;
    std::vector<Vec3> fruit_position; // [m] its joint
    std::vector<Vec3> fruit_center;   // [m]; differs from the joint
    std::vector<double> fruit_radius; // [m]

    // What a picture shows; empty, or sRGB 0..1 of bark, leaf, petal and fruit.
    std::vector<Vec3> color;

    // How many bodies segment() makes of it unless told otherwise (segment.h); 0: as many as come
    std::int64_t bodies = 0;

    std::string material; // the wood preset (wood.h) that goes with it, "" if nothing is known
    std::string name;     // what the tree is called, e.g. the species or the file
    std::string source;   // how it was made: the command line or the imported file's own statement

    std::size_t branches() const { return parent.size(); }
    std::size_t points() const { return point.size(); }
    std::size_t leaves() const { return leaf_branch.size(); }
    std::size_t fruits() const { return fruit_branch.size(); }
    bool is_petal(std::size_t leaf) const { return !leaf_kind.empty() && leaf_kind[leaf] == 1; }
};

// A broken rule of a document held in memory: which array, which entry, what is wrong and what was expected.
struct Defect {
    std::string field;   // e.g. "parent"
    std::int64_t index;  // entry of it, -1 for the array as a whole
    std::string message; // e.g. "is 7, expected -1 or less than 3 (parents stand before children)"
};

// The colours that are drawn where a document names none, in the order of Splines::color.
inline const std::vector<Vec3>& default_colors() {
    static const std::vector<Vec3> colors = {
        {0.45, 0.34, 0.25}, {0.34, 0.56, 0.16}, {0.98, 0.86, 0.89}, {0.8, 0.14, 0.1}};
    return colors;
}

// Returns the first broken rule of the splines, or none. The rules: at least one branch, array lengths, parents before children, indices in range,
// fractions in 0..1, at least two points a branch, finite numbers, radii >= 0, unit quaternions (1e-6), sizes > 0, a fruit's centre off its joint,
// colours in 0..1. O(points).
std::optional<Defect> check(const Splines&);

} // namespace bough
