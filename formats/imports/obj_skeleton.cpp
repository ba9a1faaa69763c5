// obj_skeleton.cpp: a tree in a Wavefront OBJ: lines (l), whose order and direction mean nothing, or curves (curv),
// which may run from tip to base. Neither has a parent or a radius. Where a curve reaches its ends it is evaluated;
// where it does not (Blender writes knots that leave both ends out) or has fewer points than its degree needs, its
// control points are the line. The format states neither unit nor axis.
#include "curve_points.h"
#include "formats/release.h"
#include "lib/base/counted.h"
#include "loose_curves.h"
#include "obj_lines.h"
#include "pipe_rule.h"

namespace bough {
namespace {

// A curve's points, weights and knots.
struct Controls {
    std::vector<Vec3> point;
    std::vector<double> weight, knot;

    void take(const ObjLines& obj, const ObjCurve& curve) {
        point.clear();
        weight.clear();
        for (std::size_t k = curve.point; k < curve.point + curve.points; ++k) {
            const std::int32_t i = obj.curve_point[k];
            point.push_back(obj.lines.point[i]);
            if (curve.rational && !obj.weight.empty()) weight.push_back(obj.weight[i]);
        }
        const auto first = obj.curve_knot.begin() + std::ptrdiff_t(curve.knot);
        knot.assign(first, first + std::ptrdiff_t(curve.knots));
    }
    // Nothing: the line is along the points.
    std::optional<std::vector<Vec3>> evaluated(const ObjCurve& curve) const {
        if (curve.kind == ObjCurve::Kind::bspline) return bspline_points(point, weight, knot, curve.degree);
        if (curve.kind == ObjCurve::Kind::bezier) return bezier_points(point, weight, curve.degree);
        if (point.size() <= 3) return {};
        return std::vector<Vec3>(point.begin() + 1, point.end() - 1); // it runs through all but the first and the last
    }
};

LooseCurves curves_of(const ObjLines& obj, ImportNotes& notes) {
    LooseCurves curves;
    Controls controls;
    std::size_t by_points = 0;
    for (const ObjCurve& c : obj.curves) {
        controls.take(obj, c);
        const auto line = controls.evaluated(c);
        by_points += !line;
        for (const Vec3& p : line ? *line : controls.point) curves.add(p, 0);
        curves.end_curve();
    }
    if (by_points > 0)
        notes.lines.push_back(counted(by_points,
                                      "curve taken along its control points, as it has too few of them or knots that "
                                      "do not reach its ends",
                                      "curves taken along their control points, as they have too few of them or knots "
                                      "that do not reach their ends"));
    return curves;
}

// Lines and curves in one file: the curves' points become lines, too.
void add_as_lines(LineGraph& lines, const LooseCurves& curves) {
    for (std::size_t c = 0; c < curves.size(); ++c)
        for (std::int32_t k = curves.first[c]; k < curves.first[c + 1]; ++k) {
            const std::int32_t i = std::int32_t(lines.point.size());
            lines.point.push_back(curves.point[k]);
            if (k > curves.first[c]) lines.edge.push_back({i - 1, i});
        }
}

LooseCurves loosened(std::vector<ImportedBranch>&& branches) {
    LooseCurves curves;
    std::size_t points = 0;
    for (const ImportedBranch& b : branches) points += b.point.size();
    curves.point.reserve(points);
    curves.radius.reserve(points);
    for (ImportedBranch& b : branches) {
        curves.point.insert(curves.point.end(), b.point.begin(), b.point.end());
        curves.radius.insert(curves.radius.end(), b.radius.begin(), b.radius.end());
        curves.end_curve();
        b = {};
    }
    release(branches);
    return curves;
}

// Joined twice: radii by the pipe rule over the first result tell stems that begin side by side from their host.
JoinedCurves join_bare_curves(LooseCurves&& curves, const ImportOptions& options, ImportNotes& notes) {
    JoinedCurves joined = join_curves(std::move(curves), options.up, CurveBase::unknown, options.name, notes);
    ImportNotes known;
    fill_radii(joined.branches, known);
    joined = join_curves(loosened(std::move(joined.branches)), joined.up, CurveBase::first, options.name, known);
    for (ImportedBranch& c : joined.branches) c.radius.assign(c.point.size(), 0);
    return joined;
}

[[noreturn]] void refuse(const ObjLines& obj, const std::string& name) {
    if (obj.faces > 0 || obj.surfaces > 0)
        throw InputError(name, "is a mesh (" + counted(obj.faces + obj.surfaces, "face", "faces") +
                                   ") without lines (l) or curves (curv), which is no skeleton; export the tree's "
                                   "curves or edges, or grow a tree in the mesh by treegen --envelope");
    throw InputError(name, counted(obj.lines.point.size(), "point", "points") +
                               " without lines (l) or curves (curv), expected a tree's skeleton");
}

Splines read_obj(std::string_view content, const ImportOptions& options, ImportNotes& notes) {
    ObjLines obj = read_obj_lines(content, options.name);
    options.let_go();
    if (obj.lines.edge.empty() && obj.curves.empty()) refuse(obj, options.name);
    if (obj.faces + obj.surfaces > 0)
        notes.lines.push_back(counted(obj.faces + obj.surfaces, "face", "faces") + " not read beside the lines");
    if (obj.other_points > 0)
        notes.lines.push_back(counted(obj.other_points, "point element", "point elements") + " not read");
    ImportedTree tree;
    LooseCurves curves = curves_of(obj, notes);
    release(obj.curves, obj.curve_point, obj.curve_knot);
    if (obj.lines.edge.empty()) {
        obj = {};
        JoinedCurves joined = join_bare_curves(std::move(curves), options, notes);
        tree.branches = std::move(joined.branches);
        tree.up = joined.up;
        fill_radii(tree.branches, notes);
    } else {
        add_as_lines(obj.lines, curves);
        tree = tree_of_lines(std::move(obj.lines), options.up, options.name, notes);
    }
    tree.source = "Wavefront OBJ " + options.name;
    return finish_import(std::move(tree), options, notes);
}

} // namespace

const SplineFormat obj_format{"Wavefront OBJ lines or curves", looks_like_obj, read_obj};

} // namespace bough
