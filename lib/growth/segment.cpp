#include "segment.h"
#include "../model/stiffness.h"
#include "bodies.h"
#include "cut.h"
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

std::int64_t growing_bodies(const Splines& splines) {
    return std::int64_t(splines.leaves() + splines.fruits());
}

// The least lengthening with which all pieces fit, to a part in a thousand: bisection over its logarithm.
double grow_to_fit(const Curves& curves, CutRule rule, std::int64_t room, std::int64_t others) {
    const auto fits = [&](double grow) {
        rule.grow = grow;
        return count_pieces(curves, rule, room) <= room;
    };
    if (fits(1)) return 1;
    const double as_few_as_can_be = std::numeric_limits<double>::infinity();
    if (!fits(as_few_as_can_be)) {
        rule.grow = as_few_as_can_be;
        const std::int64_t least = count_pieces(curves, rule, most_bodies) + others;
        throw std::invalid_argument("max_bodies is " + std::to_string(room + others) + ", but this tree has at least " +
                                    std::to_string(least) + " bodies (a piece for each branch, and " +
                                    std::to_string(others) + " leaves and fruit)");
    }
    double low = 1, high = 2;
    while (!fits(high)) {
        low = high;
        high *= 2;
    }
    while (high / low > 1.001) {
        const double middle = std::sqrt(low * high);
        (fits(middle) ? high : low) = middle;
    }
    return high;
}

CutRule rule_for(const Curves& curves, const Splines& splines, const SegmentOptions& options) {
    CutRule rule{options.segment_length, options.max_bend, 1};
    const std::int64_t others = growing_bodies(splines);
    if (options.max_bodies > 0) rule.grow = grow_to_fit(curves, rule, options.max_bodies - others, others);
    return rule;
}

} // namespace

std::int64_t count_bodies(const Splines& splines, const SegmentOptions& options) {
    const Curves curves = make_curves(splines, options.merge);
    const std::int64_t others = growing_bodies(splines), room = most_bodies - others;
    const std::int64_t pieces = count_pieces(curves, rule_for(curves, splines, options), room);
    refuse_more_than_an_index_holds(pieces, room);
    return pieces + others;
}

Tree segment(const Splines& splines, const Material& material, const SegmentOptions& options, SegmentReport* report) {
    const Curves curves = make_curves(splines, options.merge);
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
    if (report) {
        *report = {curves.merged_points, curves.dropped_branches, curves.thin_points, 0};
        for (std::size_t i = 0; i < tree.size_bodies(); ++i)
            if (tree.kind[i] == Kind::branch)
                report->segment_length = std::max(report->segment_length, tree.size[i][0]);
    }
    return tree;
}

} // namespace bough
