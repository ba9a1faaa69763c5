// lane_shapes.h: forests of shapes that rows of lanes find hard: stars, combs, chains, single bodies, grown trees.
#pragma once
#include "lib/growth/grow.h"
#include "lib/growth/segment.h"
#include "lib/lanes/layout.h"
#include "make_tree.h"
#include <algorithm>
#include <string>
#include <vector>

namespace lane_shapes {

using namespace bough;
using namespace bough::fast;

struct Shape {
    std::string name;
    std::vector<std::int32_t> parent;
    std::vector<Kind> kind;
    std::vector<std::uint32_t> ground; // of each root
    std::uint32_t grounds = 1;

    Shape(std::string of, const Tree& tree) : Shape(std::move(of), tree.parent, tree.kind) {}
    Shape(std::string of, std::vector<std::int32_t> p, std::vector<Kind> k)
        : name(std::move(of)), parent(std::move(p)), kind(std::move(k)) {
        ground.assign(std::size_t(std::count(parent.begin(), parent.end(), -1)), 0);
    }
    Layout layout(int lanes) const { return make_layout(parent, kind, ground, grounds, lanes); }
};

inline Tree grown_tree(std::int64_t bodies) {
    return segment(grow_bodies(default_growth(), 7, {true, false, true}, bodies), wood_presets().front(), {});
}

// A trunk's body with `chains` chains of one body, every fifth a leaf, every seventh a fruit, every eleventh a petal.
inline Shape star(std::int32_t chains) {
    std::vector<std::int32_t> parent{-1};
    std::vector<Kind> kind{Kind::branch};
    for (std::int32_t k = 1; k <= chains; ++k) {
        parent.push_back(0);
        kind.push_back(k % 5 == 0 ? Kind::leaf : k % 7 == 0 ? Kind::fruit : k % 11 == 0 ? Kind::petal : Kind::branch);
    }
    return {"star", parent, kind};
}

inline Shape bare_star(std::int32_t chains) {
    std::vector<std::int32_t> parent(std::size_t(chains) + 1, 0);
    parent[0] = -1;
    return {"star of one kind", parent, std::vector<Kind>(parent.size(), Kind::branch)};
}

// A body with chains a little longer than a block may be.
inline Shape comb(std::int32_t chains, std::int32_t pieces) {
    std::vector<std::int32_t> parent{-1};
    for (std::int32_t k = 0; k < chains * pieces; ++k) parent.push_back(k % pieces == 0 ? 0 : k);
    return {"comb", parent, std::vector<Kind>(parent.size(), Kind::branch)};
}

// One chain, a leaf on each body where asked for.
inline Shape deep(std::int32_t pieces, bool leaves) {
    std::vector<std::int32_t> parent;
    for (std::int32_t k = 0; k < pieces; ++k) parent.push_back(k - 1);
    std::vector<Kind> kind(parent.size(), Kind::branch);
    for (std::int32_t k = 0; leaves && k < pieces; ++k) {
        parent.push_back(k);
        kind.push_back(Kind::leaf);
    }
    return {leaves ? "deep chain with leaves" : "deep chain", parent, kind};
}

// Limbs of 250 bodies on a trunk's first, each body with a twig of 12.
inline Shape limbs(std::int32_t axes) {
    std::vector<std::int32_t> parent{-1};
    for (std::int32_t axis = 0; axis < axes; ++axis) {
        std::int32_t below = 0;
        for (std::int32_t k = 0; k < 250; ++k) {
            const auto body = std::int32_t(parent.size());
            parent.push_back(below);
            below = body;
            for (std::int32_t twig = 0; twig < 12; ++twig) parent.push_back(body + twig);
        }
    }
    return {"limbs", parent, std::vector<Kind>(parent.size(), Kind::branch)};
}

// Long ropes side by side: larger blocks would part them.
inline Shape ropes(std::int32_t count, std::int32_t pieces) {
    std::vector<std::int32_t> parent{-1};
    for (std::int32_t k = 0; k < count * pieces; ++k) parent.push_back(k % pieces == 0 ? 0 : k);
    return {"ropes", parent, std::vector<Kind>(parent.size(), Kind::branch)};
}

// Both, one after the other.
inline Shape beside(const Shape& a, const Shape& b) {
    Shape both{a.name + " and " + b.name, a.parent, a.kind};
    for (const std::int32_t p : b.parent) both.parent.push_back(p < 0 ? p : p + std::int32_t(a.parent.size()));
    both.kind.insert(both.kind.end(), b.kind.begin(), b.kind.end());
    both.ground.insert(both.ground.end(), b.ground.begin(), b.ground.end());
    return both;
}

// Each body with two others on it, to a depth of 13.
inline Shape binary() {
    std::vector<std::int32_t> parent{-1};
    while (parent.size() < 8191) parent.push_back(std::int32_t(parent.size() - 1) / 2);
    return {"binary", parent, std::vector<Kind>(parent.size(), Kind::branch)};
}

// Single bodies, standing on five grounds by turns.
inline Shape meadow(std::int32_t blades) {
    Shape shape{"meadow", std::vector<std::int32_t>(std::size_t(blades), -1),
                std::vector<Kind>(std::size_t(blades), Kind::branch)};
    shape.grounds = 5;
    for (std::size_t k = 0; k < shape.ground.size(); ++k) shape.ground[k] = std::uint32_t(k % 5);
    return shape;
}

inline std::vector<Shape> shapes() {
    std::vector<Shape> all{{"branched", make_tree::branched()},
                           {"random 50", make_tree::random_tree(50, 1)},
                           {"random 1000", make_tree::random_tree(1000, 2)},
                           {"random 7000", make_tree::random_tree(7000, 3)},
                           {"chain", make_tree::chain(20, 2, 0.03, 0.01)},
                           {"grown 500", grown_tree(500)},
                           {"grown 20000", grown_tree(20000)},
                           {"one body", {-1}, {Kind::branch}},
                           {"one leaf", {-1}, {Kind::leaf}},
                           star(5000),
                           bare_star(5000),
                           bare_star(50000),
                           comb(9, 4150),
                           deep(3000, false),
                           deep(9000, true),
                           binary(),
                           limbs(35),
                           beside(limbs(8), limbs(9)), // two tops
                           meadow(3000)};
    Shape forest{"forest", make_tree::forest({make_tree::branched(), make_tree::random_tree(1200, 5),
                                              make_tree::chain(7, 1, 0.02, 0.01), make_tree::random_tree(2600, 6)})};
    forest.grounds = 3;
    forest.ground = {2, 0, 1, 2};
    all.push_back(forest);
    return all;
}

} // namespace lane_shapes
