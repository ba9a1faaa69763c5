// bending_stress.h: how hard the moment at a joint bends the wood there.
//
// A round section of radius r under a bending moment M has this stress at its surface, on the stretched and on the compressed side:
//   sigma = M r / I = M / W,   I = pi r^4 / 4,  W = pi r^3 / 4 its section modulus      (beam theory, small strains, sound wood)
// M [N m] is what the joint's spring and damper pass on about the two axes across the wood: x and y of the torque of plan/spring_torque.h. Since what
// hangs on the joint is in balance, M is the moment about the joint of its weight, of the air on it and of its inertia, whatever the joint's
// stiffness is. r [m] is the radius at the body's foot, where the joint is.
// Strength (Material::strength) is the same quotient for the moment at which a test bar broke: stress over strength is 1 where wood breaks.
// This leaves out the weight along the branch, which adds m g / (pi r^2), below 1 MPa in trees; twist and shear across; stress grown into the wood;
// and hollows.
#pragma once
#include <numbers>

namespace bough {

// [m^3] Returns W of a round section of this radius [m].
inline double section_modulus(double radius) {
    return std::numbers::pi * radius * radius * radius / 4;
}

} // namespace bough
