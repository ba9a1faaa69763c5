#include "rigged_mesh.h"
#include "formats/exports/gltf_parts.h"
#include "formats/models/driven_rig.h"

namespace bough {
namespace {

// Bodies as joints, and what merging them costs.
class Bodies {
public:
    Bodies(const Tree& tree, const GltfChoice& choice, double height, std::vector<std::string>& notes)
        : tree_(tree), groups_(chosen_joints(tree, choice)), height_(height), notes_(notes) {
        if (groups_.size() < tree.size_bodies()) error_.emplace(tree, groups_);
    }
    const JointGroups& groups() const { return groups_; }
    RigPose pose(const MotionFrame& frame) {
        if (error_) error_->add(frame.rotation, frame.position);
        return pose_of(frame, groups_);
    }
    void note() const {
        if (error_) notes_.push_back(merge_note(tree_, groups_, *error_, height_));
    }

private:
    const Tree& tree_;
    const JointGroups groups_;
    const double height_;
    std::vector<std::string>& notes_;
    std::optional<MergeError> error_;
};

// A part's own material each.
OwnMesh look_of_skin(const Skin& skin) {
    OwnMesh look;
    for (const SkinPart& from : skin.part) {
        OwnPart part;
        part.name = from.name;
        part.color = from.color;
        part.material = std::int32_t(look.material.size());
        look.material.push_back(gltf_material(from.name, from.color));
        look.part.push_back(std::move(part));
    }
    return look;
}

OwnMesh without_surfaces(OwnMesh mesh) {
    for (OwnPart& part : mesh.part) part.standing = {}, part.body = {}, part.second = {}, part.placed = {};
    mesh.shape = {};
    return mesh;
}

} // namespace

RiggedMesh rigged(const Tree& tree, Skin skin, std::optional<OwnMesh> own, const GltfChoice& choice,
                  std::vector<std::string>& notes) {
    const auto bodies = std::make_shared<Bodies>(tree, choice, height_of(skin), notes);
    RiggedMesh made;
    made.rig = rig_of(std::move(skin), own ? &*own : nullptr, tree, bodies->groups());
    made.look = own ? without_surfaces(std::move(*own)) : look_of_skin(made.rig.mesh.skin);
    made.pose = [bodies](const MotionFrame& frame) { return bodies->pose(frame); };
    made.note = [bodies] { bodies->note(); };
    return made;
}

RiggedMesh rigged(const DrivenMesh& mesh) {
    const auto bones = std::make_shared<DrivenRig>(mesh);
    RiggedMesh made;
    made.rig = std::move(bones->rig);
    made.look = mesh.look();
    made.pose = [bones](const MotionFrame& frame) { return bones->pose_of(frame); };
    made.note = [] {};
    return made;
}

} // namespace bough
