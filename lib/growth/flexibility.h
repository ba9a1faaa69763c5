// flexibility.h: how much a tree gives way, joint by joint, where what bears it is shaken: springs, weight and inertia.
//
// The shaking is of frequency omega [rad/s], below all that the tree has itself (0: slow). Coordinates and gravity's second derivative are those of
// study/small_motion.h: a_k [rad, world] turns all that joint k carries, phi_p and d are what turns its parent and moves the joint, H its
// load's first moment about it, g gravity. Under an acceleration f of the ground the tree's energy is the sum over its joints of
//   1/2 a^T (K + G) a + a^T B phi_p,   G = (g.H) 1 - (g H^T + H g^T)/2,   B = (g.H) 1 - g H^T
// and over its bodies, u = d + phi x c being the way of the centre of mass, of - omega^2 / 2 (m u^2 + phi^T I phi) - m u.f. It is the least
// for given phi_p, d, from the tips inward. With V(phi, d) = 1/2 (phi, d)^T P (phi, d) - (phi, d)^T p f what a body and its children have
// together,
//   W = K + G + P_aa,   C = B + P_aa,   Y = P_ad,   a = W^-1 (p_a f - C phi_p - Y d)
//   passed: P_aa - C^T W^-1 C, P_ad - C^T W^-1 Y, P_dd - Y^T W^-1 Y, p_a - C^T W^-1 p_a, p_d - Y^T W^-1 p_a, at the parent's joint
//   give = tr(p_a^T W^-1 p_a)     [kg^2 m^2 rad/(N m)]
// A subtree's sum of give, S, is what it yields to, held at its base: m its mass, what bears it feels the mass m + omega^2 S / 3. Its
// lowest frequency squared is below 3 m / S. All W are positive definite where no part of the tree, held at its base, has a frequency of
// omega or less.
// Reads a checked Tree as drawn. O(bodies). A joint that would topple by itself gives as its spring alone does.
#pragma once
#include "../model/drawn_pose.h"
#include <functional>

namespace bough {

// What a body and its children have together, of its turning (a) and its joint's way (d); p's parts are columns for the axes of f.
struct Borne {
    Mat3 aa = Mat3::Zero(), ad = Mat3::Zero(), dd = Mat3::Zero(); // P
    Mat3 a = Mat3::Zero(), d = Mat3::Zero();                      // p
    Borne& operator+=(const Borne& more);
};

// A body's own. omega2: omega squared.
Borne own_part(const Tree&, std::size_t i, const Mat3& R_wb, double omega2);

struct Yielding {
    bool stands = true;
    Mat3 turn = Mat3::Zero();   // W^-1 p_a [rad s^2/m]
    Mat3 follow = Mat3::Zero(); // W^-1 C
    Mat3 slide = Mat3::Zero();  // W^-1 Y [rad/m]
    double give = 0;
    Borne passed; // about the parent's joint
};

// K: in the world's axes; H: first moment of all that the joint carries; on: what its body and its children have; arm: [m] from the parent's joint.
Yielding yielding(const Mat3& K, const Vec3& H, const Borne& on, const Vec3& arm);

// Stiffness in the world's axes.
Mat3 stiffness_w(const Tree&, std::size_t i, const Mat3& R_wb);

struct Flexibility {
    DrawnPose pose;
    double omega2 = 0;                 // [1/s^2]
    bool stands = true;                // every joint
    std::vector<std::uint8_t> upright; // of each joint: it stands, with all that it carries
    std::vector<double> mass;          // [kg] of all that a joint carries
    std::vector<Vec3> first;           // [kg m] its first moment about the joint, world
    std::vector<double> give;
    std::vector<double> whole; // give of the joint and all that it carries
    std::vector<double> slow;  // likewise at omega = 0, of flexibility_at_sway() alone
    std::vector<Mat3> turn, follow, slide;
};

Flexibility flexibility(const Tree&, double omega2);

// How bodies bend where a part of the tree is held: each but the first of its group (of each body: a number) follows its parent in the same group.
// In the world's axes, columns for those of the push: turning of the joint and of the body, ways of the joint and the centre of mass.
struct Bend {
    Mat3 turn, turned, moved, center;
};
// Calls `take` with each body's, parents before children.
void bends(const Tree&, const Flexibility&, const std::vector<std::int32_t>& group,
           const std::function<void(std::size_t, const Bend&)>& take);

// That of a shaking just below the tree's own lowest frequency.
Flexibility flexibility_at_sway(const Tree&);

} // namespace bough
