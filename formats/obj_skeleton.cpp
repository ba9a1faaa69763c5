// obj_skeleton.cpp: a tree in a Wavefront OBJ: lines (l), whose order and direction mean nothing, or curves (curv),
// which may run from tip to base. Neither has a parent or a radius. Where a curve reaches its ends it is evaluated;
// where it does not (Blender writes knots that leave both ends out) or has fewer points than its degree needs, its
// control points are the line. The format states neither unit nor axis.
#include "curve_points.h"
#include "lib/model/counted.h"
#include "loose_curves.h"
#include "obj_lines.h"
#include "pipe_rule.h"

namespace bough {
namespace {

std::vector<Vec3> line_of(const ObjLines& obj, const ObjCurve& curve, std::size_t& by_points) {
    std::vector<Vec3> point;
    std::vector<double> weight;
    for (const std::int32_t i : curve.point) {
        point.push_back(obj.lines.point[i]);
        if (curve.rational && !obj.weight.empty()) weight.push_back(obj.weight[i]);
    }
    std::optional<std::vector<Vec3>> line;
    if (curve.kind == ObjCurve::Kind::bspline)
        line = bspline_points(point, weight, curve.knot, curve.degree);
    else if (curve.kind == ObjCurve::Kind::bezier)
        line = bezier_points(point, weight, curve.degree);
    else if (point.size() > 3) // it runs through all but the first and the last
        line.emplace(point.begin() + 1, point.end() - 1);
    by_points += !line;
    return line ? std::move(*line) : point;
}

std::vector<ImportedBranch> curves_of(const ObjLines& obj, ImportNotes& notes) {
    std::vector<ImportedBranch> curves;
    std::size_t by_points = 0;
    for (const ObjCurve& c : obj.curves) {
        ImportedBranch& curve = curves.emplace_back();
        curve.point = line_of(obj, c, by_points);
        curve.radius.assign(curve.point.size(), 0);
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
void add_as_lines(LineGraph& lines, const std::vector<ImportedBranch>& curves) {
    for (const ImportedBranch& c : curves)
        for (std::size_t k = 0; k < c.point.size(); ++k) {
            const std::int32_t i = std::int32_t(lines.point.size());
            lines.point.push_back(c.point[k]);
            if (k > 0) lines.edge.push_back({i - 1, i});
        }
}

// Joined twice: radii by the pipe rule over the first result tell stems that begin side by side from their host.
char join_bare_curves(std::vector<ImportedBranch>& curves, const ImportOptions& options, ImportNotes& notes) {
    const char up = join_curves(curves, options.up, CurveBase::unknown, options.name, notes);
    ImportNotes known;
    fill_radii(curves, known);
    join_curves(curves, up, CurveBase::first, options.name, known);
    for (ImportedBranch& c : curves) c.radius.assign(c.point.size(), 0);
    return up;
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
    if (obj.lines.edge.empty() && obj.curves.empty()) refuse(obj, options.name);
    if (obj.faces + obj.surfaces > 0)
        notes.lines.push_back(counted(obj.faces + obj.surfaces, "face", "faces") + " not read beside the lines");
    if (obj.other_points > 0)
        notes.lines.push_back(counted(obj.other_points, "point element", "point elements") + " not read");
    ImportedTree tree;
    tree.branches = curves_of(obj, notes);
    if (obj.lines.edge.empty()) {
        obj = {};
        tree.up = join_bare_curves(tree.branches, options, notes);
        fill_radii(tree.branches, notes);
    } else {
        add_as_lines(obj.lines, tree.branches);
        tree = tree_of_lines(std::move(obj.lines), options.up, options.name, notes);
    }
    tree.source = "Wavefront OBJ " + options.name;
    return finish_import(std::move(tree), options, notes);
}

} // namespace

const SplineFormat obj_format{"Wavefront OBJ lines or curves", looks_like_obj, read_obj};

} // namespace bough
