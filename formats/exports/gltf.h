// gltf.h: a tree as glTF 2.0 binary (.glb): a skinned mesh, its joints, and a motion as an animation of them.
//
// The scene holds two nodes: the mesh (skinned, at the root as the validator wants it) and an armature under which the
// joints stand as the tree's groups do (merge_joints.h), `body_N` after the group's first body. The joints' own
// transforms are the drawn pose, which is also the bind pose. A joint turns about a fixed place in its parent, so the
// animation `motion` holds rotations; keys as joint_keys.h chooses them, linear (slerp) between, the first frame at time 0. They are normalized
// shorts where the tolerance allows (glTF 2.0, 3.11), which are half as large as floats.
// Only a root leaves its place (root motion): its translation then has a key in every frame. Without frames there is no animation. A material a part
// of the skin: metallic 0, colours linear from sRGB, leaves and petals double-sided. Where the tree lies so far from the origin that a float is
// coarser than 1e-6 of its size the armature stands at the tree's first joint and the mesh is relative to it.
//
// JSON is appended as text and numbers go out as they are made. (assimp's exporter was no choice: it wants the whole scene
// as its own objects, one node, one channel with double keys for each joint, and puts the skinned mesh below a node.)
// Leaves as instances (EXT_mesh_gpu_instancing, required: a program without it would show one leaf of a metre a joint):
// a mesh for leaves, one for petals, each 1 m long and wide, and under each joint that bears some a node that draws them at
// their places, turned and scaled, still relative to the joint. The skin is then one without leaves, the groups are those
// of merge_joints without leaves.
// Leaves of clumps that rustle (rustle.h, all together) are a second skinned mesh at the root, with four morph targets whose weights are
// animated: joints of their own would be some thousands, of which programs bear about one. Size: 96 bytes a vertex of the leaves, whatever the
// length of the animation, and 16 bytes a frame.
// Each joint's extras say which bodies of wood it holds (own_rods.h), so that the tree can be read again from the file.
// A vertex moved by two bodies of one group is moved by the group alone. Weights are normalized u16, joints u8 or u16, indices u16
// where they fit; every array starts at a multiple of 4 bytes.
// Cost: O(joints) and 16 bytes a joint for each frame; all else when it is finished.
// Errors  std::length_error for more than 65 536 joints; OutputError for more than 4 GiB, both limits of the format.
#pragma once
#include "formats/open.h"
#include "lib/growth/joint_keys.h"
#include "lib/growth/merge_joints.h"
#include "lib/growth/rustle.h"
#include "lib/growth/skin.h"
#include "lib/model/motion.h"
#include "own_mesh.h"

namespace bough {

struct GltfOptions {
    double fps = 30;
    double key_tolerance = 0; // [rad] of joint_keys.h; 0 keeps every frame
    std::string generator;    // of asset.generator
    std::string source;       // of asset.extras.source, left out when empty
    bool leaf_instances = false;
    bool x_along = false;               // a joint's x axis lies along the branch, as Unreal wants it; else z
    std::vector<std::int32_t> tilted{}; // with x_along: joints whose x axis is turned from it by 1e-3 [rad]
};

class GltfFile;

// Where a root's joint is, frame after frame.
struct RootPath {
    std::size_t joint;
    std::vector<Vec3> place; // [m] world
    bool leaves = false;     // its first place at all, or the drawn one by more than 1e-6 of its distance
};

class GltfWriter {
public:
    // Keeps references to all but the options. rustle: of this skin, together; none where nothing rustles.
    GltfWriter(Output&, const Skin&, const Tree&, const JointGroups&, const GltfOptions&, Rustle* rustle = nullptr);
    // What came with the tree is shown in place of a skin.
    GltfWriter(Output&, const OwnMesh&, const Tree&, const JointGroups&, const GltfOptions&);
    // The next frame (its pose).
    void write(const MotionFrame&);
    // All of the file. Once; the caller finishes the Output.
    void finish();
    // In place of finish(), which writes to the Output: the same bytes.
    std::string finish_in_memory();
    const JointKeys& keys() const { return keys_; } // thinned once it is finished

private:
    GltfWriter(Output&, const Skin*, const OwnMesh*, const Tree&, const JointGroups&, const GltfOptions&, Rustle*);
    std::string finish(GltfFile&);
    std::string shown(GltfFile&, const Vec3& origin, std::string& extensions, int& weights_node) const;

    Output& output_;
    const Skin* const skin_; // or
    const OwnMesh* const own_;
    const Tree& tree_;
    const JointGroups& groups_;
    GltfOptions options_;
    std::vector<Quat> axes_; // of each joint in its group's frame; empty: the same
    GroupFrames drawn_;
    JointKeys keys_;
    std::vector<Quat> rotation_;
    std::vector<RootPath> paths_; // of the roots, in order
    Rustle* rustle_;
    std::vector<float> weights_; // of the morph targets, frame after frame
};

} // namespace bough
