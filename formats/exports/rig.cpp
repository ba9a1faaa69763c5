#include "rig.h"
#include "influence.h"
#include <algorithm>
#include <limits>
#include <stdexcept>

namespace bough {
namespace {

template <class Item> void add(std::vector<Item>& to, std::vector<Item>&& more) {
    if (to.empty())
        to = std::move(more);
    else
        to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

void append(RigJoints& to, RigJoints&& more) {
    const auto before = std::int32_t(to.size());
    for (std::int32_t& parent : more.parent)
        if (parent >= 0) parent += before;
    add(to.name, std::move(more.name));
    add(to.parent, std::move(more.parent));
    append(to.drawn, more.drawn);
    add(to.bind, std::move(more.bind));
    add(to.travels, std::move(more.travels));
}

// What one of them has and the other has not is filled in: texture coordinates of 0, white.
void append(SkinAttributes& to, std::size_t vertices, SkinAttributes&& more, std::size_t others) {
    const std::size_t sets = std::max(to.uv.size(), more.uv.size());
    const auto fill = [sets](SkinAttributes& of, std::size_t count, bool colored) {
        of.uv.resize(sets);
        for (auto& set : of.uv) set.resize(count, {0, 0});
        if (colored) of.color.resize(count, {1, 1, 1, 1});
    };
    const bool colored = !to.color.empty() || !more.color.empty();
    fill(to, vertices, colored);
    fill(more, others, colored);
    for (std::size_t s = 0; s < sets; ++s) add(to.uv[s], std::move(more.uv[s]));
    add(to.color, std::move(more.color));
}

void append(Skin& to, Skin&& more) {
    const std::size_t base = to.position.size(), triangles = to.triangle.size();
    if (base + more.position.size() > std::size_t(std::numeric_limits<std::int32_t>::max()))
        throw std::length_error("a mesh of more than 2^31 - 1 vertices");
    for (auto& corners : more.triangle)
        for (std::int32_t& corner : corners) corner += std::int32_t(base);
    for (SkinPart& part : more.part) part.first_index += triangles;
    add(to.position, std::move(more.position));
    add(to.normal, std::move(more.normal));
    add(to.texture, std::move(more.texture));
    add(to.triangle, std::move(more.triangle));
    add(to.part, std::move(more.part));
}

void append(RigMesh& to, RigMesh&& more, std::size_t joints) {
    append(to.attributes, to.skin.position.size(), std::move(more.attributes), more.skin.position.size());
    append(to.skin, std::move(more.skin));
    for (RigMesh::Share& share : more.share) share.joint += std::int32_t(joints);
    for (std::size_t v = 1; v < more.first_share.size(); ++v)
        to.first_share.push_back(to.share.size() + more.first_share[v]);
    add(to.share, std::move(more.share));
}

} // namespace

Rig rig_of(Skin skin, const OwnMesh* own, const Tree& tree, const JointGroups& groups) {
    Rig rig;
    const GroupFrames drawn = drawn_frames(tree, groups);
    rig.joints.parent = groups.parent;
    rig.joints.drawn.place = drawn.x_w;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        rig.joints.name.push_back("body_" + std::to_string(groups.first[g]));
        rig.joints.drawn.rotation.emplace_back(drawn.R_wg[g]);
        rig.joints.bind.push_back(Eigen::Translation3d(drawn.x_w[g]) * drawn.R_wg[g]);
        rig.joints.travels.push_back(groups.parent[g] < 0);
    }
    rig.mesh.attributes = attributes_of(skin, own);
    for (std::size_t v = 0; v < skin.position.size(); ++v) {
        const Influence by = influence_of(skin, groups, v);
        for (std::size_t k = 0; k < by.joint.size(); ++k)
            if (by.weight[k] > 0) rig.mesh.share.push_back({by.joint[k], by.weight[k]});
        rig.mesh.first_share.push_back(rig.mesh.share.size());
    }
    rig.mesh.skin = std::move(skin);
    return rig;
}

RigPose pose_of(const MotionFrame& frame, const JointGroups& groups) {
    RigPose pose;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        pose.rotation.push_back(frame.rotation[std::size_t(groups.lead[g])]);
        pose.place.push_back(frame.position[std::size_t(groups.first[g])]);
    }
    return pose;
}

void append(Rig& to, Rig&& more) {
    append(to.mesh, std::move(more.mesh), to.joints.size());
    append(to.joints, std::move(more.joints));
}

void append(RigPose& to, const RigPose& more) {
    to.rotation.insert(to.rotation.end(), more.rotation.begin(), more.rotation.end());
    to.place.insert(to.place.end(), more.place.begin(), more.place.end());
}

std::optional<Vec3> join_roots(Rig& rig) {
    RigJoints& joints = rig.joints;
    if (std::count(joints.parent.begin(), joints.parent.end(), -1) < 2) return std::nullopt;
    const Vec3 place = joints.drawn.place.front();
    for (std::int32_t& parent : joints.parent) ++parent;
    joints.parent.insert(joints.parent.begin(), -1);
    joints.name.insert(joints.name.begin(), "root");
    joints.bind.insert(joints.bind.begin(), Eigen::Affine3d(Eigen::Translation3d(place)));
    joints.travels.insert(joints.travels.begin(), false);
    join_roots(joints.drawn, place);
    for (RigMesh::Share& share : rig.mesh.share) ++share.joint;
    return place;
}

void join_roots(RigPose& pose, const Vec3& place) {
    pose.rotation.insert(pose.rotation.begin(), Quat::Identity());
    pose.place.insert(pose.place.begin(), place);
}

} // namespace bough
