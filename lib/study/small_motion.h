// small_motion.h: a tree's small motion about the pose in which it stands, M a'' + K a = 0, without damping and exact to first order.
//
// Coordinates. a_k [rad, world]: joint k turns all that it carries by exp(a_k), after the joints below it. phi_k = phi_p + a_k, p the parent, is the
// body's rotation to first order.
// K, the energy's second derivative there. Of a spring, with e = R^T a in the joint frame, theta its angle, F = J^-1 the inverse of the left Jacobian
// of SO(3) at theta: theta(e) = log(exp(e) exp(theta)), whose derivatives are F and, of F e_b along e_a, its symmetric part:
//   S_ab = (F^T K F)_ab + 1/2 ((K theta) . (dF/dtheta [F e_b] e_a + dF/dtheta [F e_a] e_b))
// Of gravity g on H, the first moment about joint k of all that it carries (two rotations one after the other, to second order):
//   -g . ((phi_p + a/2) x (a x H)) = 1/2 a^T G a + a^T B phi_p,   G = (g.H) 1 - (g H^T + H g^T)/2,   B = (g.H) 1 - g H^T
// So K couples a body with its parent alone, and is eliminated from the tips inward in 3x3 blocks, with A the sum over the children of what they
// pass:
//   W = S + G + A,   C = B + A,   passed to the parent: A - C^T W^-1 C,   W = L L^T
//   a^T K a = sum |y_k|^2,   y_k = L^T (a_k + W^-1 C phi_p)
// The tree stands where every W is positive definite. Where it does not, a branch buckles (a twig with much weight beside its axis twists over, which
// no check of bending sees): the tree is then followed downhill to where it stands. Newton's steps, blocks that are not positive definite lifted by a
// multiple of 1, halved until the energy falls; at a balance that is none, first 0.05 rad along the softest block's worst direction.
// M is never formed: velocities pass outward, momenta inward. What is solved for is y: the operator R^-T M R^-1, K = R^T R, is symmetric, its
// eigenvalues are 1 / omega^2.
// Cost. O(n) to make, O(n) an operation, 28 doubles a body.
#pragma once
#include "../plan/pose.h"
#include <Eigen/Core>

namespace bough {

// What a message says of a branch that buckles.
constexpr const char* buckling_remedy =
    "thicker wood would carry it: treeconvert --radii carry makes it so, of a scan with --scan-radii";

class SmallMotion {
public:
    // Of a tree without rigid bodies, its wood as scaled by the scene, standing under gravity [m/s^2]: as drawn (Pose::drawn), else where its springs
    // come to rest. Throws std::domain_error, naming body and branch, as start_pose, for a joint without stiffness that something hangs on, and where
    // no pose is found in which it stands.
    SmallMotion(const Tree&, const Vec3& gravity, Pose);

    // Bodies whose joint buckled, one or more a branch; empty where the tree stands as it is drawn or settled.
    const std::vector<std::size_t>& buckled() const { return buckled_; }

    Eigen::Index rows() const { return 3 * Eigen::Index(body_.size()); }
    // What an operation works in, kept from one to the next.
    struct Moving {
        Vec3 turn, shift, linear, angular;
    };
    // out = R^-T M R^-1 y. y, out: rows() numbers.
    void operate(const double* y, double* out, std::vector<Moving>& work) const;
    // a = R^-1 y.
    std::vector<Vec3> turns(const double* y) const;
    // R^-T M times a translation of the ground along a direction: what of y an acceleration of it excites.
    Eigen::VectorXd excited(const Vec3& direction) const;

    // First-order motion of each body of a: rotation [rad], displacements of its joint and centre of mass [m], world.
    struct Motion {
        Vec3 turn, joint, com;
    };
    std::vector<Motion> motion(const std::vector<Vec3>& a) const;

    // Where bodies stand.
    const std::vector<Mat3>& rotations() const { return R_; }        // world from body
    const std::vector<Vec3>& joints() const { return x_; }           // [m]
    const std::vector<Mat3>& spring_rates() const { return rates_; } // d theta / d a

private:
    struct Body {
        std::int32_t parent;
        double mass;
        Vec3 arm;    // [m] joint from the parent's joint
        Vec3 moment; // [kg m] of its own mass about its joint
        double J[6]; // [kg m^2] about its joint: xx xy xz yy yz zz
        double L[6]; // Cholesky factor of W, lower: 11 21 22 31 32 33
        Mat3 W_C;    // W^-1 C
    };
    void stand(const Tree&); // R_, x_, rates_, and all of a body but the factors
    // The factors of K; with `lift`, of blocks made positive definite. Returns the first body whose block is not, or -1.
    std::int64_t factor(const Tree&, bool lift);
    void go_over(const Tree&);
    // 0.05 rad of its joint along soft_axis_, what it carries giving way
    std::vector<Vec3> softest(std::size_t body) const;
    std::vector<Vec3> carried_moments() const;       // H
    std::vector<Vec3> unbalanced(const Tree&) const; // [N m] on each joint, world: what of gravity its spring leaves
    double energy(const Tree&) const;                // [J]
    // Dual of a to that of y: of torques on joints; of momenta of bodies, which it changes.
    void inward(const std::vector<Vec3>& torque, double* out) const;
    void inward(std::vector<Moving>& work, double* out) const;

    Vec3 gravity_;
    StartPose pose_;
    std::vector<std::size_t> buckled_;
    Vec3 soft_axis_ = Vec3::Zero(); // of the body that factor() returned: along which its block is the least
    std::vector<Body> body_;
    std::vector<Mat3> R_, rates_;
    std::vector<Vec3> x_;
};

} // namespace bough
