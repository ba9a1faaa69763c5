#include "segment.h"
#include "../base/shortest_text.h"
#include "../model/stiffness.h"
#include "bodies.h"
#include "cut.h"
#include "resolve.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace bough {

namespace {

constexpr std::int64_t most_bodies = std::numeric_limits<std::int32_t>::max(); // what Tree::parent can hold

void refuse_more_than_an_index_holds(std::int64_t pieces, std::int64_t room) {
    if (pieces > room)
        throw std::invalid_argument("more than " + std::to_string(most_bodies) +
                                    " bodies: the segment length is too small for a tree of this size");
}

void check(const SegmentOptions& o) {
    const auto require = [](bool good, const char* field, double value, const char* expected) {
        if (!good || !std::isfinite(value))
            throw std::invalid_argument(std::string(field) + ": is " + shortest_text(value) + ", expected " + expected);
    };
    require(o.segment_length >= 0, "segment_length", o.segment_length, "metres, 0 or more");
    require(o.max_bend > 0, "max_bend", o.max_bend, "radians, more than 0");
    require(o.max_bodies >= 0, "max_bodies", double(o.max_bodies), "0 or more");
    require(o.merge >= 0, "merge", o.merge, "a share of the tree's extent, 0 or more");
}

std::int64_t growing_bodies(const Splines& splines) {
    return std::int64_t(splines.leaves() + splines.fruits());
}

// What a tree is to come to: N bodies at most, as many as come (0), or N about.
struct Budget {
    std::int64_t bodies = 0;
    bool finer = false; // where as many as come are fewer
};

Budget budget_of(const Splines& splines, const SegmentOptions& options) {
    if (options.max_bodies > 0) return {options.max_bodies, false};
    if (options.segment_length > 0) return {};
    return {splines.bodies, true};
}

// The shortening with which as many pieces come as asked for, to a part in a hundred: bisection over its logarithm. 1 where more come anyhow.
double shorten_to_fill(const Curves& curves, CutRule rule, std::int64_t wanted) {
    const auto pieces = [&](double grow) {
        rule.grow = grow;
        return count_pieces(curves, rule, wanted);
    };
    if (curves.size() == 0 || pieces(1) >= wanted) return 1;
    double low = 0.5, high = 1;
    while (pieces(low) <= wanted) {
        high = low;
        low /= 2;
    }
    while (high / low > 1.001 && pieces(high) < wanted - wanted / 100) {
        const double middle = std::sqrt(low * high);
        (pieces(middle) <= wanted ? high : low) = middle;
    }
    return high;
}

CutRule rule_for(const Curves& curves, const Splines& splines, const SegmentOptions& options) {
    CutRule rule{options.segment_length, options.max_bend, 1};
    const Budget budget = budget_of(splines, options);
    if (budget.bodies == 0) return rule;
    if (budget.finer)
        rule.grow = shorten_to_fill(curves, rule, budget.bodies - growing_bodies(splines));
    else if (rule.segment_length > 0 &&
             count_pieces(curves, {0, rule.max_bend, 1}, most_bodies) < count_pieces(curves, rule, most_bodies))
        rule.segment_length = 0; // what the budget would join again need not be cut
    return rule;
}

Tree whole_tree(const Splines& splines, const Curves& curves, const Material& material, const SegmentOptions& options) {
    const std::int64_t room = most_bodies - growing_bodies(splines);
    const CutRule rule = rule_for(curves, splines, options);
    refuse_more_than_an_index_holds(count_pieces(curves, rule, room), room);
    Tree tree = make_bodies(splines, curves, rule, material);
    set_mass(tree, material);
    set_stiffness(tree, material);
    set_damping(tree, material);
    tree.name = splines.name;
    tree.material = material.name;
    tree.source = splines.source;
    tree.color = splines.color;
    return tree;
}

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

std::int64_t count_bodies(const Splines& splines, const SegmentOptions& options) {
    check(options);
    const Curves curves = make_curves(splines, options.merge);
    const std::int64_t others = growing_bodies(splines), room = most_bodies - others;
    const std::int64_t pieces = count_pieces(curves, rule_for(curves, splines, options), room);
    refuse_more_than_an_index_holds(pieces, room);
    const std::int64_t budget = budget_of(splines, options).bodies;
    if (budget == 0 || pieces + others <= budget) return pieces + others;
    return std::int64_t(segment(splines, wood_presets().front(), options).size_bodies());
}

void ask_for_bodies(Splines& splines, std::int64_t bodies) {
    constexpr std::int64_t most = 20'000'000;
    if (bodies < 1 || bodies > most)
        throw std::invalid_argument("bodies: is " + std::to_string(bodies) + ", expected 1 to " + std::to_string(most));
    splines.bodies = bodies;
    if (bodies < most_of_the_least(splines)) count_bodies(splines, {}); // which says what is the least
}

Tree segment(const Splines& splines, const Material& material, const SegmentOptions& options, SegmentReport* report) {
    check(options);
    const Curves curves = make_curves(splines, options.merge);
    Tree tree = whole_tree(splines, curves, material, options);
    const std::int64_t budget = budget_of(splines, options).bodies;
    if (budget > 0 && budget < std::int64_t(tree.size_bodies())) {
        try {
            tree = resolve(tree, budget);
        } catch (const std::invalid_argument& error) {
            throw std::invalid_argument((options.max_bodies > 0 ? "max_bodies: " : "bodies: ") +
                                        std::string(error.what()));
        }
    }
    if (report) {
        *report = {curves.merged_points, curves.dropped_branches, curves.thin_points, std::int64_t(splines.fruits()),
                   0};
        for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
            report->joined_fruit -= tree.kind[i] == Kind::fruit;
            if (tree.kind[i] == Kind::branch)
                report->segment_length = std::max(report->segment_length, tree.size[i][0]);
        }
    }
    return tree;
}

} // namespace bough
