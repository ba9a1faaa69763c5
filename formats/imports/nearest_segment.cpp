#include "nearest_segment.h"
#include "lib/base/parallel.h"
#include "on_polyline.h"
#include "segment_order.h"
#include <algorithm>
#include <array>
#include <numeric>

namespace bough {
namespace {

constexpr std::size_t most_beside = 256; // bases passed over for one end
constexpr double rounding = 1e-6;        // relative, of a difference of floats, and more
constexpr std::int32_t no_box = std::numeric_limits<std::int32_t>::max();
constexpr double node_ns = 50;  // of four boxes
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

float above(double v) {
    return -below(-v);
}

} // namespace

SegmentSearch::SegmentSearch(const std::vector<Vec3>& point, const std::vector<double>& radius,
                             const std::vector<std::int32_t>& base, std::vector<LineSegment> segments,
                             std::size_t pieces)
    : point_(point), radius_(radius), base_(base), segments_(std::move(segments)), group_(pieces) {
    sort_by_place(point_, radius_, segments_, pieces);
    std::iota(group_.begin(), group_.end(), 0);
    const auto divided = [](std::size_t n) { return (n + wide - 1) / wide; };
    for (std::size_t boxes = divided(segments_.size()); boxes > 0; boxes = levels_.back().size()) {
        levels_.emplace_back(divided(boxes));
        if (boxes <= wide) break;
    }
    for (std::size_t level = 0; level < levels_.size(); ++level) {
        std::vector<Node>& nodes = levels_[level];
        parallel_for(nodes.size(), node_ns, [&](std::size_t k) {
            for (std::size_t at = 0; at < wide; ++at) {
                const std::size_t part = k * wide + at;
                Node& node = nodes[k];
                if (level == 0)
                    set_box(node, at, part);
                else if (part < levels_[level - 1].size())
                    join_boxes(levels_[level - 1][part], node, at);
                else
                    node.first[at] = no_box;
            }
        });
    }
    regroup(std::vector<std::int32_t>(group_));
}

void SegmentSearch::set_box(Node& node, std::size_t at, std::size_t block) const {
    node.first[at] = no_box;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    double thickest = 0;
    for (std::size_t i = block * wide; i < std::min((block + 1) * wide, segments_.size()); ++i) {
        if (segments_[i].a < 0) continue;
        node.first[at] = std::min(node.first[at], segments_[i].a);
        for (const std::int32_t p : {segments_[i].a, segments_[i].b}) {
            low = low.cwiseMin(point_[p]);
            high = high.cwiseMax(point_[p]);
            thickest = std::max(thickest, radius_[p]);
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        node.low[axis][at] = below(low[axis]);
        node.high[axis][at] = above(high[axis]);
    }
    node.thickest[at] = above(thickest);
}

void SegmentSearch::join_boxes(const Node& parts, Node& node, std::size_t at) {
    node.first[at] = no_box;
    for (int axis = 0; axis < 3; ++axis) {
        node.low[axis][at] = std::numeric_limits<float>::infinity();
        node.high[axis][at] = -node.low[axis][at];
    }
    node.thickest[at] = 0;
    for (std::size_t k = 0; k < wide; ++k) {
        if (parts.first[k] == no_box) continue;
        for (int axis = 0; axis < 3; ++axis) {
            node.low[axis][at] = std::min(node.low[axis][at], parts.low[axis][k]);
            node.high[axis][at] = std::max(node.high[axis][at], parts.high[axis][k]);
        }
        node.thickest[at] = std::max(node.thickest[at], parts.thickest[k]);
        node.first[at] = std::min(node.first[at], parts.first[k]);
    }
}

void SegmentSearch::set_group(Node& node, std::size_t at, std::size_t block) const {
    if (node.first[at] == no_box) return;
    node.group[at] = group_[segments_[block * wide].piece];
    for (std::size_t i = block * wide; i < std::min((block + 1) * wide, segments_.size()); ++i)
        if (segments_[i].a >= 0 && group_[segments_[i].piece] != node.group[at]) node.group[at] = -1;
}

std::int32_t SegmentSearch::common_group(const Node& node) {
    for (std::size_t k = 1; k < wide; ++k)
        if (node.first[k] != no_box && node.group[k] != node.group[0]) return -1;
    return node.group[0];
}

void SegmentSearch::regroup(const std::vector<std::int32_t>& group) {
    group_ = group;
    for (std::size_t level = 0; level < levels_.size(); ++level) {
        parallel_for(levels_[level].size(), node_ns, [&](std::size_t k) {
            for (std::size_t at = 0; at < wide; ++at) {
                const std::size_t part = k * wide + at;
                Node& node = levels_[level][k];
                if (level == 0)
                    set_group(node, at, part);
                else if (node.first[at] != no_box)
                    node.group[at] = common_group(levels_[level - 1][part]);
            }
        });
    }
}

struct SegmentSearch::Asked {
    const std::int32_t end, group;
    const double thickness; // of the end
    SegmentPlace best;
    std::size_t beside = 0;
    float low[3], high[3]; // where the end is, rounded down and up

    Asked(std::int32_t e, std::int32_t g, const Vec3& from, const Vec3& to, double radius, double bound)
        : end(e), group(g), thickness(std::max(0.0, radius)) {
        best.cost = bound;
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = below(from[axis]);
            high[axis] = above(to[axis]);
        }
    }

    // Squares of what a place in each box costs at least for its distance: what floats may round up, overflow or lose below
    // their range is taken off.
    Floats least_costs(const Node& node) const {
        constexpr float largest = std::numeric_limits<float>::max(), smallest = std::numeric_limits<float>::min();
        Floats d2 = Floats::Zero();
        for (int axis = 0; axis < 3; ++axis)
            d2 += (node.low[axis] - high[axis]).max(low[axis] - node.high[axis]).max(0.0f).square();
        d2 = d2.min(largest);
        const Floats within = (d2 / node.thickest.square().max(smallest)).min(1.0f);
        return (float(1 - rounding) * (d2 * within.square()) - smallest).max(0.0f);
    }

    // Squares of twice the way to the middle of each box: of those the end is in, where to look first.
    Floats off_middle(const Node& node) const {
        Floats off = Floats::Zero();
        for (int axis = 0; axis < 3; ++axis)
            off += (node.low[axis] + node.high[axis] - (low[axis] + high[axis])).square();
        return off;
    }

    // Whether a box with this least cost, so thick, may hold a place to be preferred.
    bool may_hold(float cost2, float thickest, std::int32_t first) const {
        const double thin = (1 - rounding) * too_thin * std::max(0.0, thickness - double(thickest));
        const double left =
            best.cost - std::min(thin, std::numeric_limits<double>::max()); // never infinity less infinity
        if (!(left >= 0) || double(cost2) > left * left) return false;
        return cost2 > 0 || left > 0 || first <= best.segment.a;
    }
};

void SegmentSearch::try_segment(const LineSegment& s, Asked& asked) const {
    const Vec3 &a = point_[s.a], &b = point_[s.b], &p = point_[asked.end];
    const double t = projected(a, b, p);
    const Vec3 place = a + t * (b - a);
    const double distance = (place - p).norm();
    const double radius = (1 - t) * std::max(0.0, radius_[s.a]) + t * std::max(0.0, radius_[s.b]);
    double cost = cost_of(distance, radius) + too_thin * std::max(0.0, asked.thickness - radius);
    if (std::isfinite(distance)) cost = std::min(cost, std::numeric_limits<double>::max()); // wood of any thickness
    // Equally near: the segment whose points come first, whatever the order of search.
    SegmentPlace& best = asked.best;
    if (cost > best.cost || (cost == best.cost && std::pair(s.a, s.b) > std::pair(best.segment.a, best.segment.b)))
        return;
    if (const std::int32_t begin = base_[s.piece]; begin >= 0 && asked.beside < most_beside) {
        const double close = std::max(0.0, std::min(radius_[begin], radius_[asked.end]));
        if ((place - point_[begin]).norm() <= close) {
            ++asked.beside;
            return;
        }
    }
    best = {s, t, distance, cost};
}

void SegmentSearch::try_block(std::size_t block, Asked& asked) const {
    for (std::size_t i = block * wide; i < std::min((block + 1) * wide, segments_.size()); ++i)
        if (segments_[i].a >= 0 && group_[segments_[i].piece] != asked.group) try_segment(segments_[i], asked);
}

namespace {

// Boxes that are still to be looked into: of each that is taken out at most four come in, one level below, of 17 that 2^32
// segments can have.
struct Open {
    std::int32_t level;
    std::uint32_t part; // block of segments, or node of the level below
    float cost2, thickest, off_middle;
    std::int32_t first;
    bool after(const Open& o) const { return cost2 != o.cost2 ? cost2 > o.cost2 : off_middle > o.off_middle; }
};
constexpr std::size_t most_open = 17 * 4;

} // namespace

SegmentPlace SegmentSearch::nearest(std::int32_t end, std::int32_t group, double bound,
                                    std::span<const LineSegment> likely) const {
    Asked asked(end, group, point_[end], point_[end], radius_[end], bound);
    for (const LineSegment& s : likely)
        if (group_[s.piece] != group) try_segment(s, asked);
    std::array<Open, most_open> open;
    std::size_t count = 0;
    const auto look_into = [&](std::size_t level, std::size_t k) {
        const Node& node = levels_[level][k];
        const Floats cost2 = asked.least_costs(node), off_middle = asked.off_middle(node);
        const std::size_t before = count;
        for (std::size_t at = 0; at < wide; ++at) {
            if (node.first[at] == no_box || node.group[at] == group ||
                !asked.may_hold(cost2[at], node.thickest[at], node.first[at]))
                continue;
            const Open box{std::int32_t(level), std::uint32_t(k * wide + at),
                           cost2[at],           node.thickest[at],
                           off_middle[at],      node.first[at]};
            // The nearest is looked into first, of those that the end is in the one in whose middle it is.
            std::size_t to = count++;
            for (; to > before && box.after(open[to - 1]); --to) open[to] = open[to - 1];
            open[to] = box;
        }
    };
    if (!levels_.empty()) look_into(levels_.size() - 1, 0);
    while (count > 0) {
        const Open at = open[--count];
        if (!asked.may_hold(at.cost2, at.thickest, at.first)) continue;
        if (at.level == 0)
            try_block(at.part, asked);
        else
            look_into(std::size_t(at.level) - 1, at.part);
    }
    return asked.best;
}

bool SegmentSearch::may_find(std::span<const std::int32_t> points, std::int32_t group, double bound) const {
    if (points.empty() || levels_.empty()) return false;
    Vec3 low = point_[points.front()], high = low;
    double thinnest = radius_[points.front()];
    for (const std::int32_t p : points) {
        low = low.cwiseMin(point_[p]);
        high = high.cwiseMax(point_[p]);
        thinnest = std::min(thinnest, radius_[p]);
    }
    const Asked asked(-1, group, low, high, thinnest, bound);
    std::array<std::pair<std::size_t, std::size_t>, most_open> open; // level, node
    std::size_t count = 0;
    open[count++] = {levels_.size() - 1, 0};
    while (count > 0) {
        const auto [level, k] = open[--count];
        const Node& node = levels_[level][k];
        const Floats cost2 = asked.least_costs(node);
        for (std::size_t at = 0; at < wide; ++at) {
            if (node.first[at] == no_box || node.group[at] == group ||
                !asked.may_hold(cost2[at], node.thickest[at], node.first[at]))
                continue;
            if (level == 0) return true;
            open[count++] = {level - 1, k * wide + at};
        }
    }
    return false;
}

} // namespace bough
