// bone_bodies.h: which bodies of a tree move the bones of a model that stands where the tree is drawn.
//
// A bone turns as the body that it lies along: the least mean distance of its points at 1/4, 1/2 and 3/4 from a body's
// axis, a tenth of its length more for a bone across it. So of several bodies along one bone the middle one leads, and
// several bones along one body move together. Its start goes where the body takes it that is nearest to it of the
// leading one and those before it on the same branch: the joint, where there is one.
// A bone is met where these points are, in the mean, no farther from any body's axis than that body's radius (at most a
// twentieth of the bones' size) and 1 % of that.
// Reads a checked Tree, its drawn pose. O((bones + bodies) log bodies).
#pragma once
#include "formats/imports/speedtree_xml.h"
#include "lib/model/tree.h"

namespace bough {

struct BoneBodies {
    std::vector<std::int32_t> turn, place; // bodies, -1: the bone is not met
    std::size_t missed = 0;
    double worst = 0;                     // [m] largest distance of a bone, met or not
    double bones_size = 0, tree_size = 0; // [m] the largest side of the box of their axes
};

// Bones in the tree's world [m], Y up; R_wb, x_w: the tree's bodies there.
BoneBodies bodies_of_bones(const std::vector<speedtree::Bone>& bones, const Tree&, const std::vector<Mat3>& R_wb,
                           const std::vector<Vec3>& x_w);

// Line segments, and which of them is nearest to a point: a binary tree of boxes. O(n log n), a query mostly O(log n).
class SegmentBoxes {
public:
    SegmentBoxes(std::vector<Vec3> start, std::vector<Vec3> end);
    std::size_t nearest(const Vec3&) const; // needs at least one
    double distance(std::size_t segment, const Vec3&) const;

private:
    struct Box {
        Vec3 low, high;
        std::int32_t first, count; // segments of a leaf; count 0: children first, first + 1
    };
    std::vector<Vec3> start_, end_;
    std::vector<std::int32_t> order_;
    std::vector<Box> boxes_;
};

} // namespace bough
