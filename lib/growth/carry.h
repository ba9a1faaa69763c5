// carry.h: radii that carry what grows on them without sagging much: adaptive growth, after the observation that trees
// keep their strains about even by growing thicker where they are loaded (Mattheck's axiom of uniform stress, taken here
// as uniform sag).
//
// With W the weight of all wood, leaves, petals and fruit further out than a point of a branch of length L, d its centre's
// place from the point, t the tangent, M = W d x up its moment (M_b across the tangent, M_t along it), a radius r
// (I = pi r^4 / 4, J = 2 I) is raised until
//   sag      sqrt((M_b / E I)^2 + (M_t / G J)^2) <= most_sag / L: no branch is turned more than most_sag by its load
//            between its base and its tip;
//   topple   E I / L >= 4 W d_up, and G J / L >= 4 W (d - t (t.d))_up: what stands above a branch does not bend or roll it
//            over, four times as stiff as it must be, since all branches below give way too;
// at every point; between points radii are linear, so that few points leave up to a fifth more sag under a load at the tip.
// A radius is also at least the next one out, where that was raised, and those of the branches that begin there.
// Wood that has been raised is weighed as such: one sweep from the tips to the ground. Radii only grow.
// A radius of 0 before a branch's last point is first made the least that segmentation would give it (curves.h).
// Reads Splines whose branches stand parents before children; writes its radius; leaves and fruit stay on the bark (bark.h). most_sag [rad]
// > 0. Cost O(points + items log items) a tree. Errors none.
#pragma once
#include "../model/splines.h"
#include "../model/wood.h"

namespace bough {

// [m/s^2] Under which a tree stands as it is drawn, whatever a scene's is.
constexpr double growing_gravity = 9.81;

// most_sag [rad] for trees of other programs, which drew them for pictures.
constexpr double foreign_sag = 0.5;

// A leaf, petal or fruit as what it weighs on the wood.
struct HungItem {
    std::int32_t branch;
    double at;   // fraction of the branch's arc length
    double mass; // [kg]
    Vec3 center; // [m] world
};
std::vector<HungItem> hung_items(const Splines&, const Material&);

// Returns how many branches were made thicker.
std::size_t thicken_to_carry(Splines&, const Material&, double most_sag);

} // namespace bough
