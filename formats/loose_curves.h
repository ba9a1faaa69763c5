// loose_curves.h: curves without parents (dumps of a tree's curves, splines in a model file) joined into a tree.
#pragma once
#include "imported_tree.h"

namespace bough {

enum class CurveBase { first, last, unknown }; // which end of every curve is the base, if the format says so

// Gives each curve its parent and parent_at by proximity (attach.h) and turns it so that its first point is its base,
// which keeps its place, on the parent's axis or off it. A curve in: points, one radius each (<= 0: unknown).
// Where the base is unknown, the thicker end is it for all curves if that is the same one on 3 of 4 curves whose ends
// differ; without radii the end that lies nearer to another curve, if that is so on 3 of 4; else each curve has its own.
// Curves without length are left out. Returns the up axis, 'y' or 'z': as given, or, for 0, as guessed (up_axis.h).
// Notes: what was guessed, how many were joined, the largest gap. O(points log points).
// Throws InputError (place `name`) where no curve has a length.
char join_curves(std::vector<ImportedBranch>& curves, char up, CurveBase base, const std::string& name, ImportNotes&);

} // namespace bough
