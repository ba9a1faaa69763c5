// flexibility.h: how much a tree gives way, joint by joint, where what bears it is shaken slowly: springs and weight.
//
// Coordinates and gravity's second derivative are those of study/small_motion.h: a_k [rad, world] turns all that joint k carries, phi_p what turns
// its parent, H its load's first moment about it, g gravity. Under an acceleration f of the ground the tree's energy is the sum over its joints of
//   1/2 a^T (K + G) a + a^T B phi_p - a . (H x f),   G = (g.H) 1 - (g H^T + H g^T)/2,   B = (g.H) 1 - g H^T
// and is the least for given phi_p, from the tips inward, with A, b the sums of what the children pass:
//   W = K + G + A,   C = B + A,   T = H* + b (a column for each axis of f),   turn = W^-1 T
//   passed to the parent: A - C^T turn_C, b - C^T turn,   give = tr(T^T W^-1 T)     [kg^2 m^2 rad/(N m)]
// A subtree's sum of give is what it yields to, held at its base: with m its mass, what bears it feels of a slow motion of frequency omega the
// mass m +
// omega^2 give / 3, but for the fourth power of omega over the subtree's own frequency, whose square is about 3 m / give. A joint's loss is
// damping tr(turn^T K turn).
// Reads a checked Tree as drawn. O(bodies). A joint that would topple by itself gives as its spring alone does.
#pragma once
#include "../model/drawn_pose.h"

namespace bough {

// What joints pass to the body that bears them.
struct Borne {
    Mat3 A = Mat3::Zero(), b = Mat3::Zero();
    Borne& operator+=(const Borne& more) {
        A += more.A;
        b += more.b;
        return *this;
    }
};

struct Yielding {
    bool stands = true;
    Mat3 turn = Mat3::Zero(); // [rad s^2/m]
    double give = 0;
    Borne passed;
};

// K: in the world's axes; H: first moment of all that the joint carries; on: the sum of what its body's children pass.
Yielding yielding(const Mat3& K, const Vec3& H, const Borne& on);

// Stiffness in the world's axes.
Mat3 stiffness_w(const Tree&, std::size_t i, const Mat3& R_wb);

struct Flexibility {
    DrawnPose pose;
    std::vector<double> mass; // [kg] of all that a joint carries
    std::vector<Vec3> first;  // [kg m] its first moment about the joint, world
    std::vector<double> give, loss;
    std::vector<double> whole; // give of the joint and all that it carries
};

Flexibility flexibility(const Tree&);

} // namespace bough
