// model_scene.h: what an armature reader needs of a model file (FBX, glTF, COLLADA): its nodes, which of them are
// joints, the vertices that they move, and lines; FBX and COLLADA read by assimp in a child process, glTF here.
#pragma once
#include "formats/imports/import.h"
#include "lib/base/math.h"
#include "model_kind.h"
#include "node_role.h"
#include "own_rods.h"

namespace bough {

struct ModelScene {
    bool open_are_joints = false; // nodes that the file says nothing of may be joints

    // Nodes, parents first; a root that assimp made up is not among them.
    std::vector<std::int32_t> parent;
    std::vector<NodeRole> role;
    std::vector<std::string> name;
    std::vector<std::int32_t> index; // of a glTF file's "nodes"; -1: not from one
    std::vector<Vec3> place;         // [file unit] origin, world of the file, in the pose that the nodes stand in
    std::vector<Mat3> axes;          // columns: directions of the node's own axes there, unit length
    std::vector<Vec3> tip; // [file unit] of a bone's end where the file states it (Blender's COLLADA), else NaN

    // Vertices of skinned meshes in that pose, and the node that moves each most; triangles between them.
    std::vector<Vec3> vertex;
    std::vector<std::array<std::int32_t, 3>> face;
    std::vector<std::int32_t> vertex_node;
    std::vector<Vec3> vertex_by_node; // the same as the mesh's own node places them; empty: all there already

    // Line meshes, in that pose.
    std::vector<Vec3> line_point;
    std::vector<double> line_radius; // [file unit] of each point; 0: none stated
    std::vector<std::array<std::int32_t, 2>> line;

    // Of our own files: the wood that the joints hold, in that pose; leaves, petals and fruit beside it. Joints without
    // wood are then holders, and tips those of the wood.
    std::vector<OwnRod> own_rod;
    std::int64_t own_others = 0;

    std::int64_t triangles = 0, skinned_meshes = 0, animations = 0;
    std::int64_t other_scenes = 0; // of a glTF file, not read
    bool mesh_encoded = false;     // glTF with a mesh in a form that is not decoded here: it was left out
    Mat3 to_y_up = Mat3::Identity();
    double unit = 0; // [m] 0: the file states none
};

// O(size of the file). Throws InputError: what assimp says, that it crashed or took too much, what read_gltf and joints_of
// (model_gltf.h) throw, what is read needs more memory than there is.
ModelScene read_model(std::string_view content, AssimpKind, const ImportOptions&);

// ---- gltf_scene.cpp ---- a glTF file, read here from first to last.
// The default scene's nodes, depth first, as its file names them; triangles and lines of any mode. Normalized and integer positions
// (KHR_mesh_quantization) count as what they stand for, and what meshoptimizer compressed is decoded; meshes in Draco's form are left out
// (mesh_encoded). A line's radii are a custom attribute _RADIUS, or _DIAMETER, _WIDTH, _THICKNESS of twice that, in upper or lower case. O(JSON +
// numbers of the arrays that are read). Throws InputError as read_gltf, joints_of (model_gltf.h) and nodes_of do, and for radii that are not one for
// each vertex; memory that runs out is std::bad_alloc.
ModelScene scene_of_gltf(std::string_view content, const ImportOptions&);

// ---- model_scene_bytes.cpp ---- as bytes, and back.
std::string bytes_of(const ModelScene&);
ModelScene model_scene_of(const std::string& bytes);

} // namespace bough
