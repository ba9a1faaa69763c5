// grow.h: procedural trees by Weber and Penn's recursion ("Creation and Rendering of Realistic Trees", SIGGRAPH 1995).
//
// Parameters carry the paper's names. A stem of level n is a curve of nCurveRes segments. It is turned by nCurve, nCurveBack and nCurveV, split by
// nSegSplits, and tapered by nTaper. It bears nBranches children by Shape, BaseSize, nDownAngle and nRotate. Angles are in degrees, lengths in metres
// or (nLength) a fraction of the parent's length. Every random draw comes from a counter-based generator keyed by seed and stem path (random.h). So
// the same seed gives the same bytes, and one parameter changed leaves the other draws alone. "x with x_v" below is x + x_v u with u uniform
// in -1..1.
//
// Readings taken where the paper is open (weber_penn.h has the formulas):
//   Curve. Segments turn where they meet: nCurveRes - 1 turns of curve / nCurveRes about the stem's x, and of up to
//     curve_v / nCurveRes about a random axis across it, so that stems leave the plane. A negative curve_v makes a helix
//     of one turn whose direction stands |curve_v| off its axis.
//   Attraction. Each level has its own (the paper: one, from level 2 on). What hangs (-3 and less) and would leave on the upper side of what bears
//     it leaves on the lower: as far to the side, as far down as it was up. The paper's pull is nothing upright, and a strand that began so would
//     stay a rod. A bearer within 15 degrees of plumb has no lower side.
//   Numbers. A number of children, leaves, fruit or splits that is not whole is rounded up as often as its fraction says
//     (the part of the paper's error diffusion, but one stem's number does not depend on another's).
//   Places. Child i of n sits at (i + 1/2) / n of the stem's length above its base_size. The part of a stem that is split
//     off is a branch of the same level whose parent is the stem it leaves, as thick as that
//     stem unless split_exponent says otherwise, and bears the children of its own part.
//   Rotation. Negative rotate: children at 180 + rotate on alternating sides.
//   Base splits. They replace the seg_splits of the first segment and spread evenly about the vertical.
//   Leaves. Their angles are leaf_angles or, where that is empty, those of level `levels` (of level 3 where levels is 4).
//     How many a stem bears follows leaf_distrib, the shape of ShapeRatio by its place on its parent (the paper: 4). A
//     normal that would face down faces up. leaf_bend turns the normal toward the outside of the tree and up. With
//     negative `leaves` all stand at the tip, in a fan of `rotate` degrees. Fruit hangs straight down from the stem's
//     surface by a stalk.
//   Blossoms. They stand at random places of stems of the last level. Petals stand evenly round a flower that faces away
//     from its stem and half up, each leaning 35 degrees off its plane.
//   Pruning. A stem of level 1 or more that leaves the envelope is drawn again, each time a tenth shorter, until it does
//     not, at most 24 times (to 8 % of its length), then at prune_ratio of the way there; its radius is that of its new
//     length. Parts that are split off are each pruned alone, their start kept.
//   Ground. A stem of level 1 or more that comes nearer to it than 0.02 of the trunk's length, and lower than it begins, is drawn shorter
//     likewise: a weeping willow's shoots end above it.
//   Radii. A radius is at least 0.05 of the stem's radius at its base, so that no tip is zero; nothing is thicker where
//     it starts than the stem it starts from. Flare acts on the lowest eighth of the trunk. Where flare, a rounded or
//     periodic taper need them, points are added between the segments' ends.
// Lobes are left out, for bodies are round.
#pragma once
#include "../model/splines.h"
#include "growth_parameters.h"
#include <cstdint>

namespace bough {

// The tree that treegen makes without --species: a broad-leaved tree of 8 m.
GrowthParameters default_growth();

// Grows a tree. Arrays of leaves (petals among them) and fruit are empty where they are not wanted. `source` is left to the caller. Throws
// std::invalid_argument that names the parameter, its value and what was expected. It throws also where splits would make more than 1e6 of one stem,
// and where the tree comes to more than 5e7 branches, leaves and fruit. O(points).
Splines grow(const GrowthParameters&, std::uint64_t seed, const Items&);

// Grows the same tree, whatever the number, which it carries along (Splines::bodies). segment() makes so many bodies of it, within a tenth from 100
// on: it resolves the tree by fewer (resolve.h) or cuts it more finely. Throws std::invalid_argument beyond 1 to 2e7 too, and where the tree is not
// to be had on so few.
Splines grow_bodies(const GrowthParameters&, std::uint64_t seed, const Items&, std::int64_t bodies);

} // namespace bough
