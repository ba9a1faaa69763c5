// eztree_branches.cpp: lists of ez-tree's branches (JSON): its queue of {level, origin, orientation (Euler angles XYZ,
// radians), length, radius, sectionCount}, in an array "branches" or alone, as scripts dump it. A list has neither
// parents nor the course of a branch beyond its first direction, so both are found in one of two ways:
//
//   regrown   where the file holds the preset too ("options"), it is grown again (lib/growth/eztree.h, the same numbers):
//             if that gives this very list, origins, lengths and radii within 1e-4, its curves are the branches'
//   drawn     else a branch runs from its origin through those of its children, in the order of their distance, and goes
//             on straight to its length; one without children is straight along y of its orientation. Parents are those
//             of a field "parent", else what ez-tree's order says: level by level, the same number on each of the level
//             before. Radii fall to 0.3 of the base's (taper 0.7, ez-tree's default).
// No unit; Y up, as three.js has it.
#include "eztree_list.h"
#include "formats/parameters/eztree.h"
#include "formats/plain_text.h"
#include "imported_tree.h"
#include "lib/model/polyline.h"
#include <algorithm>

namespace bough {
namespace {

using namespace eztree;

bool agrees(const Splines& s, const std::vector<Listed>& list) {
    if (s.branches() != list.size()) return false;
    for (std::size_t b = 0; b < list.size(); ++b) {
        const auto first = std::size_t(s.first_point[b]);
        const double length = arc_lengths(points_of(s, b)).back();
        const double tolerance = 1e-4 * std::max(1.0, list[0].length);
        if ((s.point[first] - list[b].origin).norm() > tolerance || std::abs(length - list[b].length) > tolerance ||
            std::abs(s.radius[first] - list[b].radius) > 1e-4 * std::max(list[b].radius, 1e-3))
            return false;
    }
    return true;
}

// The branches that the file's own preset gives, if they are those of the list.
std::optional<Splines> regrown(const Dump& dump, const std::string& name) {
    if (dump.options.empty()) return {};
    const std::size_t brace = dump.options.find('{'); // a colon and blanks go before
    if (brace == std::string_view::npos) return {};
    const std::string_view text = dump.options.substr(brace);
    try {
        std::vector<std::string> look; // of bark and leaves, which a list of branches has none of
        const EzTreeParameters p = read_eztree(text, name, look);
        std::int64_t count = 0;
        for (const std::int64_t n : eztree_branches(p)) count += n;
        if (count != std::int64_t(dump.branches.size())) return {};
        Splines grown = grow_eztree(p, false);
        if (agrees(grown, dump.branches)) return grown;
    } catch (const std::exception&) { // options of another version: the list is drawn
    }
    return {};
}

void add_regrown(ImportedTree& tree, const Splines& s) {
    for (std::size_t b = 0; b < s.branches(); ++b) {
        ImportedBranch out;
        out.parent = s.parent[b];
        out.parent_at = s.parent_at[b];
        out.point.assign(s.point.begin() + s.first_point[b], s.point.begin() + s.first_point[b + 1]);
        out.radius.assign(s.radius.begin() + s.first_point[b], s.radius.begin() + s.first_point[b + 1]);
        tree.branches.push_back(std::move(out));
    }
}

std::vector<std::int32_t> parents_by_order(const std::vector<Listed>& list, const std::string& name) {
    std::vector<std::int32_t> parent(list.size(), -1);
    std::size_t above = 0, first = 0; // where the levels before and at hand begin
    for (std::size_t i = 0; i < list.size(); i = first) {
        const std::int64_t level = list[i].level;
        while (first < list.size() && list[first].level == level) ++first;
        if (i > 0) {
            const std::size_t hosts = i - above, children = first - i;
            if (level != list[i - 1].level + 1 || children % hosts != 0)
                refuse(name, i,
                       ": " + std::to_string(children) + " branches of level " + std::to_string(level) + " follow " +
                           std::to_string(hosts) + " of level " + std::to_string(list[i - 1].level) +
                           ", expected ez-tree's order, with as many on each, or a field parent");
            for (std::size_t k = i; k < first; ++k) parent[k] = std::int32_t(above + (k - i) / (children / hosts));
        }
        above = i;
    }
    return parent;
}

std::vector<std::int32_t> parents_of(const std::vector<Listed>& list, const std::string& name) {
    if (std::none_of(list.begin(), list.end(), [](const Listed& b) { return b.has_parent; }))
        return parents_by_order(list, name);
    std::vector<std::int32_t> parent;
    for (const Listed& b : list) parent.push_back(std::int32_t(b.parent));
    return parent;
}

Vec3 first_direction(const Listed& b) {
    return (Eigen::AngleAxisd(b.orientation.x(), Vec3::UnitX()) * Eigen::AngleAxisd(b.orientation.y(), Vec3::UnitY()) *
            Eigen::AngleAxisd(b.orientation.z(), Vec3::UnitZ())) *
           Vec3::UnitY();
}

ImportedBranch drawn(const std::vector<Listed>& list, std::size_t at, std::vector<std::int32_t>& children) {
    const Listed& b = list[at];
    const auto distance = [&](std::int32_t k) { return (list[k].origin - b.origin).norm(); };
    std::stable_sort(children.begin(), children.end(),
                     [&](std::int32_t i, std::int32_t k) { return distance(i) < distance(k); });
    ImportedBranch out;
    out.point = {b.origin};
    double arc = 0;
    std::vector<double> along{0};
    const auto add = [&](const Vec3& p) {
        arc += (p - out.point.back()).norm();
        out.point.push_back(p);
        along.push_back(arc);
    };
    for (const std::int32_t k : children) add(list[k].origin);
    const Vec3 way = out.point.size() > 1 ? Vec3(out.point.back() - out.point[out.point.size() - 2]) : Vec3::Zero();
    const Vec3 direction = way.squaredNorm() > 0 ? Vec3(way.normalized()) : first_direction(b);
    if (arc < b.length * (1 - 1e-6)) add(out.point.back() + (b.length - arc) * direction);
    for (const double s : along) out.radius.push_back(b.radius * (1 - 0.7 * (arc > 0 ? s / arc : 0)));
    return out;
}

void add_drawn(ImportedTree& tree, const std::vector<Listed>& list, const std::string& name) {
    const std::vector<std::int32_t> parent = parents_of(list, name);
    std::vector<std::vector<std::int32_t>> children(list.size());
    for (std::size_t i = 0; i < list.size(); ++i)
        if (parent[i] >= 0) children[parent[i]].push_back(std::int32_t(i));
    for (std::size_t i = 0; i < list.size(); ++i) {
        tree.branches.push_back(drawn(list, i, children[i]));
        tree.branches[i].parent = parent[i];
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::vector<double> arc = arc_lengths(tree.branches[i].point);
        for (std::size_t k = 0; k < children[i].size() && arc.back() > 0; ++k)
            tree.branches[children[i][k]].parent_at = std::min(1.0, arc[k + 1] / arc.back());
    }
}

bool recognizes_list(std::string_view content) {
    const std::string_view head = content.substr(0, 65536);
    const std::size_t first = text_start(head);
    if (first == head.size() || (head[first] != '{' && head[first] != '[')) return false;
    for (const char* key : {"\"origin\"", "\"orientation\"", "\"length\"", "\"radius\""})
        if (head.find(key) == std::string_view::npos) return false;
    return true;
}

Splines read_list(std::string_view content, const ImportOptions& options, ImportNotes& notes) {
    content = without_bom(content);
    const Dump dump = read_dump(content, options.name);
    ImportedTree tree;
    if (const auto grown = regrown(dump, options.name)) {
        add_regrown(tree, *grown);
        notes.lines.push_back("the list holds no curves: those of the preset in the file, which gives the same " +
                              std::to_string(dump.branches.size()) + " branches");
    } else {
        add_drawn(tree, dump.branches, options.name);
        notes.lines.push_back(
            "the list holds no curves: " + std::to_string(dump.branches.size()) +
            " branches drawn through where their children begin, then straight, 0.3 as thick at the tip");
    }
    tree.source = "ez-tree branches " + options.name;
    tree.up = 'y';
    return finish_import(std::move(tree), options, notes);
}

} // namespace

const SplineFormat eztree_branches_format{"ez-tree branch list", recognizes_list, read_list};

} // namespace bough
