#include "grow.h"
#include "carry.h"
#include "leaf_count.h"
#include "pipe.h"
#include "segment.h"
#include "stand.h"
#include "stem.h"
#include <algorithm>
#include <stdexcept>

namespace bough {

namespace {

constexpr std::size_t kMostItems = 50'000'000;     // branches, leaves and fruit
constexpr std::size_t kMostPoints = 1'000'000'000; // what Splines::first_point can hold, and some room

// No tree needs more: each trunk and each branch on the way to the top are a body, with a clump of leaves and one of petals each.
std::int64_t most_of_the_least(const Splines& s) {
    const auto roots = std::count(s.parent.begin(), s.parent.end(), -1);
    std::vector<std::int32_t> depth(s.branches(), 0);
    std::int32_t deepest = 0;
    for (std::size_t b = 0; b < s.branches(); ++b) {
        if (s.parent[b] >= 0) depth[b] = depth[std::size_t(s.parent[b])] + 1;
        deepest = std::max(deepest, depth[b]);
    }
    return 3 * (roots + deepest);
}

} // namespace

void check_size(const Splines& out, std::size_t waiting) {
    if (out.branches() + waiting + out.leaves() + out.fruits() > kMostItems || out.points() > kMostPoints)
        throw std::invalid_argument("branches, seg_splits, leaves: make more than 5e7 branches and leaves or 1e9 "
                                    "points, expected fewer");
}

Splines grow(const GrowthParameters& parameters, std::uint64_t seed, const Items& items) {
    check_growth(parameters);
    Splines out;
    out.name = parameters.name;
    if (parameters.rules == GrowthRules::bough)
        grow_stems(parameters, seed, items, out);
    else if (parameters.rules == GrowthRules::sapling)
        grow_sapling(parameters, seed, items, out);
    else
        grow_segments(parameters, seed, items, out);
    if (!items.petals) out.leaf_kind.clear();
    if (parameters.pipe_exponent > 0) thicken_by_pipe_model(out, exponent_for_trunk(out, parameters.pipe_exponent));
    if (parameters.most_sag > 0) {
        thicken_to_carry(out, parameters.wood, parameters.most_sag);
        thicken_to_stand(out, parameters.wood, parameters.most_sag);
    }
    say_leaf_count(out);
    return out;
}

Splines grow_bodies(const GrowthParameters& parameters, std::uint64_t seed, const Items& items, std::int64_t bodies) {
    constexpr std::int64_t most = 20'000'000;
    if (bodies < 1 || bodies > most)
        throw std::invalid_argument("bodies: is " + std::to_string(bodies) + ", expected 1 to " + std::to_string(most));
    Splines result = grow(parameters, seed, items);
    result.bodies = bodies;
    if (bodies < most_of_the_least(result)) count_bodies(result, {}); // which says what is the least
    return result;
}

} // namespace bough
