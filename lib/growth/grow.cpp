#include "grow.h"
#include "carry.h"
#include "leaf_count.h"
#include "pipe.h"
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

bool grow_up_to(const GrowthParameters& parameters, std::uint64_t seed, const Items& items, std::int64_t most,
                Splines& out) {
    check_growth(parameters);
    out = Splines();
    out.name = parameters.name;
    const bool whole = parameters.rules == GrowthRules::bough     ? grow_stems(parameters, seed, items, most, out)
                       : parameters.rules == GrowthRules::sapling ? grow_sapling(parameters, seed, items, most, out)
                                                                  : grow_segments(parameters, seed, items, most, out);
    if (!items.petals) out.leaf_kind.clear();
    if (!whole) return false;
    if (parameters.pipe_exponent > 0) thicken_by_pipe_model(out, exponent_for_trunk(out, parameters.pipe_exponent));
    if (parameters.most_sag > 0) thicken_to_carry(out, parameters.wood, parameters.most_sag);
    return true;
}

Splines grow(const GrowthParameters& parameters, std::uint64_t seed, const Items& items) {
    Splines result;
    grow_up_to(parameters, seed, items, INT64_MAX, result);
    say_leaf_count(result);
    return result;
}

} // namespace bough
