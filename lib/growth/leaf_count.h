// leaf_count.h: how many leaves a leaf of the splines stands for. From 2 on it is a clump: leaves on twigs of their own, which are not drawn.
//
// Growth draws each leaf, however long its parameters have it; what a number of bodies leaves out is put into clumps later (resolve.h).
// Splines that do not say, as imports do not: a leaf no longer than 0.2 m is one; a longer one is taken for a card that
// shows a spray of leaves, and stands for round(area over that of a leaf of 0.08 m of the same proportions) of them. Why:
// most broad leaves are 0.05 to 0.15 m long, and programs that sell or draw trees put sprays on cards of 0.3 to 2 m; a
// tree whose leaves are truly longer (a palm's fronds) says leaf_count 1. A petal is always one.
#pragma once
#include "../model/splines.h"

namespace bough {

constexpr double longest_leaf = 0.2;    // [m] beyond, a leaf that is not spoken of is a card
constexpr double reference_leaf = 0.08; // [m] length of the leaves on it

// Of each leaf: what the splines say, or the rule above. O(leaves).
std::vector<std::int32_t> leaf_counts(const Splines&);

// Says that every leaf is one. Left unsaid where none is longer than longest_leaf.
void say_leaf_count(Splines&);

} // namespace bough
