// driven_model.h: a user's own model moved by the bodies of a tree: its file with one animation more.
//
// At frame f a bone, a node c of the file, stands at G_c(f), as driven_bones.h says. Its own rotation and translation are those of
// G_p(f)^-1 G_c(f), p its parent node, which moves as the bone above does. Scales stay. Rotations are thinned as
// joint_keys.h says; a translation has a key in every frame, and none where it never leaves its place by more than 1e-5
// of the bones' size. Nodes that are no bones of the tree (controls, ends, meshes hung on bones) go with their parents.
//
// Everything else of the file stays as it is, but for: animations that turn one of the bones, which are left out with a
// note; a bone's `matrix`, which an animation may not have, becomes rotation, translation and scale. The new animation
// is the first, "motion". Where a bone's parent is scaled unequally (1e-3), its rotation is only near, and a note says so.
// Cost: O(bones) a frame and 28 bytes a bone.
#pragma once
#include "driven_bones.h"
#include "lib/growth/joint_keys.h"
#include <memory>
#include <nlohmann/json_fwd.hpp>

namespace bough {

struct DrivenOptions {
    double fps = 30;
    double key_tolerance = 0; // [rad] of joint_keys.h
    DrivenPlace place;
    std::string source; // of the animation's extras, left out when empty
};

class DrivenModel {
public:
    // Throws InputError as DrivenBones does, and for a bone below a node scaled to nothing. Notes: theirs, animations left out, bones on nodes scaled
    // unequally.
    DrivenModel(UserModel, const Tree&, const DrivenOptions&, std::vector<std::string>& notes);
    void write(const MotionFrame&);
    // The .glb; once. Throws OutputError beyond 4 GiB.
    std::string finish(const std::string& output_name);
    // In place of finish(): the motion's arrays into the document, its samplers and channels into an animation that may have others. Nodes are
    // numbered from first_node (joined_gltf.h).
    void add_motion(nlohmann::ordered_json& animation, std::size_t first_node);
    const JointKeys& keys() const { return *keys_; } // thinned once it is finished
    std::size_t bones() const { return bone_.size(); }

private:
    struct Driven {              // beside DrivenBone
        std::int32_t above = -1; // driven bone whose motion the parent node has, -1: stands still
        Eigen::Affine3d to_parent = Eigen::Affine3d::Identity(); // G_above^-1 G_p, without one above: G_p
        Quat offset = Quat::Identity();                          // rotation of the parent node from the bone above
        Quat flipped = Quat::Identity();                         // GltfNodes::flipped, which the node's scale keeps
        Vec3 translation = Vec3::Zero();                         // the node's own, drawn
        double off = 0;                                          // [m] by which it leaves it
        std::vector<Eigen::Vector3f> path;
    };
    void find_nodes(std::vector<std::string>& notes);
    void leave_out_animations(std::vector<std::string>& notes);
    void clear_matrix(std::size_t bone);

    UserModel model_;
    DrivenOptions options_;
    DrivenBones bones_;
    std::vector<DrivenBones::Pose> pose_;
    std::vector<Driven> bone_; // of each of them
    std::unique_ptr<JointKeys> keys_;
};

} // namespace bough
