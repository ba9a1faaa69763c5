// bark_twigs.h: the wood of twigs that have no bones of their own, from what of a surface is no bone's bark: pieces that no ring of bark
// is on, and of others what is farther than two radii from the bone that moves it.
//
// A piece is cut into at most 24 slices by the way along its edges from its thicker end, of that which is nearest to the axis of the bone
// that moves it and that which is farthest from there (level sets, as of Verroust and Lazarus 2000). What of a slice hangs together is a node of its
// skeleton: the middle of its corners and their mean distance from the axis through it. Along the longest way the nodes are one twig, what forks off
// others; none is thicker than before.
// It is wood where its longest twig is at least four times as long as thick and the piece holds between a fifth and three times the
// volume of the wood found: cards, leaves and fruit are none.
#pragma once
#include "bark.h"

namespace bough {

struct Twig {
    std::vector<Vec3> point;    // from its base
    std::vector<double> radius; // one a point; corners stand on its circle
};

// O(n log n) of the surface. `tapers`: of these bones in this bark.
std::vector<Twig> twigs_without_bones(const Bark&, const std::vector<speedtree::Bone>&,
                                      const std::vector<BarkTaper>& tapers);

} // namespace bough
