// merge_joints.h: fewer joints than bodies, for programs that cannot move as many as a tree has.
//
// Each body begins a group of its own or joins its parent's, so a group is connected and the groups form a tree. A group
// moves rigidly: about its first body's own joint, turned as its leading body turns. The joints that fit go to the levels
// from the trunk up, so that the deepest are merged first:
//   - each trunk gets one, then up to four; each branch of the next level one, and so on down; then, again from the trunk
//     up, branches get as many as they have pieces; then leaves, petals and fruit, which until then join the piece that
//     bears them, get their own;
//   - where a level's branches do not all get one, those do that reach farthest (the longest way from their joint to a
//     tip), of equals the heavier with all they bear; the others join the piece that bears them;
//   - pieces of a branch are joined evenly, as few to a group as fit; joints left over by that go to those that reach
//     farthest.
// Every root keeps a joint. The leading body is the piece at half the length of what the group holds of its first body's
// branch: of a bend spread evenly over the group, its direction is that of the whole (the first piece's is behind, the
// last's ahead).
// Reads a checked Tree. O(bodies log bodies).
#pragma once
#include "../model/tree.h"
#include <vector>

namespace bough {

struct JointGroups {
    std::vector<std::int32_t> group;  // of each body; rising with the group's first body
    std::vector<std::int32_t> parent; // of each group: group < own, -1: the ground
    std::vector<std::int32_t> first;  // the body whose joint the group turns about
    std::vector<std::int32_t> lead;   // the body as which it turns
    std::size_t size() const { return parent.size(); }
};

// At most `most` groups; a body each where all fit. leaves false: leaves and petals always join the piece that bears them,
// but for those that are roots. Throws std::invalid_argument where there are more roots than that.
JointGroups merge_joints(const Tree&, std::size_t most, bool leaves = true);

// Where the groups' frames stand when drawn: origin at the first body's joint, axes those of the leading body.
struct GroupFrames {
    std::vector<Mat3> R_wg;
    std::vector<Vec3> x_w;
    std::vector<Quat> rotation; // parent group's frame (roots: world) from own
    std::vector<Vec3> position; // [m] in the parent group's frame (roots: world)
};
GroupFrames drawn_frames(const Tree&, const JointGroups&);

// How far merging moves the tree from where its bodies are: distances between the far end of a body (at its length along
// z) as it is and as its group takes it, over the frames that are added. Of more than 10 000 bodies 10 000 are measured,
// evenly picked from the document's order, so that a frame costs O(groups + 10 000).
class MergeError {
public:
    MergeError(const Tree&, const JointGroups&);
    // World from body and own joint in world [m], arrays over bodies.
    void add(const std::vector<Quat>& R_wb, const std::vector<Vec3>& x_w);
    double rms() const;                         // [m]
    double largest() const { return largest_; } // [m]

private:
    JointGroups groups_;
    GroupFrames drawn_;
    struct End {
        std::int32_t body;
        double length;
        Vec3 in_group; // drawn, in its group's frame
    };
    std::vector<End> ends_;
    std::vector<Mat3> R_wg_; // of the frame being added
    std::vector<Vec3> x_w_;
    double squares_ = 0, largest_ = 0;
    std::int64_t count_ = 0;
};

} // namespace bough
