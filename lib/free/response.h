// response.h: how the joints of a tree answer impulses, from which path_response.h takes what a step's contacts need.
//
// A contact's impulse acts on the tree as a force that holds for one step h, so that the springs answer within it. The joint's own stiffness Z = h
// beta K + h^2 K stands beside the inertia (an implicit Euler step), and the rates change by
//   (M + h beta K + h^2 K) d_eta = J^T impulse
// This is solved body by body. Coupled step: M is the tree's inertia, and A, B, M of a body are the articulated ones about its joint, E = (A + Z)^-1:
//   inward   a moment t and a force f on the body about its joint: u += t; handed on: the moment Z E t, the force f - B^T E t
//   outward  gamma = E (u - A omega_p - B v), v = v_p + omega_p x r, omega = omega_p + gamma
// Analytic step: every joint answers by itself, with its composite's inertia J: E = (J + Z)^-1, t and f are handed on whole, gamma = E u. Either way
// the answer is a sum of P^T E P over the path, symmetric and positive, so that contacts solved in turn never gain energy from each other. As h -> 0
// it becomes the instantaneous response. At 1/30 s a stiff bough meets a ball as a wall does, not as the few grams that its last piece weighs. E, A,
// B are those of the rest pose, in the body's axes, since joints turn little.
// Cost     288 bytes a body where free bodies may push trees; making them O(n).
#pragma once
#include "subtree.h"
#include "tree_poses.h"

namespace bough {

template <class T> class TreeResponse {
public:
    // sprung: with Z; without, it is the instantaneous response, of a step of no length.
    void make(const Plan<T>&, const Tree&, const Subtrees&, bool sprung = true);
    // Called after what some bodies carried is gone (Plan's constants say so). Brings `bodies` up to date: those and all on their ways to the root,
    // falling.
    void remake(const Plan<T>&, const Subtrees&, const std::vector<std::size_t>& bodies);
    struct Joint { // body axes, about the joint
        Mat3 E, A, B, M;
    };
    const Joint& joint(std::size_t body) const { return joint_[body]; }
    bool coupled() const { return coupled_; } // or each joint answers by itself
    std::size_t bytes() const { return joint_.capacity() * sizeof(Joint); }

private:
    Joint own(const Plan<T>&, std::size_t i) const;
    void add_child(const Plan<T>&, std::size_t child, Joint& parent) const;
    void close(const Plan<T>&, std::size_t i, Joint&) const;
    Vec3 spring(const Plan<T>&, std::size_t i) const; // Z's diagonal

    bool coupled_ = true, sprung_ = true;
    std::vector<Joint> joint_;
};

} // namespace bough
