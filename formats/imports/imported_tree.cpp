#include "imported_tree.h"
#include "formats/plain_text.h"
#include "leaf_hosts.h"
#include "lib/base/counted.h"
#include "lib/growth/leaf_count.h"
#include "placed_import.h"
#include <algorithm>
#include <limits>

namespace bough {

ParentsFirst parents_first(const std::vector<std::int32_t>& parent) {
    enum : char { unseen, open, placed };
    ParentsFirst result;
    result.order.reserve(parent.size());
    std::vector<char> state(parent.size(), unseen);
    std::vector<std::int32_t> path;
    for (std::size_t start = 0; start < parent.size(); ++start) {
        std::int32_t i = std::int32_t(start);
        while (i >= 0 && state[i] == unseen) {
            state[i] = open;
            path.push_back(i);
            i = parent[i];
        }
        if (i >= 0 && state[i] == open) {
            result.cycle = i;
            return result;
        }
        for (; !path.empty(); path.pop_back()) {
            state[path.back()] = placed;
            result.order.push_back(path.back());
        }
    }
    return result;
}

double likely_unit(double height) {
    constexpr double tallest = 120;
    return height <= tallest ? 1 : height <= 100 * tallest ? 0.01 : 0.001;
}

namespace {

std::size_t leave_out_repeated_points(ImportedBranch& branch) {
    const std::size_t before = branch.point.size();
    std::size_t kept = 0;
    for (std::size_t k = 0; k < branch.point.size(); ++k) {
        if (kept > 0 && branch.point[k] == branch.point[kept - 1]) continue;
        branch.point[kept] = branch.point[k];
        branch.radius[kept++] = branch.radius[k];
    }
    branch.point.resize(kept);
    branch.radius.resize(kept);
    return before - kept;
}

// Branches with at least two points, parents first, and the new index of each old one (-1: none that carries it).
struct Ordered {
    std::vector<ImportedBranch> branches;
    std::vector<std::int32_t> index_of;
};

Ordered order_branches(std::vector<ImportedBranch>&& branches, ImportNotes& notes) {
    std::vector<std::int32_t> parent;
    parent.reserve(branches.size());
    for (const ImportedBranch& b : branches) parent.push_back(b.parent);
    Ordered result;
    result.index_of.assign(branches.size(), -1);
    std::vector<double> moved_to(branches.size(), -1); // where a branch without length sat on the one that carries it
    result.branches.reserve(branches.size());
    std::size_t empty = 0, repeated = 0;
    for (const std::int32_t i : parents_first(parent).order) {
        ImportedBranch& b = branches[i];
        repeated += leave_out_repeated_points(b);
        if (b.parent >= 0) {
            if (moved_to[b.parent] >= 0) b.parent_at = moved_to[b.parent];
            b.parent = result.index_of[b.parent];
        }
        if (b.parent < 0) b.parent_at = 0;
        if (b.point.size() < 2) {
            ++empty;
            moved_to[i] = b.parent_at;
            result.index_of[i] = b.parent;
            continue;
        }
        result.index_of[i] = std::int32_t(result.branches.size());
        result.branches.push_back(std::move(b));
    }
    if (repeated > 0)
        notes.lines.push_back(counted(repeated, "point that repeats the one before left out",
                                      "points that repeat the one before left out"));
    if (empty > 0) notes.lines.push_back(counted(empty, "branch", "branches") + " without length left out");
    return result;
}

struct Frame {
    double unit = 1; // [m]
    char up = 'y';
    Vec3 turned(const Vec3& v) const { return up == 'z' ? Vec3(v.x(), v.z(), -v.y()) : v; }
    Vec3 placed(const Vec3& v) const { return unit * turned(v); }
    Quat turned(const Mat3& axes) const {
        Mat3 m;
        for (int k = 0; k < 3; ++k) m.col(k) = turned(Vec3(axes.col(k)));
        return Quat(m).normalized();
    }
};

char up_axis(const ImportedTree& tree, const ImportOptions& options, ImportNotes& notes) {
    if (options.up != 0) return options.up;
    if (tree.up != 0) return tree.up;
    Vec3 sum = Vec3::Zero();
    for (const ImportedBranch& b : tree.branches)
        if (b.parent < 0) sum += b.point.back() - b.point.front();
    const char up = std::abs(sum.y()) > std::abs(sum.z()) ? 'y' : 'z';
    notes.lines.push_back(std::string("up axis: the file states none; taken as ") + char(up - 'a' + 'A') +
                          ", which the trunk follows more closely (--up overrides)");
    return up;
}

double height(const ImportedTree& tree, char up) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const ImportedBranch& b : tree.branches) {
        for (const Vec3& p : b.point) {
            const double h = up == 'z' ? p.z() : p.y();
            low = std::min(low, h);
            high = std::max(high, h);
        }
    }
    return high - low;
}

double unit_of(const ImportedTree& tree, char up, const ImportOptions& options, ImportNotes& notes) {
    if (options.unit) return *options.unit;
    if (tree.unit) return *tree.unit;
    const double h = height(tree, up);
    const double unit = likely_unit(h);
    const std::string too_high = unit == 1 ? "" : " and no tree is " + shown(unit < 0.01 ? 0.01 * h : h) + " m high";
    notes.lines.push_back("unit: the file states none; taken as " +
                          std::string(unit == 1      ? "m"
                                      : unit == 0.01 ? "cm"
                                                     : "mm") +
                          ", because the tree is " + shown(h) + " units high" + too_high + " (--units overrides)");
    return unit;
}

void add_branch(Splines& s, const ImportedBranch& b, const Frame& frame) {
    s.parent.push_back(b.parent);
    s.parent_at.push_back(b.parent_at);
    s.level.push_back(b.parent < 0 ? 0 : s.level[b.parent] + 1);
    for (const Vec3& p : b.point) s.point.push_back(frame.placed(p));
    for (const double r : b.radius) s.radius.push_back(frame.unit * r);
    s.first_point.push_back(std::int32_t(s.point.size()));
}

void reserve(Splines& s, const std::vector<ImportedBranch>& branches) {
    std::size_t points = 0;
    for (const ImportedBranch& b : branches) points += b.point.size();
    for (auto* of_branch : {&s.parent, &s.level, &s.first_point}) of_branch->reserve(branches.size() + 1);
    s.parent_at.reserve(branches.size());
    s.point.reserve(points);
    s.radius.reserve(points);
}

constexpr std::int32_t twig_pieces = 4;

// Twigs get the width that their area asks for, and say how many leaves they are.
void make_twigs(const std::vector<ImportedLeaf>& leaves, double unit, Splines& s, ImportNotes& notes) {
    const auto is_twig = [](const ImportedLeaf& leaf) { return leaf.area > 0 && leaf.pieces >= twig_pieces; };
    const auto twigs = std::count_if(leaves.begin(), leaves.end(), is_twig);
    if (twigs == 0) return;
    s.leaf_count = leaf_counts(s); // of the others, as if nothing were said
    double area = 0;               // [m^2]
    for (std::size_t k = 0; k < leaves.size(); ++k) {
        if (!is_twig(leaves[k])) continue;
        const double own = unit * unit * leaves[k].area;
        s.leaf_width[k] = 2 * own / s.leaf_length[k]; // leaf_area()
        s.leaf_count[k] = leaves[k].pieces;
        area += own;
    }
    notes.lines.push_back(
        counted(std::size_t(twigs), "leaf is a twig by its mesh", "leaves are twigs by their meshes") +
        ": a clump, its leaf area that of the mesh (" + shown(area / double(twigs)) + " m2 in the mean)");
}

// Diameter at its base of the root branch that is thickest there, or of one drawn to a point there, where it is thickest; 0: none has any.
double trunk_diameter(const Splines& s) {
    double base = 0, most = 0;
    for (std::size_t b = 0; b < s.branches(); ++b) {
        if (s.parent[b] >= 0) continue;
        base = std::max(base, s.radius[std::size_t(s.first_point[b])]);
        most = std::max(
            most, *std::max_element(s.radius.begin() + s.first_point[b], s.radius.begin() + s.first_point[b + 1]));
    }
    return 2 * (base > 0 ? base : most);
}

void take_trunk_diameter(Splines& s, const ImportOptions& options, ImportNotes& notes) {
    const double found = trunk_diameter(s);
    if (!options.trunk_diameter) {
        if (notes.radii_guessed)
            notes.lines.push_back("the file has no radii: its trunk is taken as " + shown(found) +
                                  " m thick at the base by the tree's size, all others by the trunk's "
                                  "(--trunk-diameter overrides)");
        return;
    }
    if (!(found > 0))
        throw InputError(options.name, "has a trunk without a radius, which --trunk-diameter cannot scale");
    const double factor = *options.trunk_diameter / found;
    for (double& r : s.radius) r *= factor;
    if (!notes.radii_guessed)
        notes.lines.push_back("radii multiplied by " + shown(factor) + ": the file's trunk is " + shown(found) +
                              " m thick at the base (--trunk-diameter)");
}

void add_leaf(Splines& s, const ImportedLeaf& leaf, double at, const Frame& frame) {
    s.leaf_branch.push_back(leaf.branch);
    s.leaf_at.push_back(at);
    s.leaf_position.push_back(frame.placed(leaf.position));
    s.leaf_rotation.push_back(frame.turned(leaf.axes));
    s.leaf_length.push_back(frame.unit * leaf.length);
    s.leaf_width.push_back(frame.unit * leaf.width);
}

} // namespace

Splines finish_import(ImportedTree&& tree, const ImportOptions& options, ImportNotes& notes) {
    Ordered ordered = order_branches(std::move(tree.branches), notes);
    tree.branches = std::move(ordered.branches);
    if (tree.branches.empty()) throw InputError(options.name, "holds no branch with a length, expected at least one");
    Frame frame;
    frame.up = up_axis(tree, options, notes);
    frame.unit = unit_of(tree, frame.up, options, notes);
    notes.up = frame.up;
    notes.unit = frame.unit;
    if (options.up != 0 || tree.up == 0) notes.up_from = options.up != 0 ? "given" : "guessed"; // else by the reader
    notes.unit_from = options.unit ? "given" : tree.unit ? "stated" : "guessed";

    Splines s;
    reserve(s, tree.branches);
    s.name = valid_utf8(tree.name.empty() ? stem_of(options.name) : tree.name);
    s.source = valid_utf8(tree.source);
    s.first_point.push_back(0);
    for (ImportedBranch& b : tree.branches) {
        add_branch(s, b, frame);
        if (tree.leaves.empty()) b = {}; // nobody asks again, and all of a large file twice is much
    }
    double reach = 0; // [m] of the leaves
    for (const ImportedLeaf& leaf : tree.leaves)
        reach = std::max({reach, frame.placed(leaf.position).cwiseAbs().maxCoeff(), frame.unit * leaf.length,
                          frame.unit * leaf.width});
    refuse_too_far(s, reach, options.name);
    refuse_too_small(s, options.name);
    for (ImportedLeaf& leaf : tree.leaves)
        if (leaf.branch >= 0) leaf.branch = ordered.index_of[leaf.branch];
    find_hosts(tree.branches, tree.leaves);
    for (const ImportedLeaf& leaf : tree.leaves)
        add_leaf(s, leaf, nearest_on(tree.branches[leaf.branch].point, leaf.position).fraction, frame);
    make_twigs(tree.leaves, frame.unit, s, notes);
    take_trunk_diameter(s, options, notes);
    set_on_ground(s, options.keep_place, notes);
    name_absurd_scale(s, options.unit.has_value(), notes);
    if (const auto defect = check(s)) {
        std::string entry;
        if (defect->index >= 0) entry.append("[").append(std::to_string(defect->index)).append("]");
        throw InputError(options.name, "imported " + defect->field + entry + " " + defect->message);
    }
    return s;
}

} // namespace bough
