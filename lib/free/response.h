// response.h: how the velocity of a tree's bodies answers impulses on them, with all contacts seeing each other's.
//
// A contact's impulse acts on the tree as a force that holds for one step h, so that the springs answer within it. With the joint's own
// stiffness Z = h beta K + h^2 K beside the inertia (an implicit Euler step) the change of the rates is
//   (M + h beta K + h^2 K) d_eta = J^T impulse
// solved body by body. Coupled step: M the tree's inertia, A, B, M of a body the articulated ones about its joint, E = (A + Z)^-1:
//   inward   a moment t and a force f on the body about its joint: u += t; handed on: the moment Z E t, the force f - B^T E t
//   outward  gamma = E (u - A omega_p - B v), v = v_p + omega_p x r, omega = omega_p + gamma
// Analytic step: every joint answers by itself, with its composite's inertia J: E = (J + Z)^-1, t and f are handed on whole, gamma = E u.
// A sum of P^T E P over the path either way: symmetric, positive, so that contacts solved in turn never gain energy by each other. As
// h -> 0 the instantaneous response; at 1/30 s a stiff bough meets a ball as a wall does, and not as the few grams that its last
// piece weighs. E, A, B are those of the rest pose, in the body's axes: joints turn little.
// Cost     288 bytes a body where free bodies may push trees; making them O(n); an impulse or a velocity O(bodies on the way to the root).
#pragma once
#include "subtree.h"
#include "tree_poses.h"

namespace bough {

template <class T> class TreeResponse {
public:
    // sprung: with Z; without it the instantaneous response, of a step of no length.
    void make(const Plan<T>&, const Tree&, const Subtrees&, bool sprung = true);
    // After what some bodies carried is gone (Plan's constants say so): those and all on their ways to the root, falling.
    void remake(const Plan<T>&, const Subtrees&, const std::vector<std::size_t>& bodies);
    // Forgets all impulses.
    void begin();
    // An impulse [N s] on a point [m], world.
    void add(const Plan<T>&, TreePoses<T>&, std::size_t body, const Vec3& point, const Vec3& impulse);
    // What the joint's own spring and damper do in the step: -h K (theta + (h + beta) theta_dot) on the body, the opposite on its parent.
    void add_spring(const Plan<T>&, TreePoses<T>&, std::size_t joint);
    // What the impulses so far change of the point's velocity [m/s].
    Vec3 velocity(const Plan<T>&, TreePoses<T>&, std::size_t body, const Vec3& point);
    // Velocity of the point by a unit impulse there, impulses so far aside [1/kg].
    Mat3 mobility(const Plan<T>&, TreePoses<T>&, std::size_t body, const Vec3& point);

    std::size_t bytes() const { return joint_.capacity() * sizeof(Joint); }

private:
    struct Joint { // body axes, about the joint
        Mat3 E, A, B, M;
    };
    struct Wrench {
        Vec3 moment, force;
    };
    Joint own(const Plan<T>&, std::size_t i) const;
    void add_child(const Plan<T>&, std::size_t child, Joint& parent) const;
    void close(const Plan<T>&, std::size_t i, Joint&) const;
    Vec3 spring(const Plan<T>&, std::size_t i) const; // Z's diagonal
    void put(std::size_t i, const Vec3& moment);
    void hand_on(const Plan<T>&, TreePoses<T>&, std::size_t from,
                 Wrench); // what the joint `from` passes to its parent, and so on
    std::pair<Vec3, Vec3> motion(const Plan<T>&, TreePoses<T>&, std::size_t body); // omega, v of the joint

    bool coupled_ = true, sprung_ = true;
    std::vector<Joint> joint_;
    std::vector<std::uint32_t> place_; // in u_, 0: nothing
    std::vector<Vec3> u_;              // [N m s] world
    std::vector<std::size_t> touched_, path_;
};

} // namespace bough
