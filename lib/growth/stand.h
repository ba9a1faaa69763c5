// stand.h: branches that stand as they are drawn, and sway faster than what bears them: radii that carry.h leaves too small for that are raised.
//
// What carry.h asks of a branch held at its base does not keep it up on wood that gives way as well: a twig with much weight beside its
// axis twists over, on a branch that twists with it. So the whole tree is looked at, as bodies (segment.h), under twice its weight, leaves
// and fruit being loads on the wood:
//   stands   every joint's block W (flexibility.h, omega = 0) is positive definite;
//   sways    no branch of level n, held at its base, with all that it bears, has more than 0.8 / 2^(n - 1) of the S / m of its whole tree: m its
//            mass, S its give, so that m / S goes with its frequency squared. Trees are elastically similar: the frequency of branches goes with
//            length^-1/2 (McMahon, Kronauer, J. Theor. Biol. 59:443, 1976), which asks for somewhat more, as children have some 0.45 of their
//            parents' length. Without it the lowest modes of a crown are those of a few slack twigs. Trunks are left as they are, and what hangs
//            (its load's centre is lower than its base by 0.3 of the distance or more): a weeping willow's shoots are pendulums.
// All radii of a branch that does not are raised, by a sixth where it does not stand, else by what its own joints' part of S, which goes
// with their fourth power, asks for; then what bears it is made to carry it (carry.h). That is repeated until all do, 40 times at most.
// Reads and writes as thicken_to_carry(). Cost O(points + items) a time, two to ten times.
#pragma once
#include "../model/splines.h"
#include "../model/wood.h"

namespace bough {

// Returns how many branches do not stand, even so: 0 for all but trees that no radius helps.
std::size_t thicken_to_stand(Splines&, const Material&, double most_sag);

} // namespace bough
