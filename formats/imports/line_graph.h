// line_graph.h: a tree given as points and the lines between them, in any order and direction: line meshes, graphs of
// laser scans. Made into branches that stand on the ground.
#pragma once
#include "imported_tree.h"
#include <array>

namespace bough {

struct LineGraph {
    std::vector<Vec3> point;                       // [file unit]
    std::vector<double> radius;                    // [file unit] one a point, or empty; <= 0: unknown
    std::vector<std::array<std::int32_t, 2>> edge; // indices of points
};

struct RootedLines {
    std::vector<ImportedBranch> branches; // a radius <= 0 is still unknown: pipe_rule.h
    char up = 0;                          // 'y' or 'z': as given, else as guessed
};

// Points at one place become one (within 1e-6 of the size, or what a float can tell apart so far from the origin), the
// thickest's radius counts; lines between the same points become one; lines that close circles are cut, the thinnest
// first, of equally thick ones the longest; points without a line are left out. Which parts stand on the ground, where
// they begin and where the others are joined: attach.h; a joined part keeps its place. Where a joint lies between two points, a point is put
// there. Branches are grouped as in skeleton.h.
// `up` is 'y', 'z' or 0 for a guess (up_axis.h). Notes count all of it. O(n log n), no recursion.
// Throws InputError (place `name`) where no line has a length; a line's points must exist.
RootedLines root_lines(LineGraph&&, char up, const std::string& name, ImportNotes&);

// The same as a tree, unknown radii by the pipe rule.
ImportedTree tree_of_lines(LineGraph&&, char up, const std::string& name, ImportNotes&);

} // namespace bough
