// driven_model.h: a user's own model moved by the bodies of a tree: its file with one animation more.
//
// Bone b, a node c of the file, is drawn at G_c (its matrix in the scene). With D the motion of a body since it was
// drawn, in the file's axes, the node stands at frame f at
//     G_c(f) = [ D_turn R | D_place start ],  G_c = [ R S | start ],
// turned as bone_bodies.h says and with its start taken along; its own rotation and translation are those of
// G_p(f)^-1 G_c(f), p its parent node, which moves as the bone above does. Scales stay. Rotations are thinned as
// joint_keys.h says; a translation has a key in every frame, and none where it never leaves its place by more than 1e-5
// of the bones' size. Nodes that are no bones of the tree (controls, ends, meshes hung on bones) go with their parents.
//
// Everything else of the file stays as it is, but for: animations that turn one of the bones, which are left out with a
// note; a bone's `matrix`, which an animation may not have, becomes rotation, translation and scale. The new animation
// is the first, "motion". Where a bone's parent is scaled unequally (1e-3), its rotation is only near, and a note says so.
// Cost: O(bones) a frame and 28 bytes a bone.
#pragma once
#include "bone_bodies.h"
#include "lib/growth/joint_keys.h"
#include "lib/model/motion.h"
#include "user_model.h"
#include <memory>

namespace bough {

struct DrivenOptions {
    double fps = 30;
    double key_tolerance = 0;     // [rad] of joint_keys.h
    Vec3 position = Vec3::Zero(); // [m] where the scene puts the tree: the file's origin in the world
    double yaw = 0;               // [rad] and how it is turned
    std::string source;           // of the animation's extras, left out when empty
};

class DrivenModel {
public:
    // The tree is drawn where the scene puts it. Throws InputError where most bones lie
    // beside the tree's bodies, or are less than half or more than twice as large. Notes: bones that do, animations left out, meshes that nothing moves.
    DrivenModel(UserModel, const Tree&, const DrivenOptions&, std::vector<std::string>& notes);
    void write(const MotionFrame&);
    std::string finish(const std::string& output_name); // the .glb; once. Throws OutputError beyond 4 GiB
    const JointKeys& keys() const { return *keys_; }    // thinned once it is finished
    std::size_t bones() const { return bone_.size(); }

private:
    struct Driven {
        std::int32_t node = -1, above = -1; // above: driven bone whose motion the parent node has, -1: stands still
        std::int32_t turn = -1, place = -1; // bodies
        Quat turned = Quat::Identity();     // R of G_c
        Vec3 start = Vec3::Zero();          // of G_c
        Mat3 linear = Mat3::Identity();     // of G_c
        Eigen::Affine3d to_parent = Eigen::Affine3d::Identity(); // G_above^-1 G_p, without one above: G_p
        Quat offset = Quat::Identity();                          // rotation of the parent node from the bone above
        Vec3 translation = Vec3::Zero();                         // the node's own, drawn
        double off = 0;                                          // [m] by which it leaves it
        std::vector<Eigen::Vector3f> path;
    };
    void find_nodes(std::vector<std::string>& notes);
    void leave_out_animations(std::vector<std::string>& notes);
    void clear_matrix(std::size_t bone);

    UserModel model_;
    DrivenOptions options_;
    Eigen::Affine3d file_from_world_;
    std::vector<Mat3> drawn_R_wb_;
    std::vector<Vec3> drawn_x_w_;
    double size_ = 0; // [m] of the bones
    std::vector<Driven> bone_;
    std::unique_ptr<JointKeys> keys_;
};

} // namespace bough
