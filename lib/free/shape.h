// shape.h: what a body is to a contact: a segment of its axis with a radius at each end, linear between them.
//
//   branch       its axis from joint to tip, base and tip radius
//   fruit, ball  its centre, its radius
//   leaf, petal  its length, a quarter of its width (half the triangle's mean half width): a leaf is limp, and no contact needs its rim
#pragma once
#include "../base/math.h"
#include "../model/kind.h"

namespace bough {

struct Capsule {
    Vec3 a, b; // [m]
    double radius_a, radius_b;
};

// Returns the capsule in the body's frame. size: as in Tree.
Capsule capsule_of(Kind kind, const Vec3& size);

Capsule placed(const Capsule&, const Quat&, const Vec3&);

// A sphere about a capsule's middle that holds the capsule.
struct Bound {
    Vec3 middle; // [m]
    double radius;
};
Bound bound_of(const Capsule&);

// How near two capsules are, along the line between the nearest points of their axes, with the radii at these points. This is exact for equal radii.
// For a branch's taper of a few per cent it is off by the square of the taper.
struct Nearest {
    double gap;     // [m] between the surfaces, negative where they overlap
    Vec3 normal;    // from the second to the first, unit
    Vec3 on_second; // [m] point on the second's surface
};
Nearest nearest(const Capsule& first, const Capsule& second);

// The part of their ways that two capsules go before they meet, by conservative advancement. Each advance goes as far as a plane between the two
// keeps them apart, or by the gap over the fastest approach of any of their points where that is more. So nothing is passed through, and nothing that
// only grazes counts as met. Ends go straight, from where they are to first_end, second_end. at: the nearest points then.
struct Meeting {
    double way = 1; // 0..1; 1 where they do not meet
    bool meets = false;
    Nearest at;
};
Meeting meet(const Capsule& first, const Capsule& first_end, const Capsule& second, const Capsule& second_end);

} // namespace bough
