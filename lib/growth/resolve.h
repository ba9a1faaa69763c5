// resolve.h: a tree on fewer bodies: what is left out stays as mass, inertia, give, drag and damping on what carries it.
//
// The whole tree is that of segment(). A budget takes from it
//   wood     of each branch that is resolved a number of bodies, each for some pieces one after another;
//   leaves   (petals, fruit) that are resolved, as they are, on the wood that carries them;
//   clumps   of what is not resolved and bears leaves or petals: one on each body of wood for all small side branches on it and their leaves, one for
//            each larger side branch. A clump stands for its leaves (Tree::leaf_count) and holds the wood under them.
// Side branches without leaves, and fruit, are one with the wood that carries them. Nothing is lost: mass, centre of mass and inertia of each joint's
// load are the whole tree's, as drawn.
//
// What is resolved. A side branch of mass m, with all that it bears, and give S (flexibility.h) has a frequency omega_b, omega_b^2 = 3 m / S,
// near toppling a low
// one. It weighs w = m (S / m)^6, and not less than what it bears: the heavy and, by far more, the slow, for the lowest modes of a tree are
// mostly those of
// its softest twigs. One threshold t for the whole tree: branches of w >= t are resolved, by (w / t)^0.4 bodies; a clump is a side branch's own
// where w >= t / 4;
// a leaf is resolved where its own w >= t (alike leaves' are spread by a factor of up to 2 each way). t is the least that keeps to the budget.
// The branches to the highest
// wood are always resolved, by one body each. The two
// exponents are fitted: those at which the first three frequencies of the eight species are nearest to the whole tree's.
//
// Joints. From the tips inward each body's joint is made as soft as gives what its parts' joints gave together, in the tree as resolved so far:
// so the
// bend under a slow push is the whole tree's, weight and all. What it is in proportion to: for wood, the sum of its branch's joints to a torque
// about the first;
// for a clump, a ball. A clump's joint stands in the wood, at a length L from its centre of mass, toward the base of what bears it, 1.15 times
// the clump's
// radius of gyration, so that it swings at a twig's frequency, or what keeps it from drooping by more than 0.8 rad held out level. Damping: so that
// the same is lost.
// Air. Tree::drag gives each body the drag of its parts as they stand in horizontal winds, mean over their directions: wood that of its pieces
// and of the twigs
// that are one with it, a clump that of its blades and, at 8 m/s (leaves fold), of its wood.
// What comes out, seeds 1, in leaf: tests/lib/growth/resolve.cpp.
// Reads a tree of segment(). Cost O(bodies), some fifty times.
#pragma once
#include "../model/tree.h"

namespace bough {

// At most `bodies` bodies, and no fewer than the tree has steps for: within a tenth from some 50 on. Throws std::invalid_argument ("is 2, but
// ...") where
// the tree has at least more than that.
Tree resolve(const Tree& whole, std::int64_t bodies);

} // namespace bough
