#include "mesh_interior.h"
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>

namespace bough {
namespace {

constexpr double least_share = 0.02; // of all triangles, that a line crosses where their corners are out of order

std::tuple<double, double, double> coordinates(const Vec3& p) {
    return {p.x(), p.y(), p.z()};
}

// +1, -1 or 0: how the projected edge from a to b winds about (u, v), counted where it crosses the line of v on the
// far side of u. The number that decides is formed from the lower end to the upper, whichever way the edge runs.
int winding(const Vec3& a, const Vec3& b, int iu, int iv, double u, double v) {
    const bool up = a[iv] <= v && v < b[iv], down = b[iv] <= v && v < a[iv];
    if (!up && !down) return 0;
    const Vec3 &low = up ? a : b, &high = up ? b : a;
    const double side = (high[iu] - low[iu]) * (v - low[iv]) - (u - low[iu]) * (high[iv] - low[iv]);
    if (!(side > 0)) return 0;
    return up ? 1 : -1;
}

} // namespace

int MeshInterior::Plane::column(double u) const {
    return std::clamp(static_cast<int>((u - u0) / u_cell), 0, columns - 1);
}
int MeshInterior::Plane::row(double v) const {
    return std::clamp(static_cast<int>((v - v0) / v_cell), 0, rows - 1);
}

MeshInterior::MeshInterior(const std::vector<Vec3>& vertex, const std::vector<Triangle>& triangle) {
    weld(vertex, triangle);
    measure();
    lower_ = upper_ = vertex_[static_cast<std::size_t>(triangle_[0][0])];
    for (const Triangle& t : triangle_)
        for (const std::int32_t c : t) {
            lower_ = lower_.cwiseMin(vertex_[static_cast<std::size_t>(c)]);
            upper_ = upper_.cwiseMax(vertex_[static_cast<std::size_t>(c)]);
        }
    count_crossings();
    for (int axis = 0; axis < 3; ++axis) plane_[static_cast<std::size_t>(axis)] = plane(axis);
}

// A line along an axis meets a triangle with the chance that its projection's area has in that of the box.
void MeshInterior::count_crossings() {
    const Vec3 size = (upper_ - lower_).cwiseMax(1e-300);
    Vec3 area = Vec3::Zero();
    for (const Triangle& t : triangle_) {
        const auto at = [&](std::size_t k) { return vertex_[static_cast<std::size_t>(t[k])]; };
        area += (at(1) - at(0)).cross(at(2) - at(0)).cwiseAbs() / 2;
    }
    for (int axis = 0; axis < 3; ++axis)
        closure_.crossings += area[axis] / (size[(axis + 1) % 3] * size[(axis + 2) % 3]) / 3;
    if (closure_.crossings > most_crossings && closure_.crossings > least_share * static_cast<double>(triangle_.size()))
        throw std::invalid_argument("a straight line through it crosses " +
                                    std::to_string(std::llround(closure_.crossings)) + " of its " +
                                    std::to_string(triangle_.size()) + " triangles on average, expected at most " +
                                    std::to_string(std::llround(most_crossings)) +
                                    ", as through the surface of a crown; are the corners of its faces in order?");
}

// Equal positions become one corner; triangles without three different ones are left out.
void MeshInterior::weld(const std::vector<Vec3>& vertex, const std::vector<Triangle>& triangle) {
    for (const Vec3& p : vertex)
        if (!p.allFinite()) throw std::invalid_argument("a vertex is not finite, expected numbers");
    std::vector<std::int32_t> order(vertex.size()), corner(vertex.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        return coordinates(vertex[static_cast<std::size_t>(a)]) < coordinates(vertex[static_cast<std::size_t>(b)]);
    });
    for (const std::int32_t i : order) {
        const Vec3& p = vertex[static_cast<std::size_t>(i)];
        if (vertex_.empty() || vertex_.back() != p) vertex_.push_back(p);
        corner[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(vertex_.size()) - 1;
    }
    for (const Triangle& t : triangle) {
        Triangle welded;
        for (std::size_t k = 0; k < 3; ++k) {
            if (t[k] < 0 || static_cast<std::size_t>(t[k]) >= vertex.size())
                throw std::invalid_argument("a triangle names vertex " + std::to_string(t[k]) + ", expected 0 to " +
                                            std::to_string(static_cast<std::int64_t>(vertex.size()) - 1));
            welded[k] = corner[static_cast<std::size_t>(t[k])];
        }
        if (welded[0] != welded[1] && welded[1] != welded[2] && welded[2] != welded[0]) triangle_.push_back(welded);
    }
    if (triangle_.empty()) throw std::invalid_argument("no triangle has an area, expected a closed mesh");
}

void MeshInterior::measure() {
    struct Edge {
        std::int32_t low, high;
        int way;
        auto operator<=>(const Edge&) const = default;
    };
    std::vector<Edge> edge;
    for (const Triangle& t : triangle_)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t a = t[k], b = t[(k + 1) % 3];
            edge.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
        }
    std::sort(edge.begin(), edge.end());
    closure_.triangles = static_cast<std::int64_t>(triangle_.size());
    closure_.alike = true;
    for (std::size_t i = 0; i < edge.size();) {
        std::size_t end = i;
        int ways = 0;
        for (; end < edge.size() && edge[end].low == edge[i].low && edge[end].high == edge[i].high; ++end)
            ways += edge[end].way;
        closure_.open_edges += static_cast<std::int64_t>((end - i) % 2);
        closure_.alike = closure_.alike && ways == 0;
        i = end;
    }
    const Vec3 origin = vertex_[static_cast<std::size_t>(triangle_[0][0])];
    double six = 0;
    for (const Triangle& t : triangle_) {
        const auto at = [&](std::size_t k) { return Vec3(vertex_[static_cast<std::size_t>(t[k])] - origin); };
        six += at(0).dot(at(1).cross(at(2)));
    }
    closure_.volume = six / 6;
}

// As many cells as triangles, fewer where long triangles would stand in too many of them.
MeshInterior::Plane MeshInterior::plane(int axis) const {
    const int iu = (axis + 1) % 3, iv = (axis + 2) % 3;
    const auto count = static_cast<double>(triangle_.size());
    const double du = std::max(upper_[iu] - lower_[iu], 1e-300), dv = std::max(upper_[iv] - lower_[iv], 1e-300);
    for (double cells = count;; cells /= 4) {
        Plane p;
        p.columns = static_cast<int>(std::clamp(std::ceil(std::sqrt(cells * std::min(du / dv, 1e9))), 1.0, 4096.0));
        p.rows = static_cast<int>(std::clamp(std::ceil(cells / p.columns), 1.0, 4096.0));
        p.u0 = lower_[iu], p.v0 = lower_[iv];
        p.u_cell = du / p.columns, p.v_cell = dv / p.rows;
        const bool one = p.columns == 1 && p.rows == 1;
        if (fill(p, axis, one ? SIZE_MAX : 16 * triangle_.size() + 64)) return p;
    }
}

// Lists the triangles of each cell; false as soon as the lists exceed `most` entries.
bool MeshInterior::fill(Plane& p, int axis, std::size_t most) const {
    const int iu = (axis + 1) % 3, iv = (axis + 2) % 3;
    const auto each_cell = [&](std::size_t t, auto&& visit) {
        Vec3 low = vertex_[static_cast<std::size_t>(triangle_[t][0])], high = low;
        for (const std::int32_t c : triangle_[t]) {
            low = low.cwiseMin(vertex_[static_cast<std::size_t>(c)]);
            high = high.cwiseMax(vertex_[static_cast<std::size_t>(c)]);
        }
        for (int r = p.row(low[iv]); r <= p.row(high[iv]); ++r)
            for (int c = p.column(low[iu]); c <= p.column(high[iu]); ++c)
                visit(static_cast<std::size_t>(r) * static_cast<std::size_t>(p.columns) + static_cast<std::size_t>(c));
    };
    p.first.assign(static_cast<std::size_t>(p.columns) * static_cast<std::size_t>(p.rows) + 1, 0);
    std::size_t total = 0;
    for (std::size_t t = 0; t < triangle_.size(); ++t) {
        each_cell(t, [&](std::size_t cell) { ++p.first[cell + 1], ++total; });
        if (total > most) return false;
    }
    std::partial_sum(p.first.begin(), p.first.end(), p.first.begin());
    p.triangle.resize(total);
    std::vector<std::int32_t> next(p.first.begin(), p.first.end() - 1);
    for (std::size_t t = 0; t < triangle_.size(); ++t)
        each_cell(t, [&](std::size_t cell) {
            p.triangle[static_cast<std::size_t>(next[cell]++)] = static_cast<std::int32_t>(t);
        });
    return true;
}

MeshInterior::Crossings MeshInterior::cross(const Vec3& point, int axis) const {
    const int iu = (axis + 1) % 3, iv = (axis + 2) % 3;
    const Plane& p = plane_[static_cast<std::size_t>(axis)];
    const double u = point[iu], v = point[iv];
    const auto cell = static_cast<std::size_t>(p.row(v)) * static_cast<std::size_t>(p.columns) +
                      static_cast<std::size_t>(p.column(u));
    Crossings found;
    for (auto i = static_cast<std::size_t>(p.first[cell]); i < static_cast<std::size_t>(p.first[cell + 1]); ++i) {
        const Triangle& t = triangle_[static_cast<std::size_t>(p.triangle[i])];
        const Vec3 &a = vertex_[static_cast<std::size_t>(t[0])], &b = vertex_[static_cast<std::size_t>(t[1])],
                   &c = vertex_[static_cast<std::size_t>(t[2])];
        const int turn = winding(a, b, iu, iv, u, v) + winding(b, c, iu, iv, u, v) + winding(c, a, iu, iv, u, v);
        if (turn == 0) continue;
        const Vec3 normal = (b - a).cross(c - a);
        // Height of the plane over the point, times the normal's component, whose sign is the turn's.
        const double over = normal.dot(a - point) * (normal[axis] > 0 ? 1 : -1);
        (over > 0 ? found.above : found.below) += closure_.alike ? turn : 1;
    }
    return found;
}

bool MeshInterior::contains(const Vec3& point) const {
    for (int k = 0; k < 3; ++k)
        if (!(point[k] >= lower_[k] && point[k] <= upper_[k])) return false;
    int votes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const Crossings found = cross(point, axis);
        if (closure_.alike)
            votes += (found.above != 0) + (found.below != 0);
        else
            votes += (found.above % 2 != 0) + (found.below % 2 != 0);
        // Where each point stands under hundreds of triangles, as in a mesh out of order, the third axis is worth leaving out.
        if (votes >= 4 || votes + 2 * (2 - axis) < 4) break;
    }
    return votes >= 4;
}

} // namespace bough
