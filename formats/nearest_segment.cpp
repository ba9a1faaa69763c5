#include "nearest_segment.h"
#include "imported_tree.h"
#include <algorithm>
#include <array>
#include <numeric>

namespace bough {
namespace {

constexpr std::size_t block = 4;
constexpr std::size_t most_beside = 256; // bases passed over for one end
constexpr double too_thin = 10; // cost for each unit of radius that the place is thinner than what begins there

double cost_of(double distance, double radius) {
    if (!(distance < radius)) return distance;
    const double depth = distance / radius;
    return distance * depth * depth;
}

// A float that is not above v.
float below(double v) {
    const float f = float(v);
    return double(f) > v ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}

// Every third bit of 63 from the 21 of v.
std::uint64_t spread(std::uint64_t v) {
    v &= 0x1fffff;
    v = (v | v << 32) & 0x1f00000000ffff;
    v = (v | v << 16) & 0x1f0000ff0000ff;
    v = (v | v << 8) & 0x100f00f00f00f00f;
    v = (v | v << 4) & 0x10c30c30c30c30c3;
    return (v | v << 2) & 0x1249249249249249;
}

// Which power of 64 a segment's size has: long and thick ones would blow up the boxes of the small ones among them.
std::uint32_t size_class(const Segment& s, const std::vector<Vec3>& point, const std::vector<double>& radius) {
    const double size = std::max({(point[s.b] - point[s.a]).norm(), radius[s.a], radius[s.b]});
    return std::uint32_t(std::clamp(std::ilogb(size), -1000, 1000) + 1000) / 6;
}

// By size class, within one along a Morton curve.
void sort_by_place(const std::vector<Vec3>& point, const std::vector<double>& radius, std::vector<Segment>& segments) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Segment& s : segments) {
        low = low.cwiseMin(point[s.a]).cwiseMin(point[s.b]);
        high = high.cwiseMax(point[s.a]).cwiseMax(point[s.b]);
    }
    const double size = std::max((high - low).maxCoeff(), std::numeric_limits<double>::min());
    // One number to sort by: the size class, counted from the smallest (63 of a factor of 64 are all there can be of
    // use), above 19 bits of each axis. Equal ones stay in order.
    std::uint32_t smallest = std::numeric_limits<std::uint32_t>::max();
    for (const Segment& s : segments) smallest = std::min(smallest, size_class(s, point, radius));
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed(segments.size());
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const Segment& s = segments[i];
        const Vec3 middle = (0.5 * (point[s.a] + point[s.b]) - low) / size * 524287.0;
        const std::uint64_t place = spread(std::uint64_t(middle.x())) | spread(std::uint64_t(middle.y())) << 1 |
                                    spread(std::uint64_t(middle.z())) << 2;
        const std::uint64_t above = std::min(size_class(s, point, radius) - smallest, 63u);
        keyed[i] = {above << 57 | place, std::uint32_t(i)};
    }
    std::sort(keyed.begin(), keyed.end());
    std::vector<Segment> sorted;
    sorted.reserve(segments.size());
    for (const auto& [key, i] : keyed) sorted.push_back(segments[i]);
    segments = std::move(sorted);
}

} // namespace

SegmentSearch::SegmentSearch(const std::vector<Vec3>& point, const std::vector<double>& radius,
                             const std::vector<std::int32_t>& base, std::vector<Segment> segments, std::size_t pieces)
    : point_(point), radius_(radius), base_(base), segments_(std::move(segments)), group_(pieces) {
    sort_by_place(point_, radius_, segments_);
    std::iota(group_.begin(), group_.end(), 0);
    for (std::size_t count = (segments_.size() + block - 1) / block;; count = (count + 1) / 2) {
        levels_.emplace_back(count);
        if (count <= 1) break;
    }
    for (std::size_t k = 0; k < levels_[0].size(); ++k) {
        Node& node = levels_[0][k];
        Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
        double thickest = 0;
        for (std::size_t i = k * block; i < std::min((k + 1) * block, segments_.size()); ++i)
            for (const std::int32_t p : {segments_[i].a, segments_[i].b}) {
                low = low.cwiseMin(point_[p]);
                high = high.cwiseMax(point_[p]);
                thickest = std::max(thickest, radius_[p]);
            }
        for (int axis = 0; axis < 3; ++axis) {
            node.low[axis] = below(low[axis]);
            node.high[axis] = -below(-high[axis]);
        }
        node.thickest = -below(-thickest);
    }
    for (std::size_t level = 1; level < levels_.size(); ++level)
        for (std::size_t k = 0; k < levels_[level].size(); ++k) {
            const std::vector<Node>& parts = levels_[level - 1];
            Node& node = levels_[level][k] = parts[2 * k];
            if (2 * k + 1 == parts.size()) continue;
            node.low = node.low.cwiseMin(parts[2 * k + 1].low);
            node.high = node.high.cwiseMax(parts[2 * k + 1].high);
            node.thickest = std::max(node.thickest, parts[2 * k + 1].thickest);
        }
    regroup(std::vector<std::int32_t>(group_));
}

void SegmentSearch::regroup(const std::vector<std::int32_t>& group) {
    group_ = group;
    for (std::size_t k = 0; k < levels_[0].size(); ++k) {
        std::int32_t& all = levels_[0][k].group;
        all = group_[segments_[k * block].piece];
        for (std::size_t i = k * block; i < std::min((k + 1) * block, segments_.size()); ++i)
            if (group_[segments_[i].piece] != all) all = -1;
    }
    for (std::size_t level = 1; level < levels_.size(); ++level)
        for (std::size_t k = 0; k < levels_[level].size(); ++k) {
            const std::vector<Node>& parts = levels_[level - 1];
            const bool same = 2 * k + 1 == parts.size() || parts[2 * k].group == parts[2 * k + 1].group;
            levels_[level][k].group = same ? parts[2 * k].group : -1;
        }
}

double SegmentSearch::least_cost(const Node& node, const Vec3& p) {
    const Vec3 low = node.low.cast<double>() - p, high = p - node.high.cast<double>();
    const double d2 = low.cwiseMax(high).cwiseMax(0.0).squaredNorm();
    const double r2 = double(node.thickest) * double(node.thickest);
    return d2 < r2 ? d2 * (d2 / r2) * (d2 / r2) : d2;
}

void SegmentSearch::try_segment(const Segment& s, std::int32_t end, SegmentPlace& best, std::size_t& beside) const {
    const Vec3 &a = point_[s.a], &b = point_[s.b], &p = point_[end];
    const double t = projected(a, b, p);
    const Vec3 place = a + t * (b - a);
    const double distance = (place - p).norm();
    const double radius = (1 - t) * std::max(0.0, radius_[s.a]) + t * std::max(0.0, radius_[s.b]);
    const double cost = cost_of(distance, radius) + too_thin * std::max(0.0, std::max(0.0, radius_[end]) - radius);
    // Equally near: the segment whose points come first, whatever the order of search.
    if (cost > best.cost || (cost == best.cost && std::pair(s.a, s.b) > std::pair(best.segment.a, best.segment.b)))
        return;
    if (const std::int32_t begin = base_[s.piece]; begin >= 0 && beside < most_beside) {
        const double close = std::max(0.0, std::min(radius_[begin], radius_[end]));
        if ((place - point_[begin]).norm() <= close) {
            ++beside;
            return;
        }
    }
    best = {s, t, distance, cost};
}

SegmentPlace SegmentSearch::nearest(std::int32_t end, std::int32_t group, double bound, const Segment& hint) const {
    SegmentPlace best;
    best.cost = bound;
    std::size_t beside = 0;
    if (hint.a >= 0 && group_[hint.piece] != group) try_segment(hint, end, best, beside);
    struct Open {
        std::size_t level, node;
        double cost;
    };
    // Two a level are enough: of each node taken out, two come in one level below.
    std::array<Open, 80> open;
    std::size_t count = 0;
    const auto add = [&](std::size_t level, std::size_t k) {
        const Node& node = levels_[level][k];
        if (node.group == group) return;
        const double cost = least_cost(node, point_[end]);
        if (cost < best.cost * best.cost) open[count++] = {level, k, cost};
    };
    if (!segments_.empty()) add(levels_.size() - 1, 0);
    while (count > 0) {
        const Open at = open[--count];
        if (at.cost >= best.cost * best.cost) continue; // thousands may begin at one place
        if (at.level == 0) {
            for (std::size_t i = at.node * block; i < std::min((at.node + 1) * block, segments_.size()); ++i)
                if (group_[segments_[i].piece] != group) try_segment(segments_[i], end, best, beside);
            continue;
        }
        const std::size_t before = count;
        add(at.level - 1, 2 * at.node);
        if (2 * at.node + 1 < levels_[at.level - 1].size()) add(at.level - 1, 2 * at.node + 1);
        // The nearer of the two is looked into first.
        if (count == before + 2 && open[before].cost < open[before + 1].cost) std::swap(open[before], open[before + 1]);
    }
    return best;
}

} // namespace bough
