#include "resolve_choice.h"
#include "random.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

namespace bough {
namespace {

constexpr double own_clump = 0.25; // [1] of the threshold, at which a side branch has a clump of its own
constexpr double bodies_power = 0.75;
constexpr std::size_t slowest_kept = 16;
constexpr int most_halvings = 60;

constexpr double branches_spread = 0.05; // [octaves]
constexpr std::int64_t fruit_part = 4;   // what is left of the bodies over what is fruit

enum class ResolveDraw : std::uint8_t { item = 220, fruit }; // apart from the draws of growth (stem.h)

// A branch's pieces, in order; or a leaf, petal or fruit.
struct Limb {
    std::int32_t first, pieces;
    std::int32_t on;     // the body that bears it, -1: the ground
    double weight;       // w
    bool always = false; // resolved whatever the budget: a way to the tree's top, or fruit
};

class Chooser {
public:
    Chooser(const Tree& tree, const Flexibility& give, std::int64_t bodies);
    std::int64_t count(double threshold);
    Resolution take(double threshold);
    std::int64_t keep_fruit(std::int64_t most);
    double least() const { return least_; }
    double most() const { return most_; }

private:
    // Where what is not resolved goes: a body of wood, and there among the leaves, or among the petals.
    struct Bunch {
        std::int32_t items = 0, body = -1;
    };
    bool resolved(std::size_t chain, double t) const {
        return chain_[chain].on < 0 || chain_[chain].always || chain_[chain].weight >= t;
    }
    void keep_slowest(const Flexibility&);
    void keep_top(const DrawnPose&, std::int64_t bodies);
    std::int32_t bodies_of(const Limb&, double t) const;
    void assign_bodies(double t);

    const Tree& tree_;
    std::vector<Limb> chain_;
    std::vector<std::int32_t> chain_of_, piece_;
    std::vector<std::uint8_t> single_;
    std::vector<std::int32_t> wood_;  // of each body: the piece of wood, resolved, that carries it, or leads it
    std::vector<std::int32_t> bunch_; // of each body: its bunch, -1 where it is part of the wood or single
    std::vector<Bunch> bunches_;      // of pieces, then of chains; each with leaves, then with petals
    double least_ = std::numeric_limits<double>::infinity(), most_ = 0;
    std::int64_t bodies_ = 0;
};

Chooser::Chooser(const Tree& tree, const Flexibility& give, std::int64_t bodies)
    : tree_(tree), chain_of_(tree.size_bodies()) {
    const std::size_t n = tree.size_bodies();
    piece_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const std::int32_t p = tree.parent[i];
        if (continues_parent(tree, i) &&
            chain_[std::size_t(chain_of_[std::size_t(p)])].pieces == piece_[std::size_t(p)] + 1) {
            chain_of_[i] = chain_of_[std::size_t(p)];
            piece_[i] = chain_[std::size_t(chain_of_[i])].pieces++;
            continue;
        }
        chain_of_[i] = std::int32_t(chain_.size());
        // What is all alike comes one after another, not all at once.
        const double octaves = tree.kind[i] == Kind::branch ? branches_spread : 1;
        const double spread = std::exp2(octaves * random_sign(RandomKey{0}, ResolveDraw::item, i));
        const double w = spread * give.mass[i] * std::pow(give.slow[i] / give.mass[i], 6);
        chain_.push_back({std::int32_t(i), 1, p, w});
    }
    keep_slowest(give);
    for (std::size_t c = chain_.size(); c-- > 0;) {
        const Limb& chain = chain_[c];
        const double pieces = chain.pieces;
        least_ = std::min(least_, chain.weight / std::pow(pieces, 1 / bodies_power));
        most_ = std::max(most_, chain.weight);
        if (chain.on < 0) continue;
        Limb& on = chain_[std::size_t(chain_of_[std::size_t(chain.on)])];
        if (tree.kind[std::size_t(chain.first)] == Kind::branch) on.weight = std::max(on.weight, chain.weight);
    }
    keep_top(give.pose, bodies);
}

// The side branches that answer most to what shakes the tree: its lowest modes may be theirs.
void Chooser::keep_slowest(const Flexibility& give) {
    std::vector<std::pair<double, std::size_t>> slow;
    double heaviest = 0;
    for (std::size_t c = 0; c < chain_.size(); ++c) {
        const auto i = std::size_t(chain_[c].first);
        heaviest = std::max(heaviest, chain_[c].weight);
        if (tree_.kind[i] == Kind::branch && chain_[c].on >= 0) slow.emplace_back(give.whole[i] / give.mass[i], c);
    }
    const std::size_t count = std::min(slowest_kept, slow.size());
    std::partial_sort(slow.begin(), slow.begin() + std::ptrdiff_t(count), slow.end(), std::greater<>());
    for (std::size_t k = 0; k < count; ++k) {
        double& weight = chain_[slow[k].second].weight;
        weight = std::max(weight, heaviest * std::exp2(-double(k) / 2));
    }
}

// A tree keeps its height: the way to its highest wood is always resolved, if by one body a branch, unless it takes more than half of all bodies.
void Chooser::keep_top(const DrawnPose& pose, std::int64_t bodies) {
    std::int32_t top = -1;
    double height = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < tree_.size_bodies(); ++i) {
        if (tree_.kind[i] != Kind::branch) continue;
        const double y = pose.at(i, Vec3(0, 0, tree_.size[i][0])).y();
        if (y > height) height = y, top = std::int32_t(i);
    }
    std::vector<std::size_t> way;
    for (; top >= 0; top = chain_[way.back()].on) way.push_back(std::size_t(chain_of_[std::size_t(top)]));
    if (2 * std::int64_t(way.size()) > bodies) return;
    for (const std::size_t c : way) chain_[c].always = true;
}

// Fruit hardly sways, but is seen: as many, drawn by lot. Returns how many there are.
std::int64_t Chooser::keep_fruit(std::int64_t most) {
    std::vector<std::pair<double, std::size_t>> lots;
    for (std::size_t c = 0; c < chain_.size(); ++c)
        if (tree_.kind[std::size_t(chain_[c].first)] == Kind::fruit)
            lots.emplace_back(random_sign(RandomKey{0}, ResolveDraw::fruit, std::uint64_t(chain_[c].first)), c);
    const auto kept = std::ptrdiff_t(std::min(std::int64_t(lots.size()), most));
    std::nth_element(lots.begin(), lots.begin() + kept, lots.end());
    for (std::ptrdiff_t k = 0; k < kept; ++k) chain_[lots[std::size_t(k)].second].always = true;
    return kept;
}

std::int32_t Chooser::bodies_of(const Limb& chain, double t) const {
    const double wanted = std::pow(chain.weight / t, bodies_power);
    return wanted >= chain.pieces ? chain.pieces : std::max(1, std::int32_t(wanted + 1e-9));
}

// Where each body goes at this threshold.
void Chooser::assign_bodies(double t) {
    const std::size_t n = tree_.size_bodies();
    single_.assign(n, 0);
    wood_.resize(n);
    bunch_.assign(n, -1);
    bunches_.assign(2 * (n + chain_.size()), {});
    bodies_ = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const auto c = std::size_t(chain_of_[i]);
        const Limb& chain = chain_[c];
        const bool item = tree_.kind[i] != Kind::branch, petal = tree_.kind[i] == Kind::petal;
        if (resolved(c, t)) {
            const std::int64_t k = piece_[i], p = chain.pieces, m = bodies_of(chain, t);
            const bool leads = item || k == 0 || k * m / p != (k - 1) * m / p;
            single_[i] = leads;
            bodies_ += leads;
            wood_[i] = leads ? std::int32_t(i) : wood_[std::size_t(tree_.parent[i])];
            continue;
        }
        const auto on = std::size_t(tree_.parent[i]);
        wood_[i] = wood_[on];
        if (bunch_[on] >= 0)
            bunch_[i] = bunch_[on];
        else
            bunch_[i] = 2 * (!item && chain.weight >= own_clump * t ? std::int32_t(n + c) : wood_[i]);
        if (!item) continue;
        bunch_[i] += petal;
        if (tree_.kind[i] != Kind::fruit) ++bunches_[std::size_t(bunch_[i])].items;
    }
    for (const Bunch& bunch : bunches_) bodies_ += bunch.items > 0;
}

std::int64_t Chooser::count(double t) {
    assign_bodies(t);
    return bodies_;
}

Resolution Chooser::take(double t) {
    assign_bodies(t);
    const std::size_t n = tree_.size_bodies();
    Resolution r;
    r.body.assign(n, -1);
    const auto add_resolved = [&](std::size_t i, bool clump) {
        r.body[i] = std::int32_t(r.size());
        r.first.push_back(std::int32_t(i));
        r.clump.push_back(clump);
        const std::int32_t p = tree_.parent[i];
        r.on.push_back(p < 0 ? -1 : r.body[std::size_t(wood_[std::size_t(p)])]);
    };
    const auto bunch_at = [&](std::size_t i) -> Bunch& {
        // Wood goes with the leaves, or with the petals where there are no leaves.
        const auto b = std::size_t(bunch_[i]);
        return tree_.kind[i] != Kind::petal && bunches_[b].items == 0 ? bunches_[b + 1] : bunches_[b];
    };
    for (std::size_t i = 0; i < n; ++i)
        if (tree_.kind[i] == Kind::branch && single_[i]) add_resolved(i, false);
    for (std::size_t i = 0; i < n; ++i) {
        if (!is_flat(tree_.kind[i])) continue;
        if (single_[i]) {
            add_resolved(i, false);
            continue;
        }
        Bunch& bunch = bunch_at(i);
        if (bunch.items == 1) {
            bunch.items = 0; // one leaf alone is itself
            add_resolved(i, false);
        } else if (bunch.body < 0) {
            bunch.body = std::int32_t(r.size());
            add_resolved(i, true);
        } else {
            r.body[i] = bunch.body;
        }
    }
    for (std::size_t i = 0; i < n; ++i)
        if (tree_.kind[i] == Kind::fruit && single_[i]) add_resolved(i, false);
    for (std::size_t i = 0; i < n; ++i) {
        if (r.body[i] >= 0) continue;
        const std::int32_t clump = bunch_[i] >= 0 ? bunch_at(i).body : -1;
        r.body[i] = clump >= 0 ? clump : r.body[std::size_t(wood_[i])];
    }
    return r;
}

} // namespace

Resolution choose_bodies(const Tree& whole, const Flexibility& give, std::int64_t bodies) {
    Chooser chooser(whole, give, bodies);
    // At the least threshold all is resolved, above the most nothing but the trunks.
    double low = std::log(chooser.least() * 0.99), high = std::log(chooser.most() * 4.1);
    const std::int64_t least = chooser.count(std::exp(high));
    if (least > bodies)
        throw std::invalid_argument(
            "is " + std::to_string(bodies) + ", but this tree has at least " + std::to_string(least) +
            " bodies (its trunks and the way to its top, and on each a clump for what leaves it bears)");
    std::int64_t held = least + chooser.keep_fruit((bodies - least) / fruit_part);
    const std::int64_t enough = bodies - bodies / 100;
    for (int k = 0; k < most_halvings && held < enough && high - low > 1e-9; ++k) {
        const double middle = (low + high) / 2;
        const std::int64_t now = chooser.count(std::exp(middle));
        if (now > bodies)
            low = middle;
        else
            high = middle, held = now;
    }
    return chooser.take(std::exp(high));
}

} // namespace bough
