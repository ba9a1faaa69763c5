// loose_curves.h: curves without parents (dumps of a tree's curves, splines in a model file) joined into a tree.
#pragma once
#include "imported_tree.h"

namespace bough {

// Curves as a file has them, one after another: points of curve i are first[i] .. first[i + 1] - 1.
struct LooseCurves {
    std::vector<Vec3> point;    // [file unit]
    std::vector<double> radius; // [file unit] one a point, <= 0: unknown
    std::vector<std::int32_t> first{0};
    std::size_t size() const { return first.size() - 1; }
    void add(const Vec3& p, double r) { // to the curve that is being made
        point.push_back(p);
        radius.push_back(r);
    }
    void end_curve() { first.push_back(std::int32_t(point.size())); }
};

enum class CurveBase { first, last, unknown }; // which end of every curve is the base, if the format says so

struct JoinedCurves {
    std::vector<ImportedBranch> branches;
    char up = 0; // 'y' or 'z': as given, else as guessed
};

// Gives each curve its parent and parent_at by proximity (attach.h) and turns it so that its first point is its base,
// which keeps its place, on the parent's axis or off it.
// Where the base is unknown, the thicker end is it for all curves if that is the same one on 3 of 4 curves whose ends
// differ; without radii the end that lies nearer to another curve, if that is so on 3 of 4; else each curve has its own.
// Curves without length are left out. `up` is 'y', 'z' or 0 for a guess (up_axis.h).
// Notes: what was guessed, how many were joined, the largest gap. O(points log points).
// Throws InputError (place `name`) where no curve has a length.
JoinedCurves join_curves(LooseCurves&&, char up, CurveBase base, const std::string& name, ImportNotes&);

} // namespace bough
