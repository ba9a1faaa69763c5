#include "bark.h"
#include "disjoint_sets.h"
#include <algorithm>
#include <numbers>
#include <numeric>

namespace bough {
namespace {

constexpr double degrees_per_radian = 180 / std::numbers::pi;

struct Circle {
    double radius = -1; // below 0: none
    Vec3 center = Vec3::Zero();
    bool square = false;
};

// The largest angle between neighbours, seen from a middle.
double largest_gap(const std::vector<Eigen::Vector2d>& at, const Eigen::Vector2d& middle) {
    std::vector<double> angle;
    for (const Eigen::Vector2d& p : at) angle.push_back(std::atan2(p.y() - middle.y(), p.x() - middle.x()));
    std::sort(angle.begin(), angle.end());
    double gap = angle.front() + 2 * std::numbers::pi - angle.back();
    for (std::size_t k = 1; k < angle.size(); ++k) gap = std::max(gap, angle[k] - angle[k - 1]);
    return gap;
}

// The circle that minimizes the sum of (|p - c|^2 - r^2)^2 (Kasa 1976), seen along a unit direction.
Circle circle_through(const std::vector<Vec3>& points, const Vec3& along) {
    constexpr double most_off = 0.3, least_round = 0.45; // the latter is 1 of a circle, 0 of a line
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : points) mean += p / double(points.size());
    if (points.size() == 1) return {0, mean, false};
    if (points.size() < 3) return {};
    const Vec3 u = along.unitOrthogonal(), v = along.cross(u);
    std::vector<Eigen::Vector2d> at;
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    double squares = 0;
    for (const Vec3& p : points) {
        at.emplace_back((p - mean).dot(u), (p - mean).dot(v));
        A += at.back() * at.back().transpose();
        b += 0.5 * at.back().squaredNorm() * at.back();
        squares += at.back().squaredNorm() / double(points.size());
    }
    if (!(4 * A.determinant() > least_round * A.trace() * A.trace())) return {};
    const Eigen::Vector2d middle = A.inverse() * b;
    const double radius = std::sqrt(squares + middle.squaredNorm());
    double off = 0;
    for (const Eigen::Vector2d& p : at) {
        const double d = (p - middle).norm() - radius;
        off += d * d / double(points.size());
    }
    const double gap = largest_gap(at, middle);
    if (!(off <= most_off * most_off * radius * radius) || gap >= std::numbers::pi) return {};
    return {radius, mean + middle.x() * u + middle.y() * v, at.size() == 4 && gap < 100 / degrees_per_radian};
}

// Triangles name the first of all points in one place.
void weld_surface(BarkSurface& surface) {
    std::vector<std::int32_t> order(surface.point.size()), one(surface.point.size());
    std::iota(order.begin(), order.end(), 0);
    const auto before = [&](std::int32_t a, std::int32_t b) {
        const Vec3 &p = surface.point[a], &q = surface.point[b];
        for (int k = 0; k < 3; ++k)
            if (p[k] != q[k]) return p[k] < q[k];
        return a < b;
    };
    std::sort(order.begin(), order.end(), before);
    for (std::size_t k = 0; k < order.size(); ++k)
        one[order[k]] = k > 0 && surface.point[order[k]] == surface.point[order[k - 1]] ? one[order[k - 1]] : order[k];
    for (auto& triangle : surface.triangle)
        for (std::int32_t& corner : triangle) corner = one[corner];
}

} // namespace

Bark::Bark(BarkSurface surface, std::size_t bones) : surface_(std::move(surface)) {
    weld_surface(surface_);
    DisjointSets pieces(surface_.point.size());
    const auto each = [&](auto&& use) { // (triangle, bone), each pair once
        for (std::size_t t = 0; t < surface_.triangle.size(); ++t) {
            const auto& corner = surface_.triangle[t];
            for (int k = 0; k < 3; ++k) {
                const std::int32_t b = surface_.bone[corner[k]];
                bool fresh = b >= 0;
                for (int j = 0; j < k; ++j) fresh = fresh && surface_.bone[corner[j]] != b;
                if (fresh) use(std::int32_t(t), std::size_t(b));
            }
        }
    };
    first_.assign(bones + 1, 0);
    each([&](std::int32_t, std::size_t b) { ++first_[b + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    of_bone_.resize(std::size_t(first_.back()));
    std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
    each([&](std::int32_t t, std::size_t b) { of_bone_[next[b]++] = t; });
    for (const auto& corner : surface_.triangle) pieces.join(corner[0], corner[1]), pieces.join(corner[0], corner[2]);
    piece_.resize(surface_.point.size());
    for (std::size_t p = 0; p < piece_.size(); ++p) piece_[p] = pieces.find(std::int32_t(p));
}

BarkRing Bark::ring(std::int32_t bone, const Vec3& place, const Vec3& across) const {
    const auto height = [&](std::int32_t p) { return (surface_.point[p] - place).dot(across); };
    std::vector<std::int32_t> cut; // triangles
    std::vector<std::pair<std::uint64_t, std::int32_t>> edge;
    for (std::int32_t k = first_[bone]; k < first_[bone + 1]; ++k) {
        const auto& corner = surface_.triangle[of_bone_[k]];
        bool beyond[3];
        for (int j = 0; j < 3; ++j) beyond[j] = height(corner[j]) >= 0;
        if (beyond[0] == beyond[1] && beyond[0] == beyond[2]) continue;
        for (int j = 0; j < 3; ++j) {
            const std::uint32_t a = std::uint32_t(corner[j]), b = std::uint32_t(corner[(j + 1) % 3]);
            if (beyond[j] == beyond[(j + 1) % 3]) continue;
            edge.emplace_back(std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), std::int32_t(cut.size()));
        }
        cut.push_back(of_bone_[k]);
    }
    std::sort(edge.begin(), edge.end());
    DisjointSets sets(cut.size());
    for (std::size_t k = 1; k < edge.size(); ++k)
        if (edge[k].first == edge[k - 1].first) sets.join(edge[k].second, edge[k - 1].second);
    std::vector<std::pair<std::int32_t, std::int32_t>> corners; // (cut, point)
    for (std::size_t c = 0; c < cut.size(); ++c)
        for (const std::int32_t p : surface_.triangle[cut[c]]) corners.emplace_back(sets.find(std::int32_t(c)), p);
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    BarkRing best;
    for (std::size_t from = 0, to = 0; from < corners.size(); from = to) {
        std::vector<Vec3> side[2];
        double away[2] = {0, 0};
        Vec3 mean[2] = {Vec3::Zero(), Vec3::Zero()};
        for (; to < corners.size() && corners[to].first == corners[from].first; ++to) {
            const std::int32_t p = corners[to].second;
            const int s = height(p) >= 0;
            side[s].push_back(surface_.point[p]);
            mean[s] += surface_.point[p];
            away[s] += std::abs(height(p));
        }
        for (int s = 0; s < 2; ++s) mean[s] /= double(side[s].size()), away[s] /= double(side[s].size());
        // Rings that stand close say little of the way from one to the other.
        double wide = 0;
        for (const Vec3& p : side[0]) wide = std::max(wide, (p - mean[0]).norm());
        for (const Vec3& p : side[1]) wide = std::max(wide, (p - mean[1]).norm());
        Vec3 along = mean[1] - mean[0];
        along = along.norm() > 0.5 * wide && along.dot(across) > 0.5 * along.norm() ? Vec3(along.normalized()) : across;
        const Circle before = circle_through(side[0], along), beyond = circle_through(side[1], along);
        const double sum = away[0] + away[1], t = sum > 0 ? away[0] / sum : 0.5;
        BarkRing ring;
        if (before.radius >= 0 && beyond.radius >= 0) {
            ring.radius = (1 - t) * before.radius + t * beyond.radius;
            ring.center = (1 - t) * before.center + t * beyond.center;
            ring.square = before.square && beyond.square;
        } else {
            const Circle& one = before.radius > 0 ? before : beyond;
            ring.radius = one.radius;
            ring.center = one.center - along * ((one.center - place).dot(across) / along.dot(across));
        }
        if (!(ring.radius > best.radius) || (ring.center - place).norm() > 2 * ring.radius) continue;
        ring.piece = piece_[corners[from].second];
        best = ring;
    }
    return best;
}

double Bark::reach(std::int32_t bone, std::int32_t piece, const Vec3& place, const Vec3& direction,
                   double within) const {
    double farthest = 0;
    for (std::int32_t k = first_[bone]; k < first_[bone + 1]; ++k)
        for (const std::int32_t p : surface_.triangle[of_bone_[k]]) {
            const Vec3 way = surface_.point[p] - place;
            const double along = way.dot(direction);
            if (surface_.bone[p] == bone && piece_[p] == piece &&
                (way - along * direction).norm() <= within + along / 3)
                farthest = std::max(farthest, along);
        }
    return farthest;
}

std::vector<BarkTaper> bark_tapers(const Bark& bark, const std::vector<speedtree::Bone>& bones) {
    const auto median = [](std::vector<double> of) {
        std::sort(of.begin(), of.end());
        const std::size_t n = of.size();
        return 0.5 * (of[(n - 1) / 2] + of[n / 2]);
    };
    std::vector<BarkTaper> result(bones.size());
    for (std::size_t b = 0; b < bones.size(); ++b) {
        const Vec3 way = bones[b].end - bones[b].start;
        if (!(way.norm() > 0)) continue;
        std::vector<double> at, radius, slope, start;
        for (const double place : {0.1, 0.3, 0.5, 0.7, 0.9}) {
            const BarkRing ring = bark.ring(std::int32_t(b), bones[b].start + place * way, way.normalized());
            if (!(ring.radius > 0)) continue;
            result[b].square += ring.square;
            if (result[b].pieces.empty() || result[b].pieces.back() != ring.piece)
                result[b].pieces.push_back(ring.piece);
            for (std::size_t k = 0; k < at.size(); ++k) slope.push_back((ring.radius - radius[k]) / (place - at[k]));
            at.push_back(place);
            radius.push_back(ring.radius);
        }
        result[b].rings = int(radius.size());
        if (radius.empty()) continue;
        const double rise = radius.size() < 3 ? 0 : median(slope), least = 0.1 * median(radius);
        for (std::size_t k = 0; k < at.size(); ++k) start.push_back(radius[k] - rise * at[k]);
        result[b].start = std::max(least, median(start));
        result[b].end = std::max(least, median(start) + rise);
    }
    return result;
}

} // namespace bough
