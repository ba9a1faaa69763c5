// sapling_curves.cpp: Blender's tree curves as JSON: {units, up_axis, bevel_depth, resolution_u, splines: [{type, cyclic,
// points: [{co, handle_left, handle_right, radius}]}]}, keys in any order, others left alone. The wood's radius is a
// point's radius times bevel_depth (where that is 0, the points' own). Bezier pieces are evaluated: as many points as
// keep within 1/500 of a piece's length, at most resolution_u; others are straight between their points.
// No parents: loose_curves.h.
#include "curve_points.h"
#include "formats/plain_text.h"
#include "json_pull.h"
#include "lib/base/counted.h"
#include "loose_curves.h"
#include "pipe_rule.h"
#include <algorithm>
#include <array>

namespace bough {
namespace {

constexpr double off_curve = 1.0 / 500; // of a piece's length

struct Knot {
    Vec3 point = Vec3::Zero(), left = Vec3::Zero(), right = Vec3::Zero();
    double radius = 0;
    bool placed = false, has_left = false, has_right = false;
};

Vec3 vector(JsonPull& json) {
    std::array<double, 3> v{};
    std::size_t n = 0;
    for (json.begin_array(); json.next_item(); ++n) {
        const double number = json.number(); // a fourth is a weight
        if (n < v.size()) v[n] = number;
    }
    if (n < v.size()) json.refuse("has " + counted(n, "number", "numbers") + ", expected x y z");
    return {v[0], v[1], v[2]};
}

class CurveReader {
public:
    CurveReader(std::string_view content, const std::string& name) : json_(content, name) {
        std::string_view key;
        for (json_.begin_object(); json_.next_key(key);) {
            if (key == "splines")
                take_splines();
            else if (key == "units" && json_.peek() == '"')
                units = std::string(json_.string());
            else if (key == "up_axis" && json_.peek() == '"')
                up = std::string(json_.string());
            else if (key == "bevel_depth")
                bevel_ = json_.number();
            else if (key == "resolution_u")
                resolution_ = json_.number();
            else
                json_.skip();
        }
        json_.end();
    }

    LooseCurves curves() {
        const double factor = bevel_ > 0 ? bevel_ : 1;
        for (double& r : curves_.radius) r *= factor;
        return std::move(curves_);
    }
    bool without_bevel() const { return bevel_ == 0; }

    std::string units, up;
    std::size_t closed = 0;

private:
    void take_splines() {
        for (json_.begin_array(); json_.next_item();) take_spline();
    }

    void take_spline() {
        bool bezier = true;
        std::string_view key;
        knots_.clear();
        for (json_.begin_object(); json_.next_key(key);) {
            if (key == "points" || key == "bezier_points")
                take_points();
            else if (key == "type")
                bezier = json_.string() == "BEZIER";
            else if (key == "cyclic")
                closed += json_.boolean();
            else
                json_.skip();
        }
        if (!knots_.empty()) add_curve(bezier);
    }

    void take_points() {
        for (json_.begin_array(); json_.next_item();) {
            Knot knot;
            std::string_view key;
            for (json_.begin_object(); json_.next_key(key);) {
                if (key == "co") {
                    knot.point = vector(json_);
                    knot.placed = true;
                } else if (key == "handle_left") {
                    knot.left = vector(json_);
                    knot.has_left = true;
                } else if (key == "handle_right") {
                    knot.right = vector(json_);
                    knot.has_right = true;
                } else if (key == "radius") {
                    knot.radius = json_.number();
                } else {
                    json_.skip();
                }
            }
            if (!knot.placed) json_.refuse("a point of a spline has no co, expected its place");
            knots_.push_back(knot);
        }
    }

    // Straight pieces for the Bezier between a and b: a chord over h of the parameter is off by at most h^2/8 of the
    // second derivative, which is largest at an end.
    int pieces(const Knot& a, const Knot& b) const {
        const double bend =
            6 * std::max((a.point - 2 * a.right + b.left).norm(), (a.right - 2 * b.left + b.point).norm());
        const double length = (a.right - a.point).norm() + (b.left - a.right).norm() + (b.point - b.left).norm();
        if (!(length > 0)) return 1;
        const double wanted = std::ceil(std::sqrt(bend / (8 * off_curve * length)));
        if (!(wanted > 1)) return 1; // it is not a number where a point is at 1e308, which is refused later
        return int(std::min(wanted, std::max(1.0, resolution_)));
    }

    void add_curve(bool bezier) {
        curves_.add(knots_.front().point, knots_.front().radius);
        for (std::size_t k = 1; k < knots_.size(); ++k) {
            const Knot &a = knots_[k - 1], &b = knots_[k];
            const int n = bezier && a.has_right && b.has_left ? pieces(a, b) : 1;
            for (int i = 1; i <= n; ++i) {
                const double t = double(i) / n;
                curves_.add(i == n ? b.point : cubic_bezier(a.point, a.right, b.left, b.point, t),
                            (1 - t) * a.radius + t * b.radius);
            }
        }
        curves_.end_curve();
    }

    JsonPull json_;
    double bevel_ = 1, resolution_ = 12; // Blender's own
    std::vector<Knot> knots_;
    LooseCurves curves_;
};

std::optional<double> unit_called(const std::string& name) {
    const std::pair<const char*, double> units[] = {{"m", 1},       {"metres", 1}, {"meters", 1},
                                                    {"cm", 0.01},   {"mm", 0.001}, {"in", 0.0254},
                                                    {"ft", 0.3048}, {"METERS", 1}, {"CENTIMETERS", 0.01}};
    for (const auto& [unit, metres] : units)
        if (name == unit) return metres;
    return {};
}

bool recognizes_curves(std::string_view content) {
    const std::string_view head = content.substr(0, 65536);
    const std::size_t first = text_start(head);
    return first != head.size() && head[first] == '{' && head.find("\"splines\"") != std::string_view::npos &&
           head.find("\"co\"") != std::string_view::npos;
}

Splines read_curves(std::string_view content, const ImportOptions& options, ImportNotes& notes) {
    CurveReader file(content, options.name);
    ImportedTree tree;
    LooseCurves curves = file.curves();
    options.let_go();
    if (curves.size() == 0) throw InputError(options.name, "holds no spline with points, expected at least one");
    tree.unit = unit_called(file.units);
    if (!file.units.empty() && !tree.unit)
        notes.lines.push_back("units " + in_ascii_quotes(file.units) + " are none that are known");
    if (file.up == "Z" || file.up == "z") tree.up = 'z';
    if (file.up == "Y" || file.up == "y") tree.up = 'y';
    if (file.without_bevel())
        notes.lines.push_back("bevel_depth is 0, so that the curves have no thickness; the points' own radii taken");
    if (file.closed > 0) notes.lines.push_back(counted(file.closed, "closed curve", "closed curves") + " opened");
    tree.source = "curves of Blender " + options.name;
    const char up = options.up != 0 ? options.up : tree.up;
    JoinedCurves joined = join_curves(std::move(curves), up, CurveBase::unknown, options.name, notes);
    tree.branches = std::move(joined.branches);
    tree.up = joined.up;
    fill_radii(tree.branches, notes);
    return finish_import(std::move(tree), options, notes);
}

} // namespace

const SplineFormat sapling_curves_format{"curves of Blender (JSON)", recognizes_curves, read_curves};

} // namespace bough
