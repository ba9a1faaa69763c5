// colonize.h: the nodes against a plain O(points * nodes) run of the same rules, and against what filling a volume means.
#include "lib/growth/colonize.h"
#include "lib/growth/segment.h"
#include "lib/study/modes.h"
#include "tests/support/sanitized.h"
#include "tests/support/solids.h"
#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <numeric>

using namespace bough;

namespace {

ColonizeParameters in_shape(EnvelopeShape shape, std::int64_t points) {
    ColonizeParameters p;
    p.envelope.shape = shape;
    p.points = points;
    return p;
}

ColonizeParameters in_mesh(const solids::Solid& s, std::int64_t points) {
    ColonizeParameters p = in_shape(EnvelopeShape::mesh, points);
    p.envelope.mesh = std::make_shared<MeshInterior>(s.vertex, s.triangle);
    return p;
}

std::vector<ColonizeParameters> shapes(std::int64_t points) {
    return {in_shape(EnvelopeShape::sphere, points), in_shape(EnvelopeShape::cone, points),
            in_shape(EnvelopeShape::box, points), in_mesh(solids::moved(solids::icosphere(3), 3, {1, 4, 2}), points),
            in_mesh(solids::l_prism(), points)};
}

double nearest(const std::vector<Vec3>& places, std::size_t from, const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = from; i < places.size(); ++i) least = std::min(least, (places[i] - p).norm());
    return least;
}

// Runions' rounds with every distance measured anew, from the trunk that stands; convex envelopes, where none is blocked.
std::vector<Vec3> plain_nodes(const ColonizeParameters& p, const Colony& c, std::size_t trunk) {
    std::vector<Vec3> node(c.node.begin(), c.node.begin() + static_cast<std::ptrdiff_t>(trunk));
    const auto crown = static_cast<std::size_t>(c.crown);
    while (true) {
        std::vector<std::vector<Vec3>> pulls(node.size());
        for (const Vec3& a : c.point) {
            std::size_t best = crown;
            for (std::size_t i = crown; i < node.size(); ++i)
                if ((node[i] - a).squaredNorm() < (node[best] - a).squaredNorm()) best = i;
            const double d = (node[best] - a).norm();
            if (d > p.kill && d <= p.influence) pulls[best].push_back(a);
        }
        const std::size_t before = node.size();
        for (std::size_t i = 0; i < before; ++i) {
            if (pulls[i].empty()) continue;
            Vec3 sum = Vec3::Zero(), close = pulls[i][0];
            for (const Vec3& a : pulls[i]) {
                sum += (a - node[i]).normalized();
                if ((a - node[i]).norm() < (close - node[i]).norm()) close = a;
            }
            Vec3 child = node[i] + p.step * (sum.normalized() + p.tropism).normalized();
            const bool nearer = std::any_of(pulls[i].begin(), pulls[i].end(), [&](const Vec3& a) {
                return (a - child).norm() <= (a - node[i]).norm() - p.step / 4;
            });
            if (!nearer || !contains(p.envelope, child)) child = node[i] + p.step * (close - node[i]).normalized();
            node.push_back(child);
        }
        if (node.size() == before) return node;
    }
}

// Nodes of the trunk: each the child of the one before, straight above it.
std::size_t trunk_of(const Colony& c) {
    std::size_t n = 1;
    while (n < c.node.size() && c.parent[n] == static_cast<std::int32_t>(n) - 1 &&
           std::hypot(c.node[n].x() - c.node[0].x(), c.node[n].z() - c.node[0].z()) == 0)
        ++n;
    return n;
}

Vec3 at_fraction(const Splines& s, std::size_t b, double at) {
    const auto first = static_cast<std::size_t>(s.first_point[b]),
               last = static_cast<std::size_t>(s.first_point[b + 1]) - 1;
    double total = 0;
    for (std::size_t k = first; k < last; ++k) total += (s.point[k + 1] - s.point[k]).norm();
    double left = at * total;
    for (std::size_t k = first; k < last; ++k) {
        const double step = (s.point[k + 1] - s.point[k]).norm();
        if (left <= step) return s.point[k] + left / step * (s.point[k + 1] - s.point[k]);
        left -= step;
    }
    return s.point[last];
}

} // namespace

TEST_CASE("Nodes are those of a run that measures every distance anew") {
    for (const EnvelopeShape shape : {EnvelopeShape::sphere, EnvelopeShape::cone, EnvelopeShape::box})
        for (const std::uint64_t seed : {1, 2}) {
            const ColonizeParameters p = with_defaults(in_shape(shape, 300));
            const Colony c = colonize_nodes(p, seed);
            const std::vector<Vec3> plain = plain_nodes(p, c, trunk_of(c));
            REQUIRE(c.node.size() > 200);
            REQUIRE(plain.size() == c.node.size());
            for (std::size_t i = 0; i < plain.size(); ++i) REQUIRE((plain[i] - c.node[i]).norm() < 1e-9);
        }
}

TEST_CASE("The tree stays inside, a step long each, and reaches the points it says it reached") {
    for (const ColonizeParameters& given : shapes(2000)) {
        const ColonizeParameters p = with_defaults(given);
        const Colony c = colonize_nodes(p, 3);
        const auto crown = static_cast<std::size_t>(c.crown);
        REQUIRE(c.node.size() == c.parent.size());
        CHECK(c.node[0].y() == std::min(0.0, lower_corner(p.envelope).y()));
        for (std::size_t i = 1; i < c.node.size(); ++i) {
            REQUIRE(c.parent[i] >= 0);
            REQUIRE(c.parent[i] < static_cast<std::int32_t>(i));
            const Vec3 way = c.node[i] - c.node[static_cast<std::size_t>(c.parent[i])];
            if (i > crown) {
                REQUIRE(way.norm() == Approx(p.step));
                REQUIRE(c.parent[i] >= c.crown);
                REQUIRE(contains(p.envelope, c.node[i]));
            } else
                REQUIRE(way.normalized().y() == Approx(1));
        }
        std::int64_t reached = 0;
        for (std::size_t i = 0; i < c.point.size(); ++i) {
            const double d = nearest(c.node, crown, c.point[i]);
            REQUIRE((d <= p.kill) == (c.reached[i] == 1));
            reached += c.reached[i];
        }
        CHECK(reached + c.blocked + c.out_of_reach == p.points);
        CHECK(c.blocked + c.out_of_reach == 0);
    }
}

TEST_CASE("The tree fills its envelope") {
    for (const ColonizeParameters& given : shapes(2000)) {
        const ColonizeParameters p = with_defaults(given);
        const Colony c = colonize_nodes(p, 3);
        // Every attraction point has a node within the kill distance; of 2000 uniform points, a ball of volume
        // V ln(2000 * 2000) / 2000 is empty about once in 2000 balls, so that none of 2000 is likelier than not emptier
        // than twice that; at the surface only a part (an eighth in a corner) of the ball lies inside.
        const double empty = std::cbrt(8 * 2 * volume(p.envelope) * std::log(4e6) / 2000 * 3 / (4 * 3.14159));
        double farthest = 0, mean = 0;
        for (std::uint64_t i = 0; i < 2000; ++i) {
            const double d = nearest(c.node, static_cast<std::size_t>(c.crown), point_inside(p.envelope, 99, i));
            farthest = std::max(farthest, d);
            mean += d / 2000;
        }
        CHECK(farthest < p.kill + empty);
        CHECK(mean < p.kill);
    }
}

TEST_CASE("The notch of an L stays empty, in the branches too") {
    const ColonizeParameters p = with_defaults(in_mesh(solids::l_prism(), 4000));
    const Splines s = colonize(p, 5, false, false);
    REQUIRE_FALSE(check(s));
    for (const Vec3& q : s.point)
        if (q.y() > 2) {
            const bool in_notch = q.x() > 2 + p.step && q.y() > 4 + p.step;
            REQUIRE_FALSE(in_notch);
        }
    // Both arms hold branches.
    CHECK(std::any_of(s.point.begin(), s.point.end(), [](const Vec3& q) { return q.x() > 3.5; }));
    CHECK(std::any_of(s.point.begin(), s.point.end(), [](const Vec3& q) { return q.y() > 7.5; }));
}

TEST_CASE("A sphere's octants hold the same length of branches above the middle, and below") {
    ColonizeParameters p = in_shape(EnvelopeShape::sphere, 16000);
    p.tropism = Vec3::Zero();
    p = with_defaults(p);
    const Colony c = colonize_nodes(p, 11);
    const double middle = p.envelope.base.y() + p.envelope.size.y() / 2;
    double count[8] = {}, all = 0;
    for (std::size_t i = trunk_of(c); i < c.node.size(); ++i, ++all)
        ++count[(c.node[i].x() > 0) + 2 * (c.node[i].z() > 0) + 4 * (c.node[i].y() > middle)];
    for (const double n : count) CHECK(n / all == Approx(1.0 / 8).margin(0.015));
}

TEST_CASE("Points that pull a node two ways do not keep it for ever") {
    // Few points and a wide influence: nodes between two points are the rule.
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        ColonizeParameters p = in_shape(EnvelopeShape::box, 1 + static_cast<std::int64_t>(seed) % 7);
        p.tropism = seed % 2 ? Vec3(Vec3::Zero()) : Vec3(0, -5, 0);
        p.influence = 100;
        p.kill = 0.2;
        p = with_defaults(p);
        const Colony c = colonize_nodes(p, seed);
        CHECK(c.blocked + c.out_of_reach == 0);
        CHECK(static_cast<double>(c.node.size()) < static_cast<double>(p.points) * (4 * 100 / p.step + 1));
    }
}

TEST_CASE("What lies behind the envelope's surface is counted as blocked, and growth ends") {
    // Two balls with a gap of 0.5 between them: the trunk stands in the first, the second is within its influence.
    ColonizeParameters p = in_mesh(solids::together(solids::moved(solids::icosphere(3), 2, {0, 3, 0}),
                                                    solids::moved(solids::icosphere(3), 0.5, {3, 3, 0})),
                                   2000);
    p.influence = 2;
    p = with_defaults(p);
    const Colony c = colonize_nodes(p, 2);
    std::int64_t second = 0;
    for (std::size_t i = 0; i < c.point.size(); ++i) {
        const bool behind = c.point[i].x() > 2.25;
        CHECK(c.reached[i] == !behind);
        second += behind;
    }
    CHECK(second > 10);
    CHECK(c.blocked == second);
    for (const Vec3& q : c.node) CHECK(q.x() <= 2);
}

TEST_CASE("No way between two nodes has its middle outside") {
    // Two boxes with a gap of 0.3 between them; a step is 0.5.
    ColonizeParameters p = in_mesh(solids::together(solids::moved(solids::unit_box(), 3, {0, 0, 0}),
                                                    solids::moved(solids::unit_box(), 3, {3.3, 0, 0})),
                                   300);
    p.kill = p.step = 0.5;
    p = with_defaults(p);
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const Colony c = colonize_nodes(p, seed);
        for (std::size_t i = static_cast<std::size_t>(c.crown) + 1; i < c.node.size(); ++i) {
            const Vec3 from = c.node[static_cast<std::size_t>(c.parent[i])];
            REQUIRE(contains(p.envelope, (from + c.node[i]) / 2));
            REQUIRE((from.x() < 3.15) == (c.node[i].x() < 3.15));
        }
    }
}

TEST_CASE("Smoothing moves no point out of a concave envelope") {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const ColonizeParameters p = with_defaults(in_mesh(solids::l_prism(), 300));
        const Colony c = colonize_nodes(p, seed);
        const Splines s = colony_splines(c, p, seed, false, false);
        const double entry = c.node[static_cast<std::size_t>(c.crown)].y();
        for (std::size_t b = 0; b < s.branches(); ++b)
            for (auto k = static_cast<std::size_t>(s.first_point[b]);
                 k < static_cast<std::size_t>(s.first_point[b + 1]); ++k)
                if (b > 0 || s.point[k].y() >= entry) REQUIRE(contains(p.envelope, s.point[k]));
    }
}

TEST_CASE("A tree of one point is a branch, also where the point is at the foot of the trunk") {
    for (const Vec3& size : {Vec3(1, 1, 1), Vec3(5, 0.2, 5), Vec3(0.1, 9, 0.1)})
        for (const EnvelopeShape shape : {EnvelopeShape::sphere, EnvelopeShape::cone, EnvelopeShape::box})
            for (const double leader : {0.0, 0.25})
                for (std::uint64_t seed = 0; seed < 20; ++seed) {
                    ColonizeParameters p = in_shape(shape, 1);
                    p.envelope.size = size;
                    p.envelope.base = Vec3::Zero();
                    p.leader = leader;
                    const Splines s = colonize(p, seed, true, true);
                    REQUIRE_FALSE(check(s));
                    for (std::size_t b = 0; b < s.branches(); ++b)
                        REQUIRE(s.first_point[b + 1] - s.first_point[b] >= 2);
                    REQUIRE(count_bodies(s, SegmentOptions()) >= 1);
                }
}

TEST_CASE("Points out of reach are counted; a trunk without any is refused") {
    ColonizeParameters p = in_shape(EnvelopeShape::box, 40);
    p.kill = 0.05;
    p.influence = 0.9;
    const Colony c = colonize_nodes(with_defaults(p), 2);
    CHECK(c.out_of_reach > 0);
    for (std::size_t i = 0; i < c.point.size(); ++i)
        if (!c.reached[i]) CHECK(nearest(c.node, static_cast<std::size_t>(c.crown), c.point[i]) > 0.9);
    p.influence = 0.06;
    CHECK_THROWS_WITH(colonize_nodes(with_defaults(p), 2), Catch::Contains("influence"));
}

TEST_CASE("Branches begin on their parents, and every node lies on one") {
    for (const ColonizeParameters& given : shapes(1500)) {
        const ColonizeParameters p = with_defaults(given);
        const Colony c = colonize_nodes(p, 3);
        const Splines s = colony_splines(c, p, 3, true, true);
        REQUIRE_FALSE(check(s));
        for (std::size_t b = 1; b < s.branches(); ++b) {
            REQUIRE(s.parent[b] >= 0);
            const auto parent = static_cast<std::size_t>(s.parent[b]);
            REQUIRE(s.level[b] == s.level[parent] + 1);
            const Vec3 begin = s.point[static_cast<std::size_t>(s.first_point[b])];
            REQUIRE((at_fraction(s, parent, s.parent_at[b]) - begin).norm() < 1e-9);
        }
        // One branch a tip; the forks are those of the nodes.
        std::vector<int> children(c.node.size(), 0);
        for (const std::int32_t parent : c.parent)
            if (parent >= 0) ++children[static_cast<std::size_t>(parent)];
        CHECK(std::count(children.begin(), children.end(), 0) == static_cast<std::ptrdiff_t>(s.branches()));
        // Smoothing and thinning moved nothing by more than a step.
        double worst = 0;
        for (const Vec3& q : s.point) worst = std::max(worst, nearest(c.node, 0, q));
        CHECK(worst < p.step);
    }
}

TEST_CASE("Da Vinci's rule holds at every fork, and no radius is below the twigs'") {
    ColonizeParameters p = in_shape(EnvelopeShape::sphere, 3000);
    p.tip_radius = 0.003;
    const Splines s = colonize(p, 3, false, false);
    double tips = 0;
    for (std::size_t b = 0; b < s.branches(); ++b) {
        tips += 0.003 * 0.003;
        const auto first = static_cast<std::size_t>(s.first_point[b]),
                   last = static_cast<std::size_t>(s.first_point[b + 1]) - 1;
        for (std::size_t k = first; k < last; ++k) {
            REQUIRE(s.radius[k] >= 0.003 * (1 - 1e-12));
            REQUIRE(s.radius[k] >= s.radius[k + 1]);
        }
    }
    CHECK(s.radius[0] * s.radius[0] == Approx(tips));
    // At a fork: the section before bears the branch that goes on and those that leave there.
    for (std::size_t b = 0; b < s.branches(); ++b) {
        const auto first = static_cast<std::size_t>(s.first_point[b]),
                   last = static_cast<std::size_t>(s.first_point[b + 1]) - 1;
        for (std::size_t k = first; k + 1 < last; ++k) {
            double leaving = 0;
            for (std::size_t child = b + 1; child < s.branches(); ++child)
                if (s.parent[child] == static_cast<std::int32_t>(b) &&
                    (s.point[static_cast<std::size_t>(s.first_point[child])] - s.point[k]).norm() < 1e-9)
                    leaving += std::pow(s.radius[static_cast<std::size_t>(s.first_point[child])], 2);
            REQUIRE(s.radius[k] * s.radius[k] >= (s.radius[k + 1] * s.radius[k + 1] + leaving) * (1 - 1e-9));
        }
    }
    // By default the trunk's foot is 1/60 of the height.
    CHECK(colonize(in_shape(EnvelopeShape::cone, 3000), 3, false, false).radius[0] == Approx(7.8 / 60));
}

TEST_CASE("Leaves and fruit stand on the last stretch of their branch") {
    ColonizeParameters p = in_shape(EnvelopeShape::cone, 1000);
    p.leaves = 5, p.fruits = 2, p.leafy = 0.2;
    const Splines s = colonize(p, 3, true, true);
    CHECK(s.leaves() == 5 * s.branches());
    CHECK(s.fruits() == 2 * s.branches());
    for (std::size_t i = 0; i < s.leaves(); ++i) {
        const auto b = static_cast<std::size_t>(s.leaf_branch[i]);
        const Vec3 on = at_fraction(s, b, s.leaf_at[i]), tip = at_fraction(s, b, 1);
        REQUIRE((s.leaf_position[i] - on).norm() <= s.radius[static_cast<std::size_t>(s.first_point[b])] + 1e-9);
        REQUIRE((on - tip).norm() <= 0.2 + 1e-9);
    }
    CHECK(colonize(p, 3, false, false).leaves() == 0);
    CHECK(colonize(p, 3, false, false).point == s.point);
}

TEST_CASE("Same seed, same tree; another seed, another") {
    const ColonizeParameters p = in_shape(EnvelopeShape::sphere, 2000);
    const Splines a = colonize(p, 3, true, true), b = colonize(p, 3, true, true), c = colonize(p, 4, true, true);
    CHECK((a.point == b.point && a.radius == b.radius && a.leaf_position == b.leaf_position));
    CHECK((a.fruit_center == b.fruit_center && a.parent == b.parent && a.parent_at == b.parent_at));
    CHECK(a.point != c.point);
}

TEST_CASE("One tree, whatever the number of bodies: mass and first sway, within a tenth") {
    for (const ColonizeParameters& p : {in_shape(EnvelopeShape::sphere, 800), in_mesh(solids::l_prism(), 800)})
        for (const bool leaves : {false, true}) {
            Splines s = colonize(p, 5, leaves, leaves);
            const Tree whole = segment(s, wood_presets().front(), {});
            for (const std::int64_t bodies : cases<std::int64_t>(2, {300, 1500, 20000})) {
                ask_for_bodies(s, bodies);
                const Tree tree = segment(s, wood_presets().front(), {});
                INFO(bodies << " of " << whole.size_bodies() << ", leaves " << leaves);
                CHECK(double(tree.size_bodies()) == Approx(double(bodies)).epsilon(0.1));
                CHECK(std::accumulate(tree.mass.begin(), tree.mass.end(), 0.0) ==
                      Approx(std::accumulate(whole.mass.begin(), whole.mass.end(), 0.0)).epsilon(0.01));
                const auto first = [](const Tree& t) {
                    ModeOptions one;
                    one.count = 1;
                    const SmallMotion small(t, Vec3(0, -9.81, 0), Pose::drawn);
                    return natural_modes(small, t, Scene(), one).front().frequency;
                };
                // Cut more finely than a piece a bend, wood sways more slowly: nearer to the continuous rod.
                const bool finer = bodies > std::int64_t(whole.size_bodies());
                CHECK(first(tree) == Approx(first(whole)).epsilon(finer ? 0.16 : 0.1));
            }
        }
}

TEST_CASE("Parameters out of their range are named") {
    const auto wrong = [](auto change) {
        ColonizeParameters p;
        change(p);
        with_defaults(p);
    };
    CHECK_THROWS_WITH(wrong([](auto& p) { p.points = 0; }), Catch::Contains("attractors: is 0, expected 1 to"));
    CHECK_THROWS_WITH(wrong([](auto& p) { p.kill = 0.5, p.step = 1e-10; }),
                      Catch::Contains("step: is 1e-10, expected at least 1e-7 of the height, 7.8e-07 m"));
    CHECK_THROWS_WITH(wrong([](auto& p) { p.kill = 1, p.step = 2; }), Catch::Contains("kill: is 1, expected at least"));
    CHECK_THROWS_WITH(wrong([](auto& p) { p.kill = 1, p.influence = 0.5; }), Catch::Contains("influence: is 0.5"));
    CHECK_THROWS_WITH(wrong([](auto& p) { p.leader = 2; }), Catch::Contains("leader: is 2, expected 0 to 1"));
    CHECK_THROWS_WITH(wrong([](auto& p) { p.leaf_length = NAN; }), Catch::Contains("leaf length"));
    CHECK_NOTHROW(wrong([](auto& p) { p.step = 2; }));
    CHECK_NOTHROW(wrong([](auto& p) { p.influence = 0.1; }));
}
