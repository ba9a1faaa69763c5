#include "mesh_measure.h"
#include <algorithm>
#include <numeric>
#include <tuple>

namespace bough {
namespace {

// Points in one place get the index of the first of them.
std::vector<std::int32_t> welded(const std::vector<Vec3>& point) {
    std::vector<std::int32_t> order(point.size()), first(point.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](std::int32_t i) {
        return std::tuple(point[std::size_t(i)].x(), point[std::size_t(i)].y(), point[std::size_t(i)].z(), i);
    };
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::int32_t i = order[k], before = k > 0 ? order[k - 1] : i;
        const bool same = k > 0 && point[std::size_t(i)] == point[std::size_t(before)];
        first[std::size_t(i)] = same ? first[std::size_t(before)] : i;
    }
    return first;
}

} // namespace

MeshMeasure measured(const std::vector<Vec3>& point, const std::vector<std::array<std::int32_t, 3>>& triangle) {
    const std::vector<std::int32_t> place = welded(point);
    std::vector<std::int32_t> piece(point.size());
    std::iota(piece.begin(), piece.end(), 0);
    const auto find = [&](std::int32_t i) {
        while (piece[std::size_t(i)] != i) i = piece[std::size_t(i)] = piece[std::size_t(piece[std::size_t(i)])];
        return i;
    };
    std::vector<std::pair<std::int32_t, std::int32_t>> edge;
    for (const auto& [a, b, c] : triangle) {
        const std::int32_t v[3] = {place[std::size_t(a)], place[std::size_t(b)], place[std::size_t(c)]};
        for (int k = 0; k < 3; ++k) {
            const std::int32_t p = v[k], q = v[(k + 1) % 3];
            if (p == q) continue; // without length
            edge.emplace_back(std::min(p, q), std::max(p, q));
            piece[std::size_t(find(p))] = find(q);
        }
    }
    std::sort(edge.begin(), edge.end());
    std::vector<char> open(point.size(), 0), used(point.size(), 0);
    for (std::size_t k = 0; k < edge.size();) {
        std::size_t end = k;
        while (end < edge.size() && edge[end] == edge[k]) ++end;
        if ((end - k) % 2 != 0) open[std::size_t(find(edge[k].first))] = 1;
        k = end;
    }
    MeshMeasure made;
    for (const auto& [a, b, c] : triangle) {
        const Vec3 &p = point[std::size_t(a)], &q = point[std::size_t(b)], &r = point[std::size_t(c)];
        const std::size_t root = std::size_t(find(place[std::size_t(a)]));
        made.area += (q - p).cross(r - p).norm() / 2 * (open[root] ? 1 : 0.5);
        made.pieces += used[root] == 0;
        used[root] = 1;
    }
    return made;
}

} // namespace bough
