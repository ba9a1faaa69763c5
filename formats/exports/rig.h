// rig.h: a mesh bound to joints, and where these are in a frame: what a writer of skeletons needs, whether a tree's bodies move the mesh or a model's
// own bones.
//
// In frame f a vertex that is bound at p stands at
//     sum_k w_k J_k(f) B_k^-1 p,
// J_k(f) the rigid frame of joint k in the world, B_k what the joint was bound at, which need not be rigid. At rest, J_k is where the joint is drawn.
#pragma once
#include "lib/growth/merge_joints.h"
#include "lib/model/motion.h"
#include "skin_attributes.h"
#include <optional>

namespace bough {

struct RigPose {                // of each joint
    std::vector<Quat> rotation; // world from joint
    std::vector<Vec3> place;    // [m] world
};

struct RigJoints { // each after its parent
    std::vector<std::string> name;
    std::vector<std::int32_t> parent; // -1: none
    RigPose drawn;
    std::vector<Eigen::Affine3d> bind; // B_k: where the joint is drawn, as a rule
    std::vector<char> travels;         // may leave its place in its parent's frame, a root that in the world
    std::size_t size() const { return parent.size(); }
};

struct RigMesh {
    struct Share {
        std::int32_t joint;
        float weight;
    };
    Skin skin; // as it is bound: places, normals, triangles and parts; not what moves it
    SkinAttributes attributes;
    std::vector<std::size_t> first_share = {0}; // of each vertex, and one more
    std::vector<Share> share;                   // of a vertex: sum 1
};

struct Rig {
    RigJoints joints;
    RigMesh mesh;
};

// Joints are the tree's groups, `body_N` after the first body of each; roots travel. own: what the skin was made of; null: none. O(vertices).
Rig rig_of(Skin, const OwnMesh* own, const Tree&, const JointGroups&);
// In a frame of the tree's motion. A group that does not travel may stand elsewhere than its place here says.
RigPose pose_of(const MotionFrame&, const JointGroups&);

// Another mesh and its joints behind these.
void append(Rig& to, Rig&& more);
void append(RigPose& to, const RigPose& more);

// Several roots under one, "root", which is the first joint then and stands still: programs exist that take a skeleton of one root alone. The place
// is where it stands, if it was needed; each pose then has it too.
std::optional<Vec3> join_roots(Rig&);
void join_roots(RigPose&, const Vec3& place);

} // namespace bough
