// The search for the nearest wood against one that asks every segment, in other words: the header's.
#include "formats/imports/attach.h"
#include "formats/imports/radix_order.h"
#include "lib/base/parallel.h"
#include "tests/support/sanitized.h"
#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>
#include <span>

using namespace bough;

namespace {

struct Wood {
    std::vector<Vec3> point;
    std::vector<double> radius;
    std::vector<std::int32_t> base;
    std::vector<LineSegment> segment;
};

// Crooked curves of three points, of all sizes; many begin on another's point, some at the very same one as another; the
// radii of some are unknown.
Wood random_wood(unsigned seed, int curves) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto direction = [&] { return Vec3(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5); };
    Wood w;
    for (std::int32_t c = 0; c < curves; ++c) {
        const double size = std::pow(10, 2 - 4 * unit(random)), thick = random() % 4 ? 0.1 * size * unit(random) : -1;
        Vec3 p = 30 * direction();
        if (c > 0 && random() % 3) p = w.point[random() % w.point.size()];
        w.base.push_back(random() % 5 ? std::int32_t(w.point.size()) : -1);
        for (int k = 0; k < 3; ++k) {
            if (k > 0) w.segment.push_back({std::int32_t(w.point.size()) - 1, std::int32_t(w.point.size()), c});
            w.point.push_back(p);
            w.radius.push_back(thick > 0 ? thick * (1 - 0.4 * k) : -1);
            p += size * direction();
        }
    }
    return w;
}

// The same by asking all.
SegmentPlace nearest_of_all(const Wood& w, const std::vector<std::int32_t>& group, std::int32_t end, std::int32_t own) {
    SegmentPlace best;
    for (const LineSegment& s : w.segment) {
        if (group[s.piece] == own) continue;
        const Vec3 d = w.point[s.b] - w.point[s.a];
        double t = d.squaredNorm() > 0 ? (w.point[end] - w.point[s.a]).dot(d) / d.squaredNorm() : 0;
        t = std::min(1.0, std::max(0.0, t));
        const Vec3 place = w.point[s.a] + t * d;
        const double r = (1 - t) * std::max(0.0, w.radius[s.a]) + t * std::max(0.0, w.radius[s.b]);
        const double distance = (place - w.point[end]).norm();
        double cost = distance < r ? distance * (distance / r) * (distance / r) : distance;
        cost += 10 * std::max(0.0, std::max(0.0, w.radius[end]) - r);
        const std::int32_t begin = w.base[s.piece];
        const double close = begin < 0 ? -1 : std::max(0.0, std::min(w.radius[begin], w.radius[end]));
        if (begin >= 0 && (place - w.point[begin]).norm() <= close) continue;
        if (cost > best.cost) continue;
        if (cost == best.cost && std::pair(s.a, s.b) > std::pair(best.segment.a, best.segment.b)) continue;
        best = {s, t, distance, cost};
    }
    return best;
}

void is_nearest(const Wood& w, const SegmentSearch& search, const std::vector<std::int32_t>& group) {
    std::mt19937 random(9);
    for (std::int32_t end = 0; end < std::int32_t(w.point.size()); ++end) {
        const std::int32_t own = group[end / 3]; // three points a curve
        const SegmentPlace truth = nearest_of_all(w, group, end, own);
        const std::vector<LineSegment> some{w.segment[random() % w.segment.size()],
                                            w.segment[random() % w.segment.size()]};
        for (const std::size_t likely : {0, 1, 2}) {
            const SegmentPlace found =
                search.nearest(end, own, std::numeric_limits<double>::infinity(), std::span(some).first(likely));
            REQUIRE(found.segment.a == truth.segment.a);
            REQUIRE(found.cost == Approx(truth.cost).epsilon(1e-12).margin(1e-13));
            REQUIRE(found.distance == Approx(truth.distance).epsilon(1e-12).margin(1e-13));
        }
        // What costs as much as the bound is not looked for, what costs less is found.
        REQUIRE(search.nearest(end, own, truth.cost * 0.999).segment.a < 0);
        REQUIRE((truth.cost == 0 || search.may_find(std::span(&end, 1), own, truth.cost * 1.001)));
        if (truth.cost > 0) REQUIRE(search.nearest(end, own, truth.cost * 1.001).segment.a == truth.segment.a);
    }
}

// Two crooked trees of thousands of segments side by side, each one piece, and twigs about them: what is large is sorted apart.
Wood two_trees() {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> off(-1, 1);
    Wood w;
    for (std::int32_t tree = 0; tree < 2; ++tree) {
        w.base.push_back(-1);
        for (std::int32_t k = 0; k < 2000; ++k) {
            const auto at = std::int32_t(w.point.size());
            w.point.emplace_back(3 * tree + off(random), k / 500.0, off(random));
            w.radius.push_back(0.001 * double(random() % 40));
            if (k > 0) w.segment.push_back({k % 5 ? at - 1 : at - std::min(k, 5), at, tree});
        }
    }
    for (std::int32_t k = 0; k < 200; ++k) {
        w.base.push_back(std::int32_t(w.point.size()));
        w.segment.push_back({std::int32_t(w.point.size()), std::int32_t(w.point.size()) + 1, 2 + k});
        w.point.emplace_back(2 * off(random), 2 + 2 * off(random), off(random));
        w.point.push_back(w.point.back() + Vec3(0, 0.05, 0));
        w.radius.insert(w.radius.end(), {0.002, 0.001});
    }
    return w;
}

} // namespace

TEST_CASE("places in large pieces, asked one by one and many at once") {
    const Wood w = two_trees();
    const SegmentSearch search(w.point, w.radius, w.base, w.segment, w.base.size());
    std::vector<std::int32_t> group(w.base.size()), piece_of(w.point.size());
    std::iota(group.begin(), group.end(), 0);
    for (const LineSegment& s : w.segment) piece_of[s.a] = piece_of[s.b] = s.piece;
    for (std::int32_t end = 0; end < std::int32_t(w.point.size()); end += sanitized ? 150 : 3) {
        const SegmentPlace truth = nearest_of_all(w, group, end, piece_of[end]);
        const SegmentPlace found = search.nearest(end, piece_of[end]);
        CAPTURE(end, found.cost, truth.cost);
        REQUIRE(found.segment.a == truth.segment.a);
        REQUIRE(found.cost == Approx(truth.cost).epsilon(1e-12).margin(1e-13));
    }
    // Never "nothing" where one of them finds something.
    std::mt19937 random(2);
    std::size_t nothing = 0;
    for (int round = 0; round < (sanitized ? 100 : 2000); ++round) {
        const std::int32_t first = std::int32_t(random() % 1900), many = 1 + std::int32_t(random() % 60);
        std::vector<std::int32_t> ends(std::size_t(std::min(many, 2000 - first)));
        std::iota(ends.begin(), ends.end(), first);
        const double bound = std::pow(10, -double(random() % 40) / 10);
        const bool found = std::any_of(ends.begin(), ends.end(),
                                       [&](std::int32_t end) { return search.nearest(end, 0, bound).segment.a >= 0; });
        const bool may = search.may_find(ends, 0, bound);
        REQUIRE((may || !found));
        nothing += !may;
    }
    CHECK(nothing > (sanitized ? 10 : 200));
}

TEST_CASE("the nearest place among many is that of a search through all, each curve alone or in groups") {
    for (const unsigned seed : cases(1, {1u, 2u, 3u})) {
        const Wood w = random_wood(seed, sanitized ? 150 : 400);
        SegmentSearch search(w.point, w.radius, w.base, w.segment, w.base.size());
        std::vector<std::int32_t> group(w.base.size());
        std::iota(group.begin(), group.end(), 0);
        is_nearest(w, search, group);
        for (std::size_t c = 0; c < group.size(); ++c) group[c] = std::int32_t(c / 7 * 7);
        search.regroup(group);
        is_nearest(w, search, group);
    }
}

TEST_CASE("wood of any thickness is a place") {
    // Ends thicker than wood by more than a float holds, and by so much that ten times as much is no double.
    for (const double thick : {1e30, 1e38, 1e39, 1e200, 1e308}) {
        Wood w;
        w.point = {{0, 0, 0}, {0, 1, 0}, {3, 0, 0}, {3, 1, 0}, {0.5, 0.5, 0}, {1, 1, 0}};
        w.radius = {0.1, 0.1, thick, thick, thick, thick};
        w.base = {-1, -1, -1};
        w.segment = {{0, 1, 0}, {2, 3, 1}, {4, 5, 2}};
        const SegmentSearch search(w.point, w.radius, w.base, w.segment, 3);
        const SegmentPlace on_thin = search.nearest(0, 0);
        CAPTURE(thick);
        CHECK(on_thin.segment.a >= 2); // an end of 0.1 in thick wood
        const SegmentSearch thin_alone(w.point, w.radius, w.base, {{0, 1, 0}}, 3);
        const SegmentPlace on_thick = thin_alone.nearest(3, 1);
        CHECK(on_thick.segment.a == 0);
        CHECK(on_thick.distance == Approx(3));
    }
}

TEST_CASE("an order by digits is the stable order by comparison") {
    std::mt19937_64 random(4);
    for (const std::size_t n : {0u, 1u, 2u, 1000u, 100000u})
        for (const int shift : {0, 13, 40, 60, 63}) {
            std::vector<std::uint64_t> key(n);
            for (std::uint64_t& k : key) k = shift % 2 ? random() >> shift : random() << shift;
            std::vector<std::uint32_t> sorted(n);
            std::iota(sorted.begin(), sorted.end(), 0u);
            std::stable_sort(sorted.begin(), sorted.end(),
                             [&](std::uint32_t a, std::uint32_t b) { return key[a] < key[b]; });
            CHECK(radix_order(std::move(key)) == sorted);
        }
}

TEST_CASE("pieces are joined alike by any number of threads, and whatever places are looked at first") {
    const Wood w = random_wood(5, sanitized ? 1000 : 5000);
    std::vector<std::vector<double>> results;
    for (const auto& [threads, curves] : cases<std::pair<int, bool>>(
             2, {{1, false}, {2, true}, {2, false}, {3, false}, {8, false}, {1, true}, {8, true}})) {
        const ThreadLimit limit(threads);
        Pieces pieces{w.point, w.radius, w.segment, {}, {}, w.base, curves};
        for (std::int32_t c = 0; c < std::int32_t(w.base.size()); ++c) {
            pieces.first.push_back(pieces.end.size());
            pieces.end.insert(pieces.end.end(), {3 * c, 3 * c + 2});
        }
        pieces.first.push_back(pieces.end.size());
        std::vector<double>& result = results.emplace_back();
        for (const JoinedPiece& a : attach_pieces(pieces, 'y'))
            result.insert(result.end(), {double(a.end), double(a.parent), double(a.a), double(a.b), a.t, a.gap});
    }
    for (const std::vector<double>& result : results) CHECK(result == results.front());
}
