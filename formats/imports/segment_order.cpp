#include "segment_order.h"
#include "lib/base/parallel.h"
#include "radix_order.h"
#include <algorithm>

namespace bough {
namespace {

constexpr double key_ns = 20;           // of one segment
constexpr std::int32_t size_class = 15; // powers of two: very long ones would blow up the boxes of small ones

// Every third bit of 63 from the 21 of v.
std::uint64_t spread(std::uint64_t v) {
    v &= 0x1fffff;
    v = (v | v << 32) & 0x1f00000000ffff;
    v = (v | v << 16) & 0x1f0000ff0000ff;
    v = (v | v << 8) & 0x100f00f00f00f00f;
    v = (v | v << 4) & 0x10c30c30c30c30c3;
    return (v | v << 2) & 0x1249249249249249;
}

// The power of two that a segment's size has.
std::int32_t exponent(const LineSegment& s, const std::vector<Vec3>& point, const std::vector<double>& radius) {
    const double size = std::max({(point[s.b] - point[s.a]).norm(), radius[s.a], radius[s.b]});
    return std::clamp(std::ilogb(size), -1100, 1100);
}

struct MortonBox {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    void add(const Vec3& p) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    // So many bits of each axis of a place within, one after another.
    std::uint64_t morton(const Vec3& p, int bits) const {
        const double size = std::max((high - low).maxCoeff(), std::numeric_limits<double>::min());
        const double most = double((std::uint64_t(1) << bits) - 1);
        const Vec3 at = (p - low) / size * most;
        // Coordinates near the largest double are refused once the tree is made: until then they may differ by more than there is.
        const auto cell = [most](double x) { return spread(x > 0 ? std::uint64_t(std::min(x, most)) : 0); };
        return cell(at.x()) | cell(at.y()) << 1 | cell(at.z()) << 2;
    }
};

Vec3 middle_of(const LineSegment& s, const std::vector<Vec3>& point) {
    return 0.5 * (point[s.a] + point[s.b]);
}

// Pieces of so many segments that they are sorted each for itself: rank + 1 of each, along a Morton curve; 0: all others.
constexpr std::int32_t many_segments = 512, most_ranks = 1 << 15;

std::vector<std::int32_t> rank_large(const std::vector<LineSegment>& segments, std::size_t pieces, const MortonBox& all,
                                     const std::vector<Vec3>& point) {
    std::vector<std::int32_t> rank(pieces, 0);
    for (const LineSegment& s : segments) ++rank[s.piece];
    std::vector<std::pair<std::int32_t, MortonBox>> large;
    for (std::int32_t& r : rank) {
        if (r >= many_segments) large.emplace_back(std::int32_t(&r - rank.data()), MortonBox());
        r = r >= many_segments ? std::int32_t(large.size()) : 0;
    }
    for (const LineSegment& s : segments)
        if (rank[s.piece] > 0) large[rank[s.piece] - 1].second.add(middle_of(s, point));
    std::vector<std::pair<std::uint64_t, std::int32_t>> order;
    for (const auto& [piece, box] : large) order.emplace_back(all.morton(0.5 * (box.low + box.high), 19), piece);
    std::sort(order.begin(), order.end());
    for (std::size_t k = 0; k < order.size(); ++k) rank[order[k].second] = 1 + std::int32_t(k % most_ranks);
    return rank;
}

} // namespace

void sort_by_place(const std::vector<Vec3>& point, const std::vector<double>& radius,
                   std::vector<LineSegment>& segments, std::size_t pieces) {
    constexpr std::size_t aligned = 64;
    MortonBox box;
    std::int32_t largest = std::numeric_limits<std::int32_t>::min();
    for (const LineSegment& s : segments) {
        box.add(point[s.a]);
        box.add(point[s.b]);
        largest = std::max(largest, exponent(s, point, radius));
    }
    const std::vector<std::int32_t> rank = rank_large(segments, pieces, box, point);
    // One number to sort by: the size class, counted from the largest, above 18 bits of each axis; of large pieces the
    // rank above it. Equal ones stay in order.
    std::vector<std::uint64_t> key(segments.size());
    parallel_for(segments.size(), key_ns, [&](std::size_t i) {
        const LineSegment& s = segments[i];
        const auto size = std::uint64_t(std::min((largest - exponent(s, point, radius)) / size_class, 63));
        const Vec3 middle = middle_of(s, point);
        const auto large = std::uint64_t(rank[s.piece]);
        key[i] = large == 0
                     ? size << 54 | box.morton(middle, 18)
                     : std::uint64_t(1) << 62 | (large - 1) << 47 | size << 41 | box.morton(middle, 19) >> (57 - 41);
    });
    const std::vector<std::uint32_t> order = radix_order(std::move(key));
    std::vector<LineSegment> sorted;
    const auto ranks = std::size_t(rank.empty() ? 0 : *std::max_element(rank.begin(), rank.end()));
    sorted.reserve(segments.size() + ranks * aligned); // what is left free where one ends
    std::int32_t before = 0;
    for (const std::uint32_t i : order) {
        const std::int32_t large = rank[segments[i].piece];
        if (large != before) sorted.resize((sorted.size() + aligned - 1) / aligned * aligned);
        before = large;
        sorted.push_back(segments[i]);
    }
    segments = std::move(sorted);
}

} // namespace bough
