// resolve.h: a tree on fewer bodies: what is left out stays as mass, inertia, give, drag and damping on what carries it.
//
// The whole tree is that of segment(). A budget takes from it
//   wood     of each branch that is resolved a number of bodies, each for some pieces one after another;
//   leaves   (petals, fruit) that are resolved, as they are, on the wood that carries them;
//   clumps   of what is not resolved and bears leaves or petals: one on each body of wood for all small side branches on it and their leaves, one for
//            each larger side branch. A clump stands for its leaves (Tree::leaf_count) and holds the wood under them.
// Side branches without leaves are one with the wood that carries them, and so is fruit that is not resolved. Nothing is lost: mass, centre of mass
// and inertia of each joint's load are the whole tree's, as drawn.
//
// At what frequency. What the parts of a body do where it is shaken is matched just below the whole tree's own lowest frequency, at omega
// (flexibility.h): there a body answers as its parts together do, in force and in how that changes with the frequency, and its first modes,
// which are near, come out right.
//
// What is resolved. A side branch of mass m, with all that it bears, and give S to a slow push weighs w = m (S / m)^6, and not less than
// what it bears: the heavy and, by far more, the slow, for the lowest modes of a tree are mostly those of its softest branches. One
// threshold t for the whole tree: branches of w >= t are resolved, by (w / t)^0.75 bodies; a clump is a side branch's own where w >= t / 4;
// a leaf is resolved where its own w >= t (alike leaves' are spread by a factor of up to 2 each way,
// alike branches' by 1.035). The sixteen side branches with the most
// S / m at omega weigh at least 1, 0.71, 0.5 ... of the heaviest: the lowest modes may be theirs. t is the least that keeps to the budget. The
// branches to the highest wood are always resolved, by one body each, unless they are more than half of the bodies; and so is fruit, which
// hardly sways but is seen, up to a quarter of the bodies. The numbers are fitted: those at which frequencies and damping of the eight
// species are nearest to the whole tree's.
//
// Joints. From the tips inward each body's joint is made as soft as gives what its parts' joints gave together, in the tree as resolved so
// far, weight and all; that of a single part too, where it carries what stands for several. What it is in proportion to: for wood, the sum of its
// branch's joints to a torque about the first; for a clump, a ball. So all that a joint carries gives at omega what it gave in the whole tree.
// Damping: so that the same is lost, and no more than the parts' largest. A body whose parts, or
// what they carry, do not stand under their weight keeps the stiffness of its parts one after another.
// Clumps. A clump's joint stands toward the base of what bears it, at a lever L from its centre of mass, 2 radii of gyration at most, or
// what keeps it from drooping by more than 0.8 rad held out level. Its thicker wood hardly moves with its leaves: of its mass a share is
// part of the wood that carries it (in the slackest crowns some of the leaves' as well). Share and L are those at which a clump swings with as much
// kinetic energy and brakes as much in the air, at 8 m/s, as its parts (swinging() in resolve.cpp). Its centre of mass is the middle of what the air
// takes hold of in it: where that is further out than that of all its parts, the share is as much further in.
// Air. Tree::drag gives each body the drag of its parts as they stand in horizontal winds, mean over their directions: wood that of its
// pieces and of the twigs that are one with it, a clump that of its blades and, at 8 m/s (leaves fold and turn), of its wood. Tree::leaf_facing is
// that of its leaves, and wood counts as leaves that face all ways across it. Where more edges than faces point
// up, it is 0.
// What comes out, in leaf: README.md beside this; held by tests/lib/growth/resolve.cpp.
// Reads a tree of segment(). Cost O(bodies), some eighty times.
#pragma once
#include "../model/tree.h"

namespace bough {

// At most `bodies` bodies, and no fewer than the tree has steps for: within a tenth from 100 on. Throws std::invalid_argument ("is 2, but ...") where
// the tree has at least more than that.
Tree resolve(const Tree& whole, std::int64_t bodies);

} // namespace bough
