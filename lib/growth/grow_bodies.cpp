#include "leaf_count.h"
#include "lop.h"
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

    Splines above; // beside the best, the smallest tree met of more bodies than wanted
    std::int64_t above_count = -1;
    double nominal_leaves = 1, nominal_petals = 1; // most_items of the parameters as given
    bool has_foliage() const {
        return (items.leaves && parameters.leaves != 0) || (items.petals && parameters.blossoms != 0) ||
               (items.fruit && parameters.fruits != 0);
    }
};

// Items on all stems, `most` on one, were each stem to bear the most children that it may; only ratios count.
double most_items(const GrowthParameters& p, double most) {
    double product = most != 0 ? std::abs(most) : 1;
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
    const auto size = [](double nominal, double now) {
        return std::clamp(std::sqrt(nominal / now), 1 / kLeafChange, kLeafChange);
    };
    const double leaf = size(search.nominal_leaves, most_items(p, p.leaves));
    p.leaf_scale *= leaf;
    p.leaf_scale_v *= leaf;
    p.petal_scale *= size(search.nominal_petals, most_items(p, p.blossoms));
    return p;
}

void keep_above(Search& search, Splines& tree, std::int64_t count) {
    if (count <= search.bodies || (search.above_count >= 0 && count >= search.above_count)) return;
    search.above = std::move(tree);
    search.above_count = count;
}

// Logarithm of bodies over those wanted, remembering the tree nearest to what is wanted; a tree of more than twice that
// is given up.
double miss(Search& search, const Dial& dial) {
    const std::int64_t enough = 2 * search.bodies + 100;
    Splines tree;
    std::int64_t count = enough;
    const GrowthParameters p = scaled(search, dial);
    if (grow_up_to(p, search.seed, search.items, enough, tree)) {
        say_leaf_count(tree, p.leaf_scale / search.parameters.leaf_scale);
        count = count_bodies(tree, SegmentOptions());
        std::int64_t count_kept = count; // of `tree`, which the best one before may become
        if (search.best_count < 0 || std::abs(count - search.bodies) < std::abs(search.best_count - search.bodies)) {
            std::swap(search.best, tree);
            std::swap(search.best_count, count_kept);
        }
        keep_above(search, tree, count_kept);
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
    keep(s.leaf_count, kept);
    keep(s.leaf_branch, kept);
    return true;
}

// Leaves twigs out of the next larger tree until it has the number wanted, halving into how many.
bool lop(Search& search) {
    std::int64_t few = 0, many = static_cast<std::int64_t>(search.above.branches());
    while (many - few > 1 && !near(search, kNear)) {
        const std::int64_t middle = few + (many - few) / 2;
        Splines tree = without_twigs(search.above, search.seed, middle);
        const std::int64_t count = count_bodies(tree, SegmentOptions());
        (count > search.bodies ? few : many) = middle;
        if (std::abs(count - search.bodies) >= std::abs(search.best_count - search.bodies)) continue;
        search.best = std::move(tree);
        search.best_count = count;
    }
    return near(search, kWithin);
}

} // namespace

Splines grow_bodies(const GrowthParameters& parameters, std::uint64_t seed, const Items& items, std::int64_t bodies) {
    check_growth(parameters);
    if (bodies < 1 || bodies > kMostBodies)
        throw std::invalid_argument("bodies: is " + std::to_string(bodies) + ", expected 1 to " +
                                    std::to_string(kMostBodies));
    Search search{parameters,
                  seed,
                  items,
                  bodies,
                  {},
                  -1,
                  {},
                  -1,
                  most_items(parameters, parameters.leaves),
                  most_items(parameters, parameters.blossoms)};
    Search deeper; // with one level more, if that was near already
    while (true) {
        Dial dial;
        turn(search, dial, &Dial::main);
        // One bough more or less can be a step too wide for a small tree.
        if (!near(search, kNear)) turn(search, dial, &Dial::fine);
        if (search.parameters.levels <= 2 || deepest_children(search, dial) >= 1) break;
        Search shallower{search.parameters,    seed, items, bodies, {}, -1, {}, -1, search.nominal_leaves,
                         search.nominal_petals};
        --shallower.parameters.levels;
        if (near(search, kWithin)) deeper = std::move(search);
        search = std::move(shallower);
    }
    if (near(search, kWithin)) return std::move(search.best);
    keep_above(search, search.best, search.best_count);
    if (search.above_count >= 0 && pluck(search.above, seed, search.above_count - bodies))
        return std::move(search.above);
    if (near(deeper, kWithin)) return std::move(deeper.best);
    if (search.above_count >= 0 && lop(search)) return std::move(search.best);
    if (search.best_count < 0) // even the smallest numbers tried make more than twice as many
        throw std::invalid_argument("bodies: is " + std::to_string(bodies) + ", but \"" + parameters.name +
                                    "\" grows to more than twice that whatever its numbers of children, expected more");
    throw std::invalid_argument("bodies: is " + std::to_string(bodies) + ", but the nearest that \"" + parameters.name +
                                "\" grows to is " + std::to_string(search.best_count));
}

} // namespace bough
