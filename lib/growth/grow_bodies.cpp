#include "segment.h"
#include "weber_penn.h"
#include <algorithm>
#include <stdexcept>

namespace bough {

namespace {

// How much more a level's numbers follow the factor than those of the level above it: a tree of few bodies keeps its
// boughs and loses its twigs.
constexpr std::array<double, 4> kWeight = {0, 1, 1.6, 2.4};
constexpr double kLeafWeight = 1.2;
constexpr double kMost = 1e6; // of one stem's children (grow.h)

struct Search {
    GrowthParameters parameters;
    std::uint64_t seed;
    bool with_leaves, with_fruit;
    std::int64_t bodies;
    Splines best;
    std::int64_t best_count = -1;

    bool has_leaves() const { return with_leaves && parameters.leaves != 0; }
    bool has_fruit() const { return with_fruit && parameters.fruits != 0; }
};

GrowthParameters scaled(const Search& search, double log_factor) {
    GrowthParameters p = search.parameters;
    const bool foliage = search.has_leaves() || search.has_fruit();
    double sum = foliage ? kLeafWeight : 0;
    for (int n = 1; n < p.levels; ++n) sum += kWeight[n];
    if (sum == 0) return p;
    const auto factor = [&](double weight) { return std::exp(log_factor * weight / sum); };
    for (int n = 1; n < p.levels; ++n) p.level[n].branches = std::min(kMost, p.level[n].branches * factor(kWeight[n]));
    p.leaves = std::clamp(p.leaves * factor(kLeafWeight), -kMost, kMost);
    p.fruits = std::min(kMost, p.fruits * factor(kLeafWeight));
    return p;
}

// Bodies at this factor, remembering the tree nearest to what is wanted; more than four times that is not counted out.
double count_at(Search& search, double log_factor) {
    const std::int64_t enough = 4 * search.bodies;
    Splines tree;
    if (!grow_up_to(scaled(search, log_factor), search.seed, search.with_leaves, search.with_fruit, enough, tree))
        return static_cast<double>(enough);
    const std::int64_t count = count_bodies(tree, SegmentOptions());
    if (search.best_count < 0 || std::abs(count - search.bodies) < std::abs(search.best_count - search.bodies)) {
        search.best = std::move(tree);
        search.best_count = count;
    }
    return static_cast<double>(count);
}

bool near(const Search& search, double share) {
    return search.best_count >= 0 &&
           std::abs(double(search.best_count - search.bodies)) <= share * double(search.bodies);
}

// Finds the factor by regula falsi on logarithms, halving where that is slow; a count is nearly proportional to the
// factor, so few trees are grown. Returns the factor's logarithm.
double find_factor(Search& search) {
    const auto miss = [&](double x) { return std::log(count_at(search, x) / double(search.bodies)); };
    constexpr double widest = 40; // e^40: no tree needs more
    double low = 0, high = 0, at_low = miss(0), at_high = at_low;
    for (double step = std::max(1.0, std::abs(at_low)); at_low > 0 && low > -widest; step *= 1.5) {
        high = low, at_high = at_low;
        low -= step, at_low = miss(low);
    }
    for (double step = std::max(1.0, std::abs(at_high)); at_high < 0 && high < widest; step *= 1.5) {
        low = high, at_low = at_high;
        high += step, at_high = miss(high);
    }
    double x = at_low > 0 ? low : high;
    for (int i = 0; i < 48 && !near(search, 0.02) && at_low < 0 && at_high > 0; ++i) {
        const double share = std::clamp(at_low / (at_low - at_high), 0.05, 0.95);
        x = low + (i % 3 == 2 ? 0.5 : share) * (high - low);
        const double at_x = miss(x);
        if (at_x > 0)
            high = x, at_high = at_x;
        else
            low = x, at_low = at_x;
    }
    return x;
}

// Stems of the deepest level on one of the level above, about.
double deepest_children(const Search& search, double log_factor) {
    return scaled(search, log_factor).level[search.parameters.levels - 1].branches;
}

} // namespace

Splines grow_bodies(const GrowthParameters& parameters, std::uint64_t seed, bool with_leaves, bool with_fruit,
                    std::int64_t bodies) {
    check_growth(parameters);
    if (bodies < 1) throw std::invalid_argument("bodies: is " + std::to_string(bodies) + ", expected 1 or more");
    Search search{parameters, seed, with_leaves, with_fruit, bodies, {}, -1};
    while (true) {
        const double factor = find_factor(search);
        if (search.parameters.levels <= 2 || deepest_children(search, factor) >= 1) break;
        const int levels = search.parameters.levels;
        // Leaves take their angles from the level that is left out, as they would from the one below the last.
        search = Search{search.parameters, seed, with_leaves, with_fruit, bodies, {}, -1};
        search.parameters.levels = levels - 1;
    }
    if (near(search, 0.1)) return std::move(search.best);
    throw std::invalid_argument("bodies: is " + std::to_string(bodies) + ", but the nearest that \"" + parameters.name +
                                "\" grows to is " + std::to_string(search.best_count));
}

} // namespace bough
