#include "clump.h"
#include "random.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace bough {
namespace {

constexpr std::int64_t leaves_a_clump = 64; // on the average, at most

enum class ClumpDraw : std::uint8_t {
    clump = 210,
    leaf,
    start,
    direction,
    normal
}; // apart from the draws of growth (stem.h)

// Powers of the inverse of the root of x^4 = x + 1: the most even recurrence in three dimensions.
constexpr std::array<double, 3> kStep = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};

double fraction(double x) {
    return x - std::floor(x);
}

// Evenly in the unit ball where u, v, w are evenly in 0..1.
Vec3 in_ball(double u, double v, double w) {
    const double radius = std::cbrt(u), z = 2 * v - 1, around = 2 * std::numbers::pi * w;
    const double level = std::sqrt(std::max(0.0, 1 - z * z));
    return radius * Vec3(level * std::cos(around), level * std::sin(around), z);
}

Vec3 any_vector(RandomKey key, ClumpDraw draw) {
    return in_ball(random_unit(key, draw, 0), random_unit(key, draw, 1), random_unit(key, draw, 2));
}

Vec3 direction_of(const Vec3& v, const Vec3& otherwise) {
    const double length = v.norm();
    return length > 1e-9 ? Vec3(v / length) : otherwise;
}

} // namespace

std::vector<std::int32_t> clump_leaves_drawn(const Tree& tree, std::int64_t all) {
    std::int64_t clumps = 0, leaves = 0;
    for (const std::int32_t n : tree.leaf_count)
        if (n > 1) ++clumps, leaves += n;
    if (all == 0)
        all = std::min(std::clamp<std::int64_t>(2 * std::int64_t(tree.leaf_count.size()), 10'000, 200'000),
                       leaves_a_clump * clumps);
    if (leaves <= all) return tree.leaf_count;
    const auto drawn = [](std::int32_t n, double part) {
        return std::max(std::int32_t(std::lround(part * double(n))), std::int32_t(1));
    };
    double part = 0, most = 1; // of a clump's leaves: the largest of which all come to no more
    while (most - part > 1e-9) {
        const double middle = (part + most) / 2;
        std::int64_t sum = 0;
        for (const std::int32_t n : tree.leaf_count) sum += n > 1 ? drawn(n, middle) : 0;
        (sum <= all ? part : most) = middle;
    }
    std::vector<std::int32_t> counts = tree.leaf_count;
    for (std::int32_t& n : counts) n = n > 1 ? drawn(n, part) : n;
    return counts;
}

Vec3 clump_leaf_size(const Tree& tree, std::size_t body, std::int32_t count) {
    const Vec3& size = tree.size[body];
    if (!tree.leaf_length.empty() && tree.leaf_length[body] > 0) {
        const double larger = std::sqrt(double(tree.leaf_count[body]) / double(count));
        return {larger * tree.leaf_length[body], larger * tree.leaf_width[body], size.z()};
    }
    const double smaller = 1 / std::sqrt(double(count));
    return {smaller * size.x(), smaller * size.y(), size.z()};
}

std::vector<ClumpLeaf> clump_leaves(const Tree& tree, std::size_t body, const Mat3& R_wb, std::int32_t count,
                                    double hang) {
    const RandomKey clump = random_key(RandomKey{0}, ClumpDraw::clump, std::uint64_t(body));
    const Vec3 up = R_wb.transpose() * Vec3::UnitY();
    const double length = tree.size[body].x(), width = tree.size[body].y();
    const bool said = !tree.leaf_length.empty() && tree.leaf_length[body] > 0;
    const Vec3 half(width / 2, 0.3 * width, said ? length - tree.com[body].z() : length / 2);
    const double blade = clump_leaf_size(tree, body, count).x();
    const double hangs = std::max(-2 * R_wb(1, 2) - 1, hang), spreads = 1 - 0.7 * hangs;
    std::vector<ClumpLeaf> leaves;
    for (std::int32_t k = 0; k < count; ++k) {
        const RandomKey key = random_key(clump, ClumpDraw::leaf, std::uint64_t(k));
        const auto even = [&](std::size_t d) {
            return fraction(random_unit(clump, ClumpDraw::start, d) + double(k + 1) * kStep[d]);
        };
        const Vec3 place = in_ball(even(0), even(1), even(2));
        const Vec3 middle = tree.com[body] + half.cwiseProduct(place);
        const Vec3 away = direction_of(middle, Vec3::UnitZ());
        ClumpLeaf leaf;
        const Vec3 z = direction_of(spreads * (0.6 * away + 0.7 * place + 0.6 * any_vector(key, ClumpDraw::direction)) -
                                        (0.35 + 0.65 * hangs) * up,
                                    away);
        const Vec3 facing = up + 0.5 * place + 0.6 * any_vector(key, ClumpDraw::normal);
        const Vec3 side = direction_of(facing.cross(z), direction_of(Vec3::UnitX().cross(z), Vec3::UnitY()));
        leaf.axes.col(0) = side;
        leaf.axes.col(1) = z.cross(side);
        leaf.axes.col(2) = z;
        leaf.foot = middle - 0.5 * blade * z;
        leaves.push_back(leaf);
    }
    return leaves;
}

} // namespace bough
