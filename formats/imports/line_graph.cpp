#include "line_graph.h"
#include "attach.h"
#include "formats/plain_text.h"
#include "formats/release.h"
#include "lib/base/counted.h"
#include "pipe_rule.h"
#include "skeleton.h"
#include "up_axis.h"
#include "weld.h"
#include <algorithm>
#include <numeric>

namespace bough {
namespace {

using Edges = std::vector<std::array<std::int32_t, 2>>;

// Sets of indices that are joined one pair after another.
class Unions {
public:
    explicit Unions(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
    std::int32_t find(std::int32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    bool join(std::int32_t a, std::int32_t b) {
        a = find(a);
        b = find(b);
        if (a == b) return false;
        parent_[std::max(a, b)] = std::min(a, b);
        return true;
    }

private:
    std::vector<std::int32_t> parent_;
};

void leave_out_unused_points(LineGraph& g, ImportNotes& notes) {
    std::vector<std::int32_t> index(g.point.size(), -1);
    for (const auto& e : g.edge)
        for (const std::int32_t i : e) index[i] = 0;
    std::int32_t kept = 0;
    for (std::size_t i = 0; i < index.size(); ++i) {
        if (index[i] < 0) continue;
        g.point[kept] = g.point[i];
        g.radius[kept] = g.radius[i];
        index[i] = kept++;
    }
    if (std::size_t(kept) == g.point.size()) return;
    notes.lines.push_back(counted(g.point.size() - std::size_t(kept), "point", "points") + " without a line left out");
    g.point.resize(std::size_t(kept));
    g.radius.resize(std::size_t(kept));
    for (auto& e : g.edge) e = {index[e[0]], index[e[1]]};
}

void weld_points(LineGraph& g, ImportNotes& notes) {
    const std::size_t before = g.point.size();
    const std::vector<std::int32_t> index = weld(g.point, weld_tolerance(g.point));
    if (g.point.size() == before) return;
    std::vector<double> radius(g.point.size(), 0);
    for (std::size_t i = 0; i < before; ++i) radius[index[i]] = std::max(radius[index[i]], g.radius[i]);
    g.radius = std::move(radius);
    for (auto& e : g.edge) e = {index[e[0]], index[e[1]]};
    notes.lines.push_back(counted(before - g.point.size(), "point welded to another at its place",
                                  "points welded to others at their place"));
}

// By first point, then second: put into order by the first, which leaves a few of each to be sorted.
void sort_lines(Edges& edges, std::size_t points) {
    if (std::is_sorted(edges.begin(), edges.end())) return;
    std::vector<std::int32_t> at(points + 1, 0);
    for (const auto& e : edges) ++at[std::size_t(e[0]) + 1];
    std::partial_sum(at.begin(), at.end(), at.begin());
    Edges sorted(edges.size());
    for (const auto& e : edges) sorted[at[e[0]]++] = e;
    edges = std::move(sorted);
    for (auto first = edges.begin(); first != edges.end();) {
        const auto end = std::find_if(first, edges.end(), [&](const auto& e) { return e[0] != (*first)[0]; });
        if (end - first > 1) std::sort(first, end);
        first = end;
    }
}

void drop_repeated_lines(LineGraph& g, ImportNotes& notes) {
    const std::size_t before = g.edge.size();
    for (auto& e : g.edge)
        if (e[0] > e[1]) std::swap(e[0], e[1]);
    std::erase_if(g.edge, [](const auto& e) { return e[0] == e[1]; });
    const std::size_t points = before - g.edge.size();
    sort_lines(g.edge, g.point.size());
    g.edge.erase(std::unique(g.edge.begin(), g.edge.end()), g.edge.end());
    if (points > 0) notes.lines.push_back(counted(points, "line", "lines") + " without length left out");
    if (const std::size_t twice = before - points - g.edge.size())
        notes.lines.push_back(
            counted(twice, "line that repeats another left out", "lines that repeat others left out"));
}

// Keeps of each circle all lines but the thinnest, of equally thin ones the longest.
void cut_circles(LineGraph& g, ImportNotes& notes) {
    Unions unions(g.point.size());
    std::size_t closing = 0;
    for (const auto& e : g.edge) closing += !unions.join(e[0], e[1]);
    if (closing == 0) return;
    const auto thickness = [&](const auto& e) { return std::max(0.0, std::min(g.radius[e[0]], g.radius[e[1]])); };
    const auto length = [&](const auto& e) { return (g.point[e[1]] - g.point[e[0]]).squaredNorm(); };
    std::stable_sort(g.edge.begin(), g.edge.end(), [&](const auto& a, const auto& b) {
        const double thick_a = thickness(a), thick_b = thickness(b);
        return thick_a != thick_b ? thick_a > thick_b : length(a) < length(b);
    });
    Unions kept(g.point.size());
    std::erase_if(g.edge, [&](const auto& e) { return !kept.join(e[0], e[1]); });
    notes.lines.push_back(counted(closing, "line cut that closes a circle, its thinnest or longest",
                                  "lines cut that close circles, the thinnest or longest of each"));
}

// Neighbours of each point: others[first[i]] .. others[first[i + 1] - 1].
struct Neighbours {
    std::vector<std::int32_t> first, others;
    Neighbours() = default;
    Neighbours(std::size_t points, const Edges& edges) : first(points + 2, 0), others(2 * edges.size()) {
        for (const auto& e : edges)
            for (const std::int32_t i : e) ++first[i + 2];
        std::partial_sum(first.begin(), first.end(), first.begin());
        for (const auto& e : edges) {
            others[first[e[0] + 1]++] = e[1];
            others[first[e[1] + 1]++] = e[0];
        }
        first.pop_back();
    }
    std::int32_t count(std::int32_t i) const { return first[i + 1] - first[i]; }
};

// The connected parts, numbered in the order of their first points.
Pieces pieces_of(LineGraph& g, const Neighbours& near) {
    Pieces pieces;
    std::vector<std::int32_t> piece_of(g.point.size(), -1), open;
    for (std::size_t start = 0; start < g.point.size(); ++start) {
        if (piece_of[start] >= 0 || near.count(std::int32_t(start)) == 0) continue;
        const std::int32_t piece = std::int32_t(pieces.first.size());
        pieces.first.push_back(pieces.end.size());
        open.push_back(std::int32_t(start));
        piece_of[start] = piece;
        while (!open.empty()) {
            const std::int32_t i = open.back();
            open.pop_back();
            if (near.count(i) == 1) pieces.end.push_back(i);
            for (std::int32_t k = near.first[i]; k < near.first[i + 1]; ++k) {
                if (piece_of[near.others[k]] >= 0) continue;
                piece_of[near.others[k]] = piece;
                open.push_back(near.others[k]);
            }
        }
    }
    pieces.base.assign(pieces.first.size(), -1);
    pieces.first.push_back(pieces.end.size());
    pieces.segment.reserve(g.edge.size());
    for (const auto& e : g.edge) pieces.segment.push_back({e[0], e[1], piece_of[e[0]]});
    pieces.point = std::move(g.point);
    pieces.radius = std::move(g.radius);
    return pieces;
}

// Parents within each part, outward from where it begins.
std::vector<std::int32_t> parents_from(const std::vector<JoinedPiece>& joined, const Neighbours& near,
                                       std::size_t points) {
    std::vector<std::int32_t> parent(points, -1), open;
    for (const JoinedPiece& piece : joined) {
        open.push_back(piece.end);
        while (!open.empty()) {
            const std::int32_t i = open.back();
            open.pop_back();
            for (std::int32_t k = near.first[i]; k < near.first[i + 1]; ++k) {
                const std::int32_t other = near.others[k];
                if (other == parent[i]) continue;
                parent[other] = i;
                open.push_back(other);
            }
        }
    }
    return parent;
}

// A joint between two points: a node is put there for the part that begins on it.
struct Inserted {
    std::int32_t outer;  // the one of the two points whose parent is the other
    double from_inner;   // fraction of the way from that parent
    std::int32_t begins; // the first point of the part
};

void insert_joints(Skeleton& s, std::vector<Inserted>& joints) {
    std::sort(joints.begin(), joints.end(), [](const Inserted& a, const Inserted& b) {
        return std::tuple(a.outer, a.from_inner, a.begins) < std::tuple(b.outer, b.from_inner, b.begins);
    });
    Vec3 inner, outer;
    double inner_radius = 0, outer_radius = 0;
    for (std::size_t k = 0; k < joints.size(); ++k) {
        const Inserted& joint = joints[k];
        if (k == 0 || joints[k - 1].outer != joint.outer) {
            inner = s.point[s.parent[joint.outer]];
            outer = s.point[joint.outer];
            inner_radius = s.radius[s.parent[joint.outer]];
            outer_radius = s.radius[joint.outer];
        }
        const std::int32_t node = std::int32_t(s.point.size());
        s.point.push_back(inner + joint.from_inner * (outer - inner));
        const bool known = inner_radius > 0 && outer_radius > 0;
        s.radius.push_back(known ? inner_radius + joint.from_inner * (outer_radius - inner_radius) : 0);
        s.parent.push_back(s.parent[joint.outer]);
        s.loose.push_back(false);
        s.parent[joint.outer] = node;
        s.parent[joint.begins] = node;
    }
}

void join_parts(Skeleton& s, const std::vector<JoinedPiece>& joined, ImportNotes& notes) {
    std::vector<Inserted> inserted;
    std::size_t loose = 0;
    double gap = 0;
    s.loose.assign(s.parent.size(), false);
    for (const JoinedPiece& piece : joined) {
        if (piece.parent < 0) continue;
        ++loose;
        gap = std::max(gap, piece.gap);
        s.loose[piece.end] = true;
        const bool b_outer = s.parent[piece.b] == piece.a;
        const double t = b_outer ? piece.t : 1 - piece.t;
        const std::int32_t outer = b_outer ? piece.b : piece.a, inner = b_outer ? piece.a : piece.b;
        if (t <= 0 || t >= 1)
            s.parent[piece.end] = t <= 0 ? inner : outer;
        else
            inserted.push_back({outer, t, piece.end});
    }
    insert_joints(s, inserted);
    if (loose > 0)
        notes.lines.push_back(counted(loose, "loose part", "loose parts") +
                              " attached to the nearest branch, over a gap of up to " + shown(gap));
}

} // namespace

RootedLines root_lines(LineGraph&& g, char up, const std::string& name, ImportNotes& notes) {
    if (g.radius.empty()) g.radius.assign(g.point.size(), 0);
    leave_out_unused_points(g, notes);
    weld_points(g, notes);
    drop_repeated_lines(g, notes);
    if (g.edge.empty()) throw InputError(name, "holds no line with a length, expected at least one");
    cut_circles(g, notes);
    Neighbours near(g.point.size(), g.edge);
    Pieces pieces = pieces_of(g, near);
    release(g.edge);
    RootedLines result;
    result.up = up;
    if (up == 0) {
        result.up = likely_up(pieces.point, pieces.radius, pieces.segment);
        note_guessed_up(result.up, notes);
    }
    const std::vector<JoinedPiece> joined = attach_pieces(pieces, result.up);
    Skeleton s;
    s.parent = parents_from(joined, near, pieces.point.size());
    near = {};
    s.point = std::move(pieces.point);
    s.radius = std::move(pieces.radius);
    for (double& r : s.radius) r = std::max(0.0, r);
    join_parts(s, joined, notes);
    result.branches = branches_of(std::move(s), name, notes);
    return result;
}

ImportedTree tree_of_lines(LineGraph&& g, char up, const std::string& name, ImportNotes& notes) {
    RootedLines rooted = root_lines(std::move(g), up, name, notes);
    fill_radii(rooted.branches, notes);
    ImportedTree tree;
    tree.branches = std::move(rooted.branches);
    tree.up = rooted.up;
    return tree;
}

} // namespace bough
