// obj_lines.h: what a Wavefront OBJ holds besides its mesh: lines (l) and free-form curves (curv).
#pragma once
#include "line_graph.h"
#include <string_view>

namespace bough {

struct ObjCurve {
    std::size_t point = 0, points = 0; // control points: the first and how many, in ObjLines::curve_point
    std::size_t knot = 0, knots = 0;   // parm u, the same in curve_knot
    int degree = 1;
    bool rational = false;
    enum class Kind { bspline, bezier, cardinal } kind = Kind::bspline;
};

struct ObjLines {
    LineGraph lines;            // its points are all v; no radii
    std::vector<double> weight; // fourth number of each v, or empty: none has one
    std::vector<ObjCurve> curves;
    std::vector<std::int32_t> curve_point;                 // of all curves, into lines.point
    std::vector<double> curve_knot;                        // of all curves
    std::size_t faces = 0, surfaces = 0, other_points = 0; // f, surf; p
};

// Reads v, l, cstype, deg, curv, parm, end; counts f, surf and p; leaves everything else alone. Continued lines,
// negative (counted back) and v/vt indices, points named before they are given. O(bytes).
// Throws InputError FILE:LINE for a number or index that is none.
ObjLines read_obj_lines(std::string_view content, const std::string& name);

// Whether the text begins as an OBJ does: keywords of the format up to a first v with its three numbers.
bool looks_like_obj(std::string_view content);

} // namespace bough
