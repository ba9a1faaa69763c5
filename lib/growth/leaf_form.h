// leaf_form.h: how a species' leaf looks: its outline as a curve, and what is made of it. Nothing of it moves a tree: a leaf's body stays
// the prism of Splines' length and width, and what is drawn has its area.
//
// Outline: half of the blade, from its foot (the first point, which may lie in a notch) to its tip, as pairs (along, across) with the
// blade's length and half its width as units; the other half mirrors it. Across may rise and fall and along may turn back: lobes. A smooth
// curve goes through the points (Catmull and Rom's), sharp where two points are the same.
#pragma once
#include "../base/math.h"
#include <Eigen/Core>
#include <string>
#include <vector>

namespace bough {

using Vec2 = Eigen::Vector2d;

struct LeafForm {
    std::vector<double> outline;   // none: leaves are kites
    std::string veins = "pinnate"; // pinnate, palmate (from the foot into the lobes) or parallel
    double petiole = 0.15;         // [1] of the leaf's length that is stalk
    double fold = 15;              // [deg] each half stands up from the flat leaf
    double curl = 25;              // [deg] the tip points down against the foot
    std::int32_t teeth = 0;        // on each side, 0: none
    double tooth = 0.08;           // [1] of half the width
    std::int32_t needles = 1;      // from 2 on a bundle of so many blades, spread by `spread`
    double spread = 25;            // [deg] over all of them
    bool none() const { return outline.empty(); }
};

// Throws std::invalid_argument for the first value out of its range, named as in the species document ("leaf_outline").
void check_leaf_form(const LeafForm&);

// The half outline of a leaf of length 1, petiole included, and `width` at the blade's widest: x across (0 and more), y along, from (0, 0)
// to (0, 1). `fine` points between two of the outline's, 0: none, as a mesh has it; teeth as corners. The area of both halves is below 1.
std::vector<Vec2> leaf_half(const LeafForm&, double width, int fine);

// Twice the area between a half outline and its midrib.
double leaf_area_of(const std::vector<Vec2>& half);

// Blades of a bundle: by how much each is turned from the middle one [rad]; one of 0 for a plain leaf.
std::vector<double> needle_angles(const LeafForm&);

// A spray: what a card of a clump shows, in a square of side 1 with its foot at (0, 0), x -0.5 to 0.5: leaves on a twig.
struct SprayLeaf {
    Vec2 foot;
    double angle;  // [rad] from the twig's direction, to +x
    double length; // [1] of the square's side
};
// From the back to the front.
const std::vector<SprayLeaf>& spray_leaves();
constexpr double spray_twig = 0.56; // [1] its length

} // namespace bough
