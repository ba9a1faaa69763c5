// usda.h: a tree as USD text (.usda): skinned meshes, their skeleton, and a motion as time samples of it (UsdSkel).
//
// One SkelRoot, the default prim, named after the tree: a Skeleton whose joints are the tree's groups (merge_joints.h), `body_N` below each other as paths,
// a Mesh for each part of the skin, bound to it, and UsdPreviewSurface materials, whose images stand beside the file (own_maps.h). Metres, Y up; time
// codes count frames from 0. bindTransforms and restTransforms are the drawn pose. The SkelAnimation holds every joint's rotation in each frame, and
// its place: drawn, or in each frame where a root leaves its own. Where the tree lies so far from the origin that floats are coarse (float_range.h), the
// SkelRoot is moved there. `st` is the first set of UV, `st1` the next; `vertexColor` are colours that came with the mesh.
// (No USD library is in Debian 12. The layout is that of OpenUSD's documentation of UsdSkel, UsdGeom and UsdShade.)
// Cost: O(joints) and 16 bytes a joint for each frame; all else when it is finished.
// Errors  OutputError.
#pragma once
#include "formats/open.h"
#include "formats/text.h"
#include "lib/growth/merge_joints.h"
#include "lib/model/motion.h"
#include "own_maps.h"

namespace bough {

struct UsdaOptions {
    double fps = 30;
    std::string generator, source; // of the layer's customLayerData; source: left out when empty
};

class UsdaWriter {
public:
    // own: what the skin was made of; null: none. look: of each part of the skin. Keeps references to all but the options.
    UsdaWriter(Output&, const Skin&, const OwnMesh* own, const std::vector<OwnLook>& look, const Tree&,
               const JointGroups&, const UsdaOptions&);
    void write(const MotionFrame&); // the next frame: its pose
    void finish();                  // all of the file. Once; the caller finishes the Output
    // [bytes] What the frames so far will take, about: each after the second as much as that one.
    std::uint64_t waiting() const { return frames_ < 2 ? first_bytes_ : first_bytes_ + (frames_ - 1) * second_bytes_; }

private:
    void add_rotations(Text&, std::size_t frame) const;

    Output& output_;
    const Skin& skin_;
    const OwnMesh* const own_;
    const std::vector<OwnLook>& look_;
    const Tree& tree_;
    const JointGroups& groups_;
    const UsdaOptions options_;
    GroupFrames drawn_;
    std::size_t frames_ = 0;
    std::uint64_t first_bytes_ = 0, second_bytes_ = 0;
    std::vector<Eigen::Vector4f> rotation_; // x, y, z, w of each joint in its parent's frame, frame after frame
    std::vector<std::size_t> root_;         // joints without parent, and where they are, frame after frame
    std::vector<Vec3> place_;
    bool roots_move_ = false;
};

} // namespace bough
