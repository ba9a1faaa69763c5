// placed_import.h: an imported tree put where a simulation expects it, and its size looked at.
#pragma once
#include "import_notes.h"
#include "lib/model/splines.h"
#include <optional>
#include <span>

namespace bough {

constexpr double noted_height = 1e-3; // [m] that a foot may be off the ground: below it the wind is zero
constexpr double aloof = 1e4;         // times a tree's size: what is farther from it is none of it

struct Box {
    Vec3 low, high;
};
Box box_of(std::span<const Vec3> points); // of one at least

// Moves the tree so that its foot, the middle of its bases at the height of the lowest of them, stands at the origin: wind blows over the
// ground at y = 0, and a scene's position says where the foot is. A foot stays that is within 1 mm of the
// ground and 1 % of the tree's extent of the origin, and so does every one where `keep`. One note with the way, one where another base is higher than
// the lowest by 0.5 m or a twentieth of the extent, one where `keep` leaves the foot below the ground. O(points).
void set_on_ground(Splines&, bool keep, ImportNotes&);

// A note where the tree is higher than any (120 m) or lower than 0.1 m: the unit is then the likely mistake. Where the
// user gave the unit, only above 1200 m: what is small may be meant (a neuron).
void name_absurd_scale(const Splines&, bool unit_given, ImportNotes&);

// Throw InputError (place `name`) where a coordinate or radius of the branches, or `reach` [m] (of others) is beyond
// 1e15 m, and where the whole tree is smaller than 1e-30 m: an inertia goes with the fifth power of lengths, products of
// two of them with the tenth, and doubles end at 1e308.
void refuse_too_far(const Splines&, double reach, const std::string& name);
void refuse_too_small(const Splines&, const std::string& name);

// Looks for a point of a branch, a leaf or a fruit that is far from the middle of the branches' points (their medians along x, y, z). Beyond 10 000
// times the distance within which half of those are, it throws InputError: beside such a branch all others are without length, and what is left of
// the tree is a slip in one number. Beyond 100 times, it adds a note. A radius that is odd (below) is refused or noted too, and a leaf or fruit
// refused that is larger than the tree and 100 times as large as others. O(points).
void find_outlier(const Splines&, const std::string& name, ImportNotes&);

// A radius as no tree has it, the greatest of all. Refused: the wood is twice as thick as the whole tree is large, and more than 100 times
// as thick as the median. Odd: half as thick, and more than 20 times. Of trees in files, the thickest wood is a twentieth of the extent;
// a thick stump, or a cell's body, is near the median. O(points).
struct OddRadius {
    std::size_t at; // in the list
    bool is_refused;
    std::string text; // "50 m in a tree that is 17 large, with a median radius of 0.02"
};
std::optional<OddRadius> odd_radius(std::span<const double> radius, double extent, const std::string& unit);

} // namespace bough
