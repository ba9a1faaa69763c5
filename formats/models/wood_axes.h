// wood_axes.h: the axes of a tree's wood, branch by branch, as what the vertices of a mesh are bound to.
//
// A vertex moves with the piece of branch that it lies beside. Across a joint its weight goes over from one piece to the next, smoothly
// from the middle of the one to the middle of the other (3 q^2 - 2 q^3), so that the axis of the bark has no kink however the joint
// bends: of all weights of two pieces these turn the least over a given length. At a branch's base they go over from the piece that bears it: that
// one alone at a radius below the joint, the branch's own alone where its first piece has its middle, or three radii out if that is nearer.
// Reads a checked Tree, its drawn pose. O(bodies log bodies), a vertex O(pieces of its branch).
#pragma once
#include "bone_bodies.h"
#include "lib/model/drawn_pose.h"
#include <memory>

namespace bough {

class WoodAxes {
public:
    WoodAxes(const Tree&, const DrawnPose&);
    bool empty() const { return body_.empty(); }

    struct Bound {
        std::int32_t first, second; // bodies
        float weight;               // of the second
        std::int32_t stronger() const { return weight > 0.5f ? second : first; }
    };
    // p [m], world. chain: the branch it belongs to (chain_of), -1: the nearest.
    Bound bind(std::int32_t chain, const Vec3& p) const;
    // The chain of pieces that a body of wood is in; -1: it is none.
    std::int32_t chain_of(std::int32_t body) const { return body < 0 ? -1 : chain_of_[std::size_t(body)]; }

private:
    Bound within(std::size_t first, std::size_t end, std::size_t nearest, const Vec3& p) const;

    const Tree& tree_;
    const DrawnPose& pose_;
    std::vector<std::int32_t> body_, chain_of_,
        place_of_;                   // bodies chain by chain; of each body its chain, its place in body_
    std::vector<std::size_t> first_; // of each chain, and one more
    std::vector<Vec3> start_, end_;  // [m] of body_
    std::unique_ptr<SegmentBoxes> boxes_;
};

} // namespace bough
