#include "bark_twigs.h"
#include "imported_tree.h"
#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <queue>

namespace bough {
namespace {

constexpr double slenderness = 8, least_filled = 0.2, most_filled = 3;
constexpr double bark_reach = 2;   // in radii
constexpr double least_left = 0.2; // of the radius, from slice to slice
constexpr int slices = 24;

struct Piece {
    std::vector<std::int32_t> point, triangle;
};

// A piece's edges, both ways; indices within the piece.
using NodeEdges = std::vector<std::vector<std::int32_t>>;

NodeEdges edges_of(const BarkSurface& surface, const Piece& piece, const std::vector<std::int32_t>& local) {
    NodeEdges beside(piece.point.size());
    for (const std::int32_t t : piece.triangle)
        for (int k = 0; k < 3; ++k) {
            const std::int32_t a = local[surface.triangle[t][k]], b = local[surface.triangle[t][(k + 1) % 3]];
            beside[a].push_back(b);
            beside[b].push_back(a);
        }
    return beside;
}

// Ways along edges to each point, from those where they are 0 already; all others are infinite.
void walk(const BarkSurface& surface, const Piece& piece, const NodeEdges& beside, std::vector<double>& way) {
    using Open = std::pair<double, std::int32_t>;
    std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
    for (std::size_t k = 0; k < way.size(); ++k)
        if (way[k] == 0) open.emplace(0, std::int32_t(k));
    while (!open.empty()) {
        const auto [so_far, at] = open.top();
        open.pop();
        if (so_far > way[at]) continue;
        for (const std::int32_t next : beside[at]) {
            const double to = so_far + (surface.point[piece.point[at]] - surface.point[piece.point[next]]).norm();
            if (to < way[next]) open.emplace(way[next] = to, next);
        }
    }
}

double volume_of(const BarkSurface& surface, const Piece& piece) {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t p : piece.point) middle += surface.point[p] / double(piece.point.size());
    double volume = 0;
    for (const std::int32_t t : piece.triangle) {
        const auto& corner = surface.triangle[t];
        const Vec3 a = surface.point[corner[0]] - middle, b = surface.point[corner[1]] - middle;
        volume += a.cross(b).dot(surface.point[corner[2]] - middle) / 6;
    }
    return std::abs(volume);
}

// Where a piece is nearest to the axis of the bone that moves it there; -1: no bone moves it.
std::int32_t base_of(const BarkSurface& surface, const Piece& piece, const std::vector<speedtree::Bone>& bones) {
    std::int32_t base = -1;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < piece.point.size(); ++k) {
        const std::int32_t b = surface.bone[piece.point[k]];
        if (b < 0) continue;
        const Vec3 &from = bones[b].start, &to = bones[b].end, &p = surface.point[piece.point[k]];
        const double d = (from + projected(from, to, p) * (to - from) - p).norm();
        if (d < nearest) nearest = d, base = std::int32_t(k);
    }
    return base;
}

// Points of one slice that hang together.
struct BarkNode {
    std::int32_t parent = -1; // node of a slice before
    int slice = 0;
    double beyond = 0; // longest way along the axis to a tip
    std::vector<std::int32_t> point, child;
    Vec3 middle = Vec3::Zero();
};

std::vector<BarkNode> nodes_of(const BarkSurface& surface, const Piece& piece, const NodeEdges& beside,
                               const std::vector<int>& slice) {
    std::vector<BarkNode> nodes;
    std::vector<std::int32_t> node_of(slice.size(), -1), stack;
    for (std::size_t k = 0; k < slice.size(); ++k) {
        if (node_of[k] >= 0) continue;
        BarkNode node;
        node.slice = slice[k];
        stack = {std::int32_t(k)};
        node_of[k] = std::int32_t(nodes.size());
        while (!stack.empty()) {
            const std::int32_t at = stack.back();
            stack.pop_back();
            node.point.push_back(piece.point[at]);
            for (const std::int32_t next : beside[at])
                if (slice[next] == node.slice && node_of[next] < 0) node_of[next] = node_of[k], stack.push_back(next);
        }
        for (const std::int32_t p : node.point) node.middle += surface.point[p] / double(node.point.size());
        nodes.push_back(std::move(node));
    }
    for (std::size_t k = 0; k < slice.size(); ++k)
        for (const std::int32_t next : beside[k]) {
            BarkNode& after = nodes[node_of[next]];
            if (slice[k] >= after.slice) continue;
            if (after.parent < 0 || slice[k] > nodes[after.parent].slice) after.parent = node_of[k];
        }
    std::vector<std::int32_t> order(nodes.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return nodes[a].slice > nodes[b].slice; });
    for (const std::int32_t n : order) {
        const std::int32_t p = nodes[n].parent;
        if (p < 0) continue;
        nodes[p].child.push_back(n);
        nodes[p].beyond = std::max(nodes[p].beyond, nodes[n].beyond + (nodes[n].middle - nodes[p].middle).norm());
    }
    return nodes;
}

double radius_about(const BarkSurface& surface, const BarkNode& node, const Vec3& along) {
    double sum = 0;
    for (const std::int32_t p : node.point) sum += along.cross(surface.point[p] - node.middle).norm();
    return sum / double(node.point.size());
}

double length_of(const Twig& twig) {
    double length = 0;
    for (std::size_t k = 1; k < twig.point.size(); ++k) length += (twig.point[k] - twig.point[k - 1]).norm();
    return length;
}

double median_of(std::vector<double> of) {
    std::nth_element(of.begin(), of.begin() + std::ptrdiff_t(of.size() / 2), of.end());
    return of[of.size() / 2];
}

// From a node along the longest way; the others that fork off it are put on `forks`, each behind the node that it leaves.
Twig follow(const BarkSurface& surface, const std::vector<BarkNode>& nodes, std::int32_t from, std::int32_t next,
            std::vector<std::pair<std::int32_t, std::int32_t>>& forks) {
    std::vector<std::int32_t> line{from};
    for (std::int32_t at = next; at >= 0;) {
        if (nodes[at].point.size() >= 3 || nodes[at].child.empty()) line.push_back(at); // fewer are no ring
        std::int32_t on = -1;
        for (const std::int32_t child : nodes[at].child)
            if (on < 0 || nodes[child].beyond > nodes[on].beyond) on = child;
        for (const std::int32_t child : nodes[at].child)
            if (child != on) forks.emplace_back(at, child);
        at = on;
    }
    Twig twig;
    for (std::size_t k = 0; k < line.size(); ++k) {
        const Vec3 along = nodes[line[std::min(k + 1, line.size() - 1)]].middle - nodes[line[k > 0 ? k - 1 : 0]].middle;
        twig.point.push_back(nodes[line[k]].middle);
        twig.radius.push_back(radius_about(surface, nodes[line[k]], along.normalized()));
    }
    // At a fork the first slice is another's; at a base it may stand askew.
    if (twig.radius.size() > 1)
        twig.radius[0] = nodes[from].parent >= 0 ? twig.radius[1] : std::max(twig.radius[0], twig.radius[1]);
    return twig;
}

constexpr double unknown = std::numeric_limits<double>::infinity();

// Ways from the ring around a point; all of it is at 0, so that rings lie within slices.
std::vector<double> ways_from_ring(const BarkSurface& surface, const Piece& piece, const NodeEdges& beside,
                                   std::int32_t base, double thick) {
    std::vector<double> way(piece.point.size(), unknown);
    way[base] = 0;
    walk(surface, piece, beside, way);
    for (double& w : way) w = w <= 3 * thick ? 0 : unknown;
    walk(surface, piece, beside, way);
    return way;
}

// The skeleton from a base, its longest line first; radii as they are found.
std::vector<Twig> skeleton_from(const BarkSurface& surface, const Piece& piece, const NodeEdges& beside,
                                std::int32_t base, double thick) {
    const std::vector<double> way = ways_from_ring(surface, piece, beside, base, thick);
    const double longest = *std::max_element(way.begin(), way.end());
    const int parts = std::clamp(int(longest / (3 * thick)), 2, slices);
    std::vector<int> slice;
    for (const double w : way) slice.push_back(longest > 0 ? std::min(parts - 1, int(w / longest * parts)) : 0);
    const std::vector<BarkNode> nodes = nodes_of(surface, piece, beside, slice);
    std::vector<std::pair<std::int32_t, std::int32_t>> forks;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        if (nodes[n].parent >= 0) continue;
        for (const std::int32_t child : nodes[n].child) forks.emplace_back(std::int32_t(n), child);
    }
    std::vector<Twig> twigs;
    while (!forks.empty()) {
        const auto [from, next] = forks.back();
        forks.pop_back();
        twigs.push_back(follow(surface, nodes, from, next, forks));
    }
    const auto longer = [](const Twig& a, const Twig& b) { return length_of(a) < length_of(b); };
    if (!twigs.empty()) std::iter_swap(twigs.begin(), std::max_element(twigs.begin(), twigs.end(), longer));
    return twigs;
}

// A piece's stem and what forks off it; nothing for what is no wood.
std::vector<Twig> twigs_of(const BarkSurface& surface, const Piece& piece, const std::vector<std::int32_t>& local,
                           const std::vector<speedtree::Bone>& bones) {
    const std::int32_t base = base_of(surface, piece, bones);
    const double volume = volume_of(surface, piece);
    if (base < 0 || !(volume > 0)) return {};
    const NodeEdges beside = edges_of(surface, piece, local);
    const std::vector<double> way = ways_from_ring(surface, piece, beside, base, 0);
    const auto far_end = std::max_element(way.begin(), way.end());
    if (!(*far_end > 0)) return {};
    const double thick = std::sqrt(volume / (0.5 * std::numbers::pi * *far_end));
    std::vector<Twig> twigs = skeleton_from(surface, piece, beside, base, thick);
    // A tip that leans on a bone is no base.
    const auto thins = [](const Twig& twig) {
        const auto half = twig.radius.begin() + std::ptrdiff_t(twig.radius.size() / 2);
        return median_of({twig.radius.begin(), half}) >= median_of({half, twig.radius.end()});
    };
    if (!twigs.empty() && !thins(twigs.front()))
        twigs = skeleton_from(surface, piece, beside, std::int32_t(far_end - way.begin()), thick);
    if (twigs.empty()) return {};
    double wood = 0;
    for (Twig& twig : twigs) {
        // Where it forks the slice is wider than the wood.
        std::vector<double>& r = twig.radius;
        for (std::size_t k = 1; k < r.size(); ++k) r[k] = std::clamp(r[k], least_left * r[k - 1], r[k - 1]);
        for (std::size_t k = 1; k < r.size(); ++k)
            wood += std::numbers::pi / 3 * (twig.point[k] - twig.point[k - 1]).norm() *
                    (r[k] * r[k] + r[k] * r[k - 1] + r[k - 1] * r[k - 1]);
    }
    const bool filled = volume > least_filled * wood && volume < most_filled * wood;
    return filled && length_of(twigs.front()) >= slenderness * twigs.front().radius.front() ? twigs
                                                                                            : std::vector<Twig>();
}

// Points of the pieces that rings of bark are on, no farther from the bone that moves them than its bark: a shoot may be welded to it.
std::vector<char> bark_points(const Bark& bark, const std::vector<speedtree::Bone>& bones,
                              const std::vector<BarkTaper>& tapers) {
    const BarkSurface& surface = bark.surface();
    std::vector<char> of_bark(surface.point.size(), false), result(surface.point.size(), false);
    for (const BarkTaper& taper : tapers)
        for (const std::int32_t piece : taper.pieces) of_bark[piece] = true;
    for (std::size_t p = 0; p < surface.point.size(); ++p) {
        const std::int32_t b = surface.bone[p];
        if (!of_bark[bark.piece(std::int32_t(p))]) continue;
        if (b < 0 || !(tapers[b].start > 0)) { // nobody knows
            result[p] = true;
            continue;
        }
        const Vec3 &from = bones[b].start, &to = bones[b].end;
        const double off = (from + projected(from, to, surface.point[p]) * (to - from) - surface.point[p]).norm();
        result[p] = off <= bark_reach * std::max(tapers[b].start, tapers[b].end);
    }
    return result;
}

} // namespace

std::vector<Twig> twigs_without_bones(const Bark& bark, const std::vector<speedtree::Bone>& bones,
                                      const std::vector<BarkTaper>& tapers) {
    const BarkSurface& surface = bark.surface();
    const std::vector<char> is_bark = bark_points(bark, bones, tapers);
    const auto left = [&](const std::array<std::int32_t, 3>& corner) {
        return !is_bark[corner[0]] && !is_bark[corner[1]] && !is_bark[corner[2]];
    };
    // The first point of each connected piece of what is left.
    std::vector<std::int32_t> first(surface.point.size());
    std::iota(first.begin(), first.end(), 0);
    const auto find = [&](std::int32_t p) {
        while (first[p] != p) p = first[p] = first[first[p]];
        return p;
    };
    for (const auto& corner : surface.triangle)
        for (int k = 1; left(corner) && k < 3; ++k) {
            const std::int32_t a = find(corner[0]), b = find(corner[k]);
            first[std::max(a, b)] = std::min(a, b);
        }
    std::map<std::int32_t, Piece> pieces;
    std::vector<std::int32_t> local(surface.point.size(), -1);
    for (std::size_t t = 0; t < surface.triangle.size(); ++t) {
        const auto& corner = surface.triangle[t];
        if (!left(corner)) continue;
        Piece& piece = pieces[find(corner[0])];
        piece.triangle.push_back(std::int32_t(t));
        for (const std::int32_t p : corner) {
            if (local[p] >= 0) continue;
            local[p] = std::int32_t(piece.point.size());
            piece.point.push_back(p);
        }
    }
    std::vector<Twig> twigs;
    for (const auto& [at, piece] : pieces)
        for (Twig& twig : twigs_of(surface, piece, local, bones)) twigs.push_back(std::move(twig));
    return twigs;
}

} // namespace bough
