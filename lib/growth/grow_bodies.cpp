#include "segment.h"
#include "stem.h"
#include "weber_penn.h"
#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace bough {

namespace {

// How much more a level's numbers follow the factor than those of the level above it: a tree of few bodies keeps its
// boughs and loses its twigs.
constexpr std::array<double, 4> kWeight = {0, 1, 1.6, 2.4};
constexpr double kLeafWeight = 0.2;
constexpr double kLeafChange = 4;
constexpr double kNear = 0.05;  // share of the bodies wanted at which the search ends
constexpr double kWithin = 0.1; // and that the contract allows
constexpr std::int64_t kMostBodies = 20'000'000;
constexpr double kMost = 1e6; // of one stem's children (grow.h)

struct Search {
    GrowthParameters parameters;
    std::uint64_t seed;
    Items items;
    std::int64_t bodies;
    Splines best;
    std::int64_t best_count = -1;

    Splines above; // the smallest tree met of more bodies than wanted
    std::int64_t above_count = -1;
    double nominal_leaves = 1; // most_leaves of the parameters as given
    bool has_foliage() const {
        return (items.leaves && parameters.leaves != 0) || (items.petals && parameters.blossoms != 0) ||
               (items.fruit && parameters.fruits != 0);
    }
};

// Leaves on all stems, were each to bear the most children that it may; 1 for one without leaves, as only ratios count.
double most_leaves(const GrowthParameters& p) {
    double product = p.leaves != 0 ? std::abs(p.leaves) : 1;
    for (int n = 1; n < p.levels; ++n) product *= std::max(p.level[std::size_t(n)].branches, 1e-9);
    return product;
}

// Numbers changed by e^main, shared among the levels by their weights; those of the last level also by e^fine.
struct Dial {
    double main = 0, fine = 0;
};

GrowthParameters scaled(const Search& search, const Dial& dial) {
    GrowthParameters p = search.parameters;
    double sum = search.has_foliage() ? kLeafWeight : 0;
    for (int n = 1; n < p.levels; ++n) sum += kWeight[n];
    if (sum == 0) return p;
    const auto factor = [&](double weight) { return std::exp(dial.main * weight / sum); };
    for (int n = 1; n < p.levels; ++n) {
        const double fine = n + 1 == p.levels ? std::exp(dial.fine) : 1;
        p.level[n].branches = std::min(kMost, p.level[n].branches * factor(kWeight[n]) * fine);
    }
    p.leaves = std::clamp(p.leaves * factor(kLeafWeight), -kMost, kMost);
    p.blossoms = std::min(kMost, p.blossoms * factor(kLeafWeight));
    p.fruits = std::min(kMost, p.fruits * factor(kLeafWeight));
    const double size = std::clamp(std::sqrt(search.nominal_leaves / most_leaves(p)), 1 / kLeafChange, kLeafChange);
    p.leaf_scale *= size;
    p.leaf_scale_v *= size;
    p.petal_scale *= size;
    return p;
}

// Logarithm of bodies over those wanted, remembering the tree nearest to what is wanted; a tree of more than twice that
// is given up.
double miss(Search& search, const Dial& dial) {
    const std::int64_t enough = 2 * search.bodies + 100;
    Splines tree;
    std::int64_t count = enough;
    if (grow_up_to(scaled(search, dial), search.seed, search.items, enough, tree)) {
        count = count_bodies(tree, SegmentOptions());
        if (count > search.bodies && (search.above_count < 0 || count < search.above_count)) {
            search.above = tree;
            search.above_count = count;
        }
        if (search.best_count < 0 || std::abs(count - search.bodies) < std::abs(search.best_count - search.bodies)) {
            search.best = std::move(tree);
            search.best_count = count;
        }
    }
    return std::log(static_cast<double>(count) / static_cast<double>(search.bodies));
}

bool near(const Search& search, double share) {
    const auto wanted = static_cast<double>(search.bodies);
    return search.best_count >= 0 && std::abs(static_cast<double>(search.best_count) - wanted) <= share * wanted;
}

// Turns one knob of the dial until the tree is near: brackets, then regula falsi with every third step a halving. A
// count is nearly proportional to e^main, so few trees are grown. Leaves the knob at the bracket's lower end.
void turn(Search& search, Dial& dial, double Dial::*knob) {
    const auto miss_at = [&](double x) {
        dial.*knob = x;
        return miss(search, dial);
    };
    constexpr double widest = 40; // e^40: no tree needs more
    double low = 0, high = 0, at_low = miss_at(0), at_high = at_low;
    for (double step = std::max(1.0, std::abs(at_low)); !near(search, kNear) && at_low > 0 && low > -widest;
         step *= 1.5) {
        high = low, at_high = at_low;
        low -= step, at_low = miss_at(low);
    }
    for (double step = std::max(1.0, std::abs(at_high)); !near(search, kNear) && at_high < 0 && high < widest;
         step *= 1.5) {
        low = high, at_low = at_high;
        high += step, at_high = miss_at(high);
    }
    for (int i = 0; !near(search, kNear) && at_low < 0 && at_high > 0 && high - low > 1e-3; ++i) {
        const double share = std::clamp(at_low / (at_low - at_high), 0.05, 0.95);
        const double x = low + (i % 3 == 2 ? 0.5 : share) * (high - low);
        const double at_x = miss_at(x);
        if (at_x > 0)
            high = x, at_high = at_x;
        else
            low = x, at_low = at_x;
    }
    if (!near(search, kNear)) dial.*knob = low;
}

// Stems of the deepest level on one of the level above, about.
double deepest_children(const Search& search, const Dial& dial) {
    return scaled(search, dial).level[search.parameters.levels - 1].branches;
}

template <class T> void keep(std::vector<T>& values, const std::vector<std::uint8_t>& kept) {
    if (values.empty()) return;
    std::size_t to = 0;
    for (std::size_t i = 0; i < kept.size(); ++i)
        if (kept[i]) values[to++] = values[i];
    values.resize(to);
}

// Leaves out `surplus` leaves and petals, spread over the tree by the seed, as one leaf is one body. False if it has
// fewer.
bool pluck(Splines& s, std::uint64_t seed, std::int64_t surplus) {
    if (surplus > static_cast<std::int64_t>(s.leaves())) return false;
    std::vector<std::size_t> order(s.leaves());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto key = [seed](std::size_t leaf) { return random_key(seed, Draw::leaf, leaf); };
    std::nth_element(order.begin(), order.begin() + surplus, order.end(),
                     [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    std::vector<std::uint8_t> kept(s.leaves(), 1);
    for (std::int64_t i = 0; i < surplus; ++i) kept[order[std::size_t(i)]] = 0;
    keep(s.leaf_at, kept);
    keep(s.leaf_position, kept);
    keep(s.leaf_rotation, kept);
    keep(s.leaf_length, kept);
    keep(s.leaf_width, kept);
    keep(s.leaf_kind, kept);
    keep(s.leaf_branch, kept);
    return true;
}

} // namespace

Splines grow_bodies(const GrowthParameters& parameters, std::uint64_t seed, const Items& items, std::int64_t bodies) {
    check_growth(parameters);
    if (bodies < 1 || bodies > kMostBodies)
        throw std::invalid_argument("bodies: is " + std::to_string(bodies) + ", expected 1 to " +
                                    std::to_string(kMostBodies));
    Search search{parameters, seed, items, bodies, {}, -1, {}, -1, most_leaves(parameters)};
    while (true) {
        Dial dial;
        turn(search, dial, &Dial::main);
        // One bough more or less can be a step too wide for a small tree.
        if (!near(search, kNear)) turn(search, dial, &Dial::fine);
        if (search.parameters.levels <= 2 || deepest_children(search, dial) >= 1) break;
        const int levels = search.parameters.levels;
        // Leaves take their angles from the level that is left out, as they would from the one below the last.
        search = Search{search.parameters, seed, items, bodies, {}, -1, {}, -1, search.nominal_leaves};
        search.parameters.levels = levels - 1;
    }
    if (near(search, kWithin)) return std::move(search.best);
    if (search.above_count >= 0 && pluck(search.above, seed, search.above_count - bodies))
        return std::move(search.above);
    throw std::invalid_argument("bodies: is " + std::to_string(bodies) + ", but the nearest that \"" + parameters.name +
                                "\" grows to is " + std::to_string(search.best_count));
}

} // namespace bough
