#include "driven_bones.h"
#include "bone_bodies.h"
#include "formats/plain_text.h"
#include "gltf_document.h"
#include "lib/base/counted.h"
#include "lib/model/drawn_pose.h"

namespace bough {

DrivenBones::DrivenBones(const UserModel& model, const Tree& tree, const DrivenPlace& place,
                         std::vector<std::string>& notes)
    : world_from_file_(Eigen::Translation3d(place.position) * Eigen::AngleAxisd(place.yaw, Vec3::UnitY()) *
                       Eigen::Translation3d(model.moved)),
      file_from_world_(world_from_file_.inverse()) {
    const DrawnPose pose = drawn_pose(tree);
    drawn_R_wb_ = pose.R_wb;
    drawn_x_w_ = pose.x_w;
    std::vector<speedtree::Bone> bones = model.armature.bones;
    for (speedtree::Bone& bone : bones) {
        bone.start = world_from_file_ * bone.start;
        bone.end = world_from_file_ * bone.end;
    }
    const BoneBodies bodies = bodies_of_bones(bones, tree, drawn_R_wb_, drawn_x_w_);
    constexpr const char* expected = "; expected the model that the tree was made from, in its own units and up axis";
    const double ratio = bodies.tree_size / bodies.bones_size;
    if (!(ratio > 0.5 && ratio < 2))
        throw OtherTree(model.name, "its bones are " + shown(bodies.bones_size) + " m large, the tree is " +
                                        shown(bodies.tree_size) + " m" + expected);
    if (2 * bodies.missed > bones.size())
        throw OtherTree(model.name, std::to_string(bodies.missed) + " of its " + std::to_string(bones.size()) +
                                        " bones lie beside the tree, up to " + shown(bodies.worst) + " m" + expected);
    if (bodies.missed > 0)
        notes.push_back(model.name + ": " + std::to_string(bodies.missed) + " of " + std::to_string(bones.size()) +
                        " bones lie beside the tree, up to " + shown(bodies.worst) + " m: they go with the bone above");
    size_ = bodies.bones_size;
    nodes_ = nodes_of(model.document->json, model.name);
    bone_of_.assign(nodes_.parent.size(), -1);
    for (std::size_t b = 0; b < bones.size(); ++b) {
        if (bodies.turn[b] < 0) continue;
        DrivenBone driven;
        driven.node = model.joint[b];
        driven.name = valid_utf8(
            model.document->json["nodes"][std::size_t(driven.node)].value("name", "bone_" + std::to_string(b)));
        driven.turn = bodies.turn[b];
        driven.place = bodies.place[b];
        const auto node = std::size_t(driven.node);
        driven.turned = nodes_.turned[node];
        driven.linear = nodes_.world[node].linear();
        driven.start = nodes_.world[node].translation();
        bone_of_[node] = std::int32_t(bone_.size());
        bone_.push_back(std::move(driven));
    }
    std::size_t still = 0;
    for (std::size_t i = 0; i < nodes_.parent.size(); ++i) {
        const auto& node = model.document->json["nodes"][i];
        still += node.contains("mesh") && !node.contains("skin") && bone_over(std::int32_t(i)) < 0;
    }
    if (still > 0)
        notes.push_back(
            model.name + ": " +
            counted(still, "mesh stays still: no bone carries it", "meshes stay still: no bone carries them"));
}

std::int32_t DrivenBones::bone_over(std::int32_t node) const {
    while (node >= 0 && bone_of_[std::size_t(node)] < 0) node = nodes_.parent[std::size_t(node)];
    return node < 0 ? -1 : bone_of_[std::size_t(node)];
}

void DrivenBones::poses(const MotionFrame& frame, std::vector<Pose>& pose) const {
    pose.resize(bone_.size());
    const Mat3 file_R = file_from_world_.linear();
    for (std::size_t b = 0; b < bone_.size(); ++b) {
        const DrivenBone& d = bone_[b];
        const auto t = std::size_t(d.turn), p = std::size_t(d.place);
        const Mat3 turn =
            file_R * frame.rotation[t].toRotationMatrix() * drawn_R_wb_[t].transpose() * file_R.transpose();
        const Vec3 start_w = world_from_file_ * d.start;
        pose[b].world.linear() = turn * d.linear;
        pose[b].world.translation() =
            file_from_world_ * Vec3(frame.position[p] + frame.rotation[p].toRotationMatrix() *
                                                            (drawn_R_wb_[p].transpose() * (start_w - drawn_x_w_[p])));
        pose[b].world.makeAffine();
        pose[b].turned = Quat(turn) * d.turned;
    }
}

} // namespace bough
