// mtg.cpp: multiscale tree graphs (MTG) of digitized plants: a node for each entity that has a position, linked to the next
// one before it that has (mtg_code.h). Positions are the columns XX, YY, ZZ (or X, Y, Z), the end of an entity; its
// radius is half of TopDia there, else of another diameter's column, else by the pipe rule. Scales play no part beyond
// that. The format states no unit; Z is up, as in AMAPmod. Diameters may have a unit of their own (cm and mm are common):
// that of the positions is taken where the plant is then
// 10 to 200 times as high as thick, else the one of m, cm, mm and 0.1 mm that brings it nearest to 50 (on a logarithmic
// scale). A graph without positions is refused: lengths and diameters alone do
// not say where branches point.
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include "mtg_code.h"
#include "pipe_rule.h"
#include "skeleton.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace bough {
namespace {

constexpr std::size_t no_feature = std::size_t(-1);

std::size_t feature(const mtg::File& file, std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names)
        for (std::size_t k = 0; k < file.features.size(); ++k)
            if (lower_case(file.features[k]) == name) return k;
    return no_feature;
}

struct FeatureColumns {
    std::array<std::size_t, 3> position;
    std::vector<std::size_t> diameter; // the first that is given counts
    std::size_t radius;
};

FeatureColumns columns_of(const mtg::File& file) {
    FeatureColumns c;
    c.position = {feature(file, {"xx", "x"}), feature(file, {"yy", "y"}), feature(file, {"zz", "z"})};
    for (const auto& names : {std::initializer_list<std::string_view>{"topdia", "topdiameter"},
                              {"diameter", "diam", "dia"},
                              {"botdia", "bottomdia", "bottomdiameter", "basdia"}})
        if (const std::size_t k = feature(file, names); k != no_feature) c.diameter.push_back(k);
    c.radius = feature(file, {"radius", "ray"});
    return c;
}

std::string listed(const mtg::File& file) {
    std::string out;
    for (std::size_t k = 0; k < file.features.size() && k < 8; ++k)
        out.append(k > 0 ? ", " : "").append(valid_utf8(std::string(file.features[k])));
    return out.empty() ? "none at all" : file.features.size() > 8 ? out + " ..." : out;
}

std::optional<double> number(const mtg::File& file, const mtg::Vertex& v, std::size_t feature,
                             const std::string& name) {
    const std::string_view text = feature == no_feature ? std::string_view() : mtg::cell(file, v, feature);
    if (text.empty() || text == "NA" || text == "-") return {};
    const auto value = parse_number(text, true);
    if (!value)
        throw InputError(file_line(name, v.line), std::string(file.features[feature]) + " is " + in_ascii_quotes(text) +
                                                      ", expected a finite number or nothing");
    return value;
}

struct Nodes {
    Skeleton skeleton;
    std::vector<std::int32_t> above; // of each vertex: itself or the next before it with a position; -1: none
    std::size_t half = 0;            // vertices with one or two coordinates
};

Nodes nodes_of(const mtg::File& file, const FeatureColumns& c, const std::string& name) {
    Nodes n;
    n.above.reserve(file.vertices.size());
    for (const mtg::Vertex& v : file.vertices) {
        const std::int32_t before = v.from < 0 ? -1 : n.above[v.from];
        std::array<std::optional<double>, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = number(file, v, c.position[k], name);
        if (!p[0] || !p[1] || !p[2]) {
            n.half += p[0] || p[1] || p[2];
            n.above.push_back(before);
            continue;
        }
        double radius = number(file, v, c.radius, name).value_or(0);
        for (std::size_t k = c.diameter.size(); k-- > 0;)
            if (const auto diameter = number(file, v, c.diameter[k], name)) radius = 0.5 * *diameter;
        if (radius < 0) throw InputError(file_line(name, v.line), "has a diameter below 0, expected 0 or more");
        n.above.push_back(std::int32_t(n.skeleton.point.size()));
        n.skeleton.parent.push_back(before);
        n.skeleton.point.emplace_back(*p[0], *p[1], *p[2]);
        n.skeleton.radius.push_back(radius);
        n.skeleton.line.push_back(v.line);
    }
    return n;
}

constexpr double usual = 50; // height over diameter of the base

// Brings the radii to the unit of the positions.
void scale_radii(Skeleton& s, const ImportOptions& options, ImportNotes& notes) {
    const double thickest = 2 * *std::max_element(s.radius.begin(), s.radius.end());
    if (!(thickest > 0)) return;
    const int axis = options.up == 'y' ? 1 : 2;
    double low = s.point.front()[axis], high = low;
    for (const Vec3& p : s.point) low = std::min(low, p[axis]), high = std::max(high, p[axis]);
    const double unit = options.unit ? *options.unit : likely_unit(high - low), height = unit * (high - low);
    if (!(height > 0)) return;
    const auto slender = [&](double diameter_unit) { return height / (diameter_unit * thickest); };
    double best = unit;
    if (slender(unit) < 10 || slender(unit) > 200)
        for (const double u : {1.0, 1e-2, 1e-3, 1e-4})
            if (std::abs(std::log(slender(u) / usual)) < std::abs(std::log(slender(best) / usual))) best = u;
    if (best == unit) return;
    for (double& r : s.radius) r *= best / unit;
    notes.lines.push_back("diameters multiplied by " + shown(best / unit) +
                          " to the scale of positions: the thickest is " + shown(thickest) + " on a plant " +
                          shown(high - low) + " high, which makes it " + shown(slender(best)) +
                          " times as high as thick");
}

void note_what_is_left(const mtg::File& file, const Nodes& nodes, ImportNotes& notes) {
    const std::size_t passed = file.entities - nodes.skeleton.point.size();
    if (passed > 0)
        notes.lines.push_back(
            std::to_string(passed) + " of " + std::to_string(file.entities) +
            " entities without a position passed over" +
            (nodes.half > 0 ? ", " + std::to_string(nodes.half) + " of them with a part of one" : ""));
    if (file.dates > 0)
        notes.lines.push_back(counted(file.dates, "line", "lines") + " of the same entities at later dates left out");
}

bool recognizes_mtg(std::string_view content) {
    constexpr std::size_t head = 65536;
    content = without_bom(content);
    content = content.substr(0, head);
    for (std::size_t at = 0; at < content.size();) {
        const std::size_t end = std::min(content.find('\n', at), content.size());
        const std::string_view line = trimmed(content.substr(at, end - at));
        at = end + 1;
        if (line.empty() || line.front() == '#') continue;
        const std::string_view rest = line.substr(0, 4) == "CODE" ? trimmed(line.substr(4)) : std::string_view();
        return rest.substr(0, 1) == ":" && content.find("CLASSES") != std::string_view::npos;
    }
    return false;
}

Splines read_mtg(std::string_view content, const ImportOptions& options, ImportNotes& notes) {
    const mtg::File file = mtg::parse(content, options.name);
    const FeatureColumns columns = columns_of(file);
    const auto no_positions = [&](std::size_t line, const std::string& what) {
        throw InputError(file_line(options.name, line),
                         what + "; expected XX, YY, ZZ of entities, as digitized plants have (lengths and diameters "
                                "alone do not say where branches point)");
    };
    if (std::count(columns.position.begin(), columns.position.end(), no_feature) > 0)
        no_positions(file.line_of_features, "has no positions, its features are " + listed(file));
    Nodes nodes = nodes_of(file, columns, options.name);
    if (nodes.skeleton.point.empty())
        no_positions(file.line_of_features, "has columns of positions but no entity with one");
    scale_radii(nodes.skeleton, options, notes);
    note_what_is_left(file, nodes, notes);
    ImportedTree tree;
    tree.branches = branches_of(std::move(nodes.skeleton), options.name, notes);
    fill_radii(tree.branches, notes);
    tree.source = "MTG " + options.name;
    if (options.up == 0) {
        notes.lines.push_back("up axis: taken as Z, as AMAPmod has it (--up overrides)");
        notes.up_from = "guessed";
    }
    tree.up = 'z';
    return finish_import(std::move(tree), options, notes);
}

} // namespace

const SplineFormat mtg_format{"MTG", recognizes_mtg, read_mtg};

} // namespace bough
