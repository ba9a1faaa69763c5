#include "driven_rig.h"
#include "formats/plain_text.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

constexpr double apart_most = 1e-6; // of the bones' size: bound alike

Eigen::Affine3d rigid(const Quat& rotation, const Vec3& place) {
    return Eigen::Translation3d(place) * rotation.normalized();
}

} // namespace

// Makes the rig: chooses each set's Q, and the joint of each matrix.
class DrivenRig::Binding {
public:
    Binding(const DrivenMesh& mesh, std::vector<std::int32_t>& bone, Rig& to)
        : mesh_(mesh), from_(mesh.surface()), bone_(bone), to_(to) {}

    void make() {
        add_bones();
        measure();
        joint_.assign(from_.matrix.size(), -1);
        for (std::size_t k = 0; k < joint_.size(); ++k)
            if (weight_[k] > 0) joint_[k] = joint_for(k);
        add_vertices();
    }

private:
    void add_joint(std::string name, std::int32_t bone, std::int32_t parent, const Quat& rotation, const Vec3& place) {
        RigJoints& joints = to_.joints;
        joints.name.push_back(std::move(name));
        joints.parent.push_back(parent);
        joints.drawn.rotation.push_back(rotation);
        joints.drawn.place.push_back(place);
        joints.bind.push_back(rigid(rotation, place));
        joints.travels.push_back(bone >= 0 && parent != bone); // a second joint of a bone stays in the first
        bone_.push_back(bone);
        used_.push_back(false);
    }

    void add_bones() {
        const DrivenBones& bones = mesh_.driven_by();
        const Eigen::Affine3d& W = bones.world_from_file();
        for (std::size_t b = 0; b < bones.bone().size(); ++b) {
            const DrivenBone& bone = bones.bone()[b];
            const std::int32_t above = bones.bone_over(bones.nodes().parent[std::size_t(bone.node)]);
            add_joint(bone.name, std::int32_t(b), above, Quat(W.linear()) * bone.turned, W * bone.start);
        }
    }

    // Each matrix's weight over all vertices, each set's heaviest one, and how far from the origin its vertices lie in the mesh's axes.
    void measure() {
        std::int32_t sets = 0;
        for (const auto& matrix : from_.matrix) sets = std::max(sets, matrix.set + 1);
        weight_.assign(from_.matrix.size(), 0);
        reach_.assign(std::size_t(sets), 0);
        heaviest_.assign(std::size_t(sets), -1);
        for (std::size_t v = 0; v < from_.position.size(); ++v)
            for (std::size_t s = from_.first_share[v]; s < from_.first_share[v + 1]; ++s) {
                const auto k = std::size_t(from_.share[s].matrix);
                weight_[k] += double(from_.share[s].weight);
                double& reach = reach_[std::size_t(from_.matrix[k].set)];
                reach = std::max(reach, double(from_.position[v].norm()));
            }
        for (std::size_t k = 0; k < weight_.size(); ++k) {
            std::int32_t& most = heaviest_[std::size_t(from_.matrix[k].set)];
            if (most < 0 || weight_[k] > weight_[std::size_t(most)]) most = std::int32_t(k);
        }
    }

    // Q of a matrix's set.
    const Eigen::Affine3d& placed(std::size_t k) const {
        return mesh_.moved(std::size_t(heaviest_[std::size_t(from_.matrix[k].set)]));
    }

    // Whether the joint, bound as it is, draws what matrix k moves where that draws it.
    bool fits(std::size_t joint, std::size_t k) const {
        const Eigen::Affine3d& B = to_.joints.bind[joint];
        Eigen::Affine3d now = placed(k);
        const RigPose& drawn = to_.joints.drawn;
        const Eigen::Affine3d J = rigid(drawn.rotation[joint], drawn.place[joint]);
        if (!B.isApprox(J, 0)) now = J * B.inverse() * now;
        const Eigen::Affine3d& wanted = mesh_.moved(k);
        const double off = (now.linear() - wanted.linear()).norm() * reach_[std::size_t(from_.matrix[k].set)] +
                           (now.translation() - wanted.translation()).norm();
        return off <= apart_most * mesh_.driven_by().size();
    }

    std::int32_t joint_for(std::size_t k) {
        const std::int32_t bone = mesh_.bone_of(k);
        if (bone >= 0 && fits(std::size_t(bone), k)) return take(std::size_t(bone));
        for (std::size_t j = mesh_.bones(); j < bone_.size(); ++j) // second ones, and those that stand still
            if (bone_[j] == bone && fits(j, k)) return take(j);
        std::int32_t own = bone;
        if (bone < 0) {
            own = std::int32_t(std::find(bone_.begin(), bone_.end(), -1) - bone_.begin());
            if (std::size_t(own) == bone_.size()) add_joint("still", -1, -1, Quat::Identity(), Vec3::Zero());
            if (fits(std::size_t(own), k)) return take(std::size_t(own));
        }
        if (used_[std::size_t(own)]) {
            const RigPose drawn = to_.joints.drawn;
            add_joint(to_.joints.name[std::size_t(own)] + "_bound", bone, own, drawn.rotation[std::size_t(own)],
                      drawn.place[std::size_t(own)]);
            own = std::int32_t(bone_.size()) - 1;
        }
        to_.joints.bind[std::size_t(own)] = bound_for(std::size_t(own), k);
        return take(std::size_t(own));
    }

    std::int32_t take(std::size_t joint) {
        used_[joint] = true;
        return std::int32_t(joint);
    }

    // B_k.
    Eigen::Affine3d bound_for(std::size_t joint, std::size_t k) const {
        const RigPose& drawn = to_.joints.drawn;
        const Eigen::Affine3d& M = mesh_.moved(k);
        const Eigen::Affine3d B = placed(k) * M.inverse() * rigid(drawn.rotation[joint], drawn.place[joint]);
        const double volume = std::abs(B.linear().determinant());
        if (!B.matrix().allFinite() || !(volume > 1e-9 && volume < 1e9))
            throw InputError(mesh_.name(),
                             "its bone " + in_ascii_quotes(to_.joints.name[joint]) +
                                 " flattens vertices that it moves, or scales them beyond a thousandfold, which "
                                 "a skeleton of USD does not hold; .glb, .obj, .mdd and .pc2 show it, and "
                                 "--mesh made one that is made from the tree");
        return B;
    }

    void add_vertices() {
        RigMesh& mesh = to_.mesh;
        mesh.skin = mesh_.skin(); // as drawn
        mesh.attributes = attributes_of(mesh.skin, nullptr);
        for (std::size_t v = 0; v < from_.position.size(); ++v) {
            const std::size_t first = from_.first_share[v], last = from_.first_share[v + 1];
            double sum = 0;
            for (std::size_t s = first; s < last; ++s) sum += double(from_.share[s].weight);
            for (std::size_t s = first; s < last; ++s)
                mesh.share.push_back(
                    {joint_[std::size_t(from_.share[s].matrix)], float(double(from_.share[s].weight) / sum)});
            mesh.first_share.push_back(mesh.share.size());
            mesh.skin.position[v] = placed(std::size_t(from_.share[first].matrix)) * from_.position[v].cast<double>();
            turn_back(v, mesh.skin.normal[v]);
        }
    }

    // From where it is drawn to where it is bound: by the vertex's joints, as a viewer turns it.
    void turn_back(std::size_t v, Vec3& normal) const {
        Mat3 A = Mat3::Zero();
        for (std::size_t s = to_.mesh.first_share[v]; s < to_.mesh.first_share[v + 1]; ++s) {
            const auto j = std::size_t(to_.mesh.share[s].joint);
            const Mat3 J = to_.joints.drawn.rotation[j].toRotationMatrix();
            A += double(to_.mesh.share[s].weight) * (J * to_.joints.bind[j].linear().inverse());
        }
        const Vec3 turned = A.transpose() * normal; // the inverse of A^-T
        if (const double length = turned.norm(); length > 0 && std::isfinite(length)) normal = turned / length;
    }

    const DrivenMesh& mesh_;
    const DrivenSurface& from_;
    std::vector<std::int32_t>& bone_;
    Rig& to_;
    std::vector<char> used_;             // of each joint: something is bound to it
    std::vector<double> weight_, reach_; // of each matrix; of each set
    std::vector<std::int32_t> heaviest_; // of each set: a matrix
    std::vector<std::int32_t> joint_;    // of each matrix
};

DrivenRig::DrivenRig(const DrivenMesh& mesh) : bones_(mesh.driven_by()) {
    Binding(mesh, bone_, rig).make();
}

RigPose DrivenRig::pose_of(const MotionFrame& frame) {
    bones_.poses(frame, pose_);
    const Eigen::Affine3d& W = bones_.world_from_file();
    const Quat turn(W.linear());
    RigPose pose;
    for (const std::int32_t bone : bone_) {
        if (bone < 0) {
            pose.rotation.push_back(Quat::Identity());
            pose.place.push_back(Vec3::Zero());
            continue;
        }
        const DrivenBones::Pose& now = pose_[std::size_t(bone)];
        pose.rotation.push_back(turn * now.turned);
        pose.place.push_back(W * now.world.translation());
    }
    return pose;
}

} // namespace bough
