#include "grow.h"
#include "carry.h"
#include "leaf_count.h"
#include "pipe.h"
#include "segment.h"
#include "stand.h"
#include "stem.h"
#include <stdexcept>

namespace bough {

namespace {

constexpr std::size_t kMostItems = 50'000'000;     // branches, leaves and fruit
constexpr std::size_t kMostPoints = 1'000'000'000; // what Splines::first_point can hold, and some room

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
        if (const std::size_t falling = thicken_to_stand(out, parameters.wood, parameters.most_sag); falling > 0)
            throw std::invalid_argument("most_sag: " + std::to_string(falling) +
                                        " branches do not stand under twice their weight, however thick: expected "
                                        "shorter ones, or stiffer wood");
    }
    say_leaf_count(out);
    return out;
}

Splines grow_bodies(const GrowthParameters& parameters, std::uint64_t seed, const Items& items, std::int64_t bodies) {
    Splines result = grow(parameters, seed, items);
    ask_for_bodies(result, bodies);
    return result;
}

} // namespace bough
