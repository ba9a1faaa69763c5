// model_collada.h: what a COLLADA file says of joints and assimp does not hand on (private to this folder).
#pragma once
#include "lib/base/math.h"
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace bough {

struct ColladaJoint {
    std::string sid; // by which a skin names it, unique within its armature alone
    // From the joint to the bone's end, in the armature's axes: Blender's extra tip_x, tip_y, tip_z
    std::optional<Vec3> tip;
};

// Nodes of type JOINT, by id (name, where there is no id), which is what assimp names them by. Empty for broken XML.
std::unordered_map<std::string, ColladaJoint> collada_joints(std::string_view content);

} // namespace bough
