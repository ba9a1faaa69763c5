// imported_tree.h: what a reader of a foreign format finds, in the file's own unit and axes, and the steps that all
// readers share to make Splines of it: order, unit, up axis, hosts of leaves.
#pragma once
#include "import.h"
#include "imported_parts.h"
#include "on_polyline.h"

namespace bough {

struct ImportedTree {
    std::vector<ImportedBranch> branches;
    std::vector<ImportedLeaf> leaves;
    std::string name, source;
    std::optional<double> unit; // [m] if the file or its format states one
    char up = 0;                // 'y' or 'z' if the file or its format states it
};

// Splines in metres and Y up. The unit is the option's, else the file's, else a guess from the height; the up axis the
// option's, else the file's, else the one that the trunks follow; guesses go into the notes with their reason.
// Branches are put parents first, otherwise in file order; level is the depth. Points that repeat their predecessor
// are left out with a note, and so is a branch without any length; what it carried goes to its parent. A tree far from
// the origin is moved there, and an absurd size named (placed_import.h).
// A leaf whose mesh is of at least 4 pieces is a twig: a clump of as many leaves as it has pieces, whose width is such that its area is
// the mesh's; mass, stiffness and drag of a clump follow from area and length. A note says how many. (A long leaf of fewer is a card that
// shows a spray, leaf_count.h: much of its mesh is transparent.)
// All radii are multiplied by what makes the thickest trunk's base that of the option; where all were guessed, a note tells its diameter.
// O(points + leaves), with leaves without a branch O(points log points). Throws InputError (place options.name) for a tree
// without branches and for one that breaks a rule of Splines.
Splines finish_import(ImportedTree&&, const ImportOptions&, ImportNotes&);

// The unit [m] that a tree this high [file unit] is most likely given in: m up to 120 (the tallest has 116 m), cm up to
// 12000, else mm.
double likely_unit(double height);

// An order of the indices in which parents stand first and which keeps index order where it can. `cycle` is an index
// on a cycle (the order is then unfinished), or -1. O(n), no recursion.
struct ParentsFirst {
    std::vector<std::int32_t> order;
    std::int32_t cycle = -1;
};
ParentsFirst parents_first(const std::vector<std::int32_t>& parent);

} // namespace bough
