// assimp_scene.h: a model file as assimp's scene, for the files of this folder that see assimp; called in a child
// process (forked.h) alone, because assimp may crash on a damaged file and recurses by depth.
#pragma once
#include "lib/base/math.h"
#include "model_kind.h"
#include <string>
#include <string_view>

struct aiScene;
namespace Assimp {
class Importer;
}

namespace bough {

// Only the reader of this kind sees the file. Polygons are triangulated, lines stay; no mesh is made up for joints that
// move none; FBX pivots become part of their nodes. assimp applies COLLADA's unit by itself, and its up axis too unless
// `up_given`.
// The scene is the importer's. Throws std::runtime_error with assimp's message.
const aiScene* load_by_assimp(Assimp::Importer&, std::string_view content, AssimpKind, bool up_given);

// What the file says of its coordinates and assimp has not applied.
struct ModelFrame {
    Mat3 axes = Mat3::Identity(); // to x right, y up, z to the viewer, from file coordinates
    double unit = 0;              // [m] 0: the file states none
};
ModelFrame stated_frame(const aiScene&, AssimpKind);

} // namespace bough
