// contact.h: what free bodies meet in a step, and the impulses that follow (§6).
//
// Found      A free body that would go d in the step meets a tree's body where their capsules (shape.h) meet on their ways. The tree's way goes from
//            where it was before the step to where it is after it. Subtrees whose reach (subtree.h) stays away from the free body's own bound on the
//            way are pruned; the result is that of looking at every body. The ground is a plane, which a branch meets with the rims of its flat ends.
//            A meeting is at a part `way` of the step, 0 for what touches already.
// Solved     Sequential impulses with accumulated bounds (Catto 2005), contact by contact, until in a round over all nothing changes by more than
//            1e-6 of the fastest approach, or for 100 rounds. Along the normal the velocity after is at least
//              restitution x (effective mass without springs / with them) times the approach  (0 for what comes slower than gravity makes
//              it in two steps): springs give back by themselves what they take. A body that meets several things one after another may
//              go on up to the later ones, at gap / time left.
//            Across the normal, friction takes up to `friction` times the normal impulse. Trees answer as path_response.h says.
// Given      The free bodies get their impulses. The tree gets the same, negative, as forces over the step to come (State::loads).
// A single contact without friction has the impulse (1 + e) v_n / (1/m + r x n . I^-1 r x n + n.W n), with W the tree's mobility there.
// Cost       finding: O(bodies that are not pruned); solving: O(contacts x bodies on their ways to the root) a round.
#pragma once
#include "free_body.h"
#include "near_pairs.h"
#include "response.h"
#include "shape.h"
#include <span>

namespace bough {

struct ContactPoint {
    std::size_t free = 0;        // which free body
    std::int64_t body = -1;      // of the tree; -1: the ground
    Vec3 point_b = Vec3::Zero(); // [m] the same in the body's frame
    Vec3 point = Vec3::Zero();   // [m] world, on the tree's body or the ground
    Vec3 arm = Vec3::Zero();     // [m] from the free body's centre of mass, when they meet
    Vec3 normal = Vec3::Zero();  // to the free body
    double way = 0;              // of the step, when they meet
    double gap = 0;              // [m] at the step's start, where they overlap: negative; else 0
    Vec3 impulse = Vec3::Zero(); // [N s] on the free body
    double approach = 0;         // [m/s] before
    double closing = 0;          // [m] that the two come nearer from the meeting to the step's end, if nothing is done
    double free_speed = 0;       // [m/s] at which they may still come nearer: of what is met after something else
};

// The tests of one kind that a search made, and those that pruning spared it.
struct ContactTests {
    std::uint64_t bodies = 0, reaches = 0, pairs = 0; // pairs: of a body and a part of what is free
};

// A tree's way through a step.
template <class T> struct TreeWay { TreePoses<T>&before, &after; };

// Appends to `found`, in a fixed order, what free body k meets on its way, from its present place and turn to `end`. brute_force: nothing is pruned.
template <class T>
void find_contacts(const Plan<T>&, const Tree&, const Subtrees&, TreeWay<T>, const Contact&, const FreeBody&,
                   std::size_t k, const FreeMotion& end, bool brute_force, std::vector<ContactPoint>& found,
                   ContactTests&);

// The same, where the body's pairs with the trees' bodies are known (near_pairs.h). pairs: its own.
template <class T>
void find_contacts(const Tree&, const NearPairs<T>&, std::span<const NearPair> pairs, TreeWay<T>, const Contact&,
                   const FreeBody&, std::size_t k, const FreeMotion& end, std::vector<ContactPoint>& found,
                   ContactTests&);

// mobility_of() returns the velocity [m/s] of a free body's point by a unit impulse there [1/kg], `arm` [m] from its centre of mass. push() applies
// an impulse [N s] there.
Mat3 mobility_of(const FreeBody&, const Vec3& arm);
void push(FreeBody&, const Vec3& arm, const Vec3& impulse);

// Finds the impulses of all contacts, with the poses after the step, and gives the free bodies theirs. rigid: without springs.
template <class T>
void solve_contacts(const Plan<T>&, TreePoses<T>&, const TreeResponse<T>& sprung, const TreeResponse<T>& rigid,
                    const Contact&, std::vector<FreeBody>&, std::vector<ContactPoint>&);

} // namespace bough
