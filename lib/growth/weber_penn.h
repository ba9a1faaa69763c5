// weber_penn.h: the closed formulas of Weber and Penn's paper that the growth is made of; private to growth and its tests.
//
// All O(1), no errors: grow() has checked the parameters.
#pragma once
#include "growth_parameters.h"
#include <cstdint>
#include <vector>

namespace bough {

constexpr double kLeastTaper = 0.05; // least radius of a stem over its radius at the base

// ShapeRatio(shape, ratio): the paper's table, shapes 0..7, ratio 0 (top) .. 1 (base of the crown).
double shape_ratio(int shape, double ratio);

// ShapeRatio of shape 8, the pruning envelope: 0 at the crown's top and bottom, 1 at its peak.
double envelope_ratio(const GrowthParameters&, double ratio);

// Either of them as the program of p.rules has it: Arbaro's cone comes to a point, Sapling's nearly, it has shapes of its
// own (8 custom, 9 the envelope, 10 inverse tapered); Arbaro's and tree-gen's envelope is the paper's, which jumps at its
// peak unless that is half way up.
double shape_ratio(const GrowthParameters& p, int shape, double ratio);

// Length over `length_max` times the trunk's, of a child at `offset` on a trunk of length `trunk`, bare up to `base`. With crown_top it is
// stretched linearly: 1 stays 1, and the shape's own ratio at the top becomes crown_top.
double crown_ratio(const GrowthParameters&, double trunk, double base, double offset);

// Radius at z (0 base .. 1 tip) of a stem of base radius `radius`, length `length`: section "Stem radius", without flare,
// at least kLeastTaper * radius.
// The exact one may be 0 at the tip.
double exact_taper_radius(double taper, double radius, double length, double z);
double taper_radius(double taper, double radius, double length, double z);

// Factor on the trunk's radius at z: flare (100^y - 1) / 100 + 1 with y = 1 - 8 z, not below 1.
double flare_factor(double flare, double z);

// Rising z in 0..1 (without both) where the radius bends between segments' ends: points are needed there.
// Throws std::invalid_argument for taper > 2 of a stem longer than 1e5 radii, which would need too many.
std::vector<double> taper_marks(double taper, double flare, double radius, double length);

// Number of whole things for a number `count` >= 0: its floor, plus one as often as the fraction says (unit in 0..1).
std::int64_t whole_number(double count, double unit);

// Throws std::invalid_argument for the first parameter out of its range (growth_parameters.h).
void check_growth(const GrowthParameters&);

} // namespace bough
