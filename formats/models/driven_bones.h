// driven_bones.h: the bones of a user's model that a tree's bodies move, and where the model's nodes stand in a frame.
//
// Bone b, a node c of the file, is drawn at G_c (its matrix in the scene). With D the motion of a body since it was drawn, in the
// file's axes, the node stands at frame f at
//     G_c(f) = [ D_turn R S | D_place start ],   G_c = [ R S | start ].
// bone_bodies.h says which bodies these are. A node n that is no such bone goes with the next bone a above it,
//     G_n(f) = G_a(f) L_1 ... L_n,
// L the matrices of the nodes from a down to n; it stands still where there is none.
// Cost     O((bones + bodies) log bodies) once, O(bones) a frame.
// Errors   OtherTree where most bones lie beside the tree's bodies, or the bones are less than half or more than twice as large as the tree.
#pragma once
#include "gltf_nodes.h"
#include "lib/model/motion.h"
#include "lib/model/tree.h"
#include "user_model.h"

namespace bough {

// Where the scene puts the tree: the file's origin in the world, and how it is turned.
struct DrivenPlace {
    Vec3 position = Vec3::Zero(); // [m]
    double yaw = 0;               // [rad]
};

struct DrivenBone {
    std::string name; // the node's
    std::int32_t node = -1;
    std::int32_t turn = -1, place = -1; // bodies
    Quat turned = Quat::Identity();     // R of G_c
    Vec3 start = Vec3::Zero();          // of G_c
    Mat3 linear = Mat3::Identity();     // R S of G_c
};

// The bones are not those of the tree.
struct OtherTree : InputError {
    using InputError::InputError;
};

class DrivenBones {
public:
    struct Pose {
        Eigen::Affine3d world = Eigen::Affine3d::Identity(); // G_c(f)
        Quat turned = Quat::Identity();                      // D_turn R
    };

    // The tree is drawn where the scene puts it. Notes: bones that lie beside the tree, meshes that no bone moves.
    DrivenBones(const UserModel&, const Tree&, const DrivenPlace&, std::vector<std::string>& notes);

    const std::vector<DrivenBone>& bone() const { return bone_; } // each after those above it
    const GltfNodes& nodes() const { return nodes_; }             // as they are drawn
    double size() const { return size_; }                         // [m] of all bones
    const Eigen::Affine3d& world_from_file() const { return world_from_file_; }
    // The bone at a node or next above it, -1: nothing moves the node.
    std::int32_t bone_over(std::int32_t node) const;

    // In the file's axes, an entry a bone.
    void poses(const MotionFrame&, std::vector<Pose>&) const;

private:
    GltfNodes nodes_;
    Eigen::Affine3d world_from_file_, file_from_world_;
    std::vector<Mat3> drawn_R_wb_;
    std::vector<Vec3> drawn_x_w_;
    double size_ = 0;
    std::vector<DrivenBone> bone_;
    std::vector<std::int32_t> bone_of_; // of each node, -1: none
};

} // namespace bough
