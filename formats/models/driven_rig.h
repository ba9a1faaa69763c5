// driven_rig.h: a user's own mesh as a rig (exports/rig.h): its bones as joints, named as the file names them, and its vertices bound to them.
//
// A joint is a bone's rigid part: J(f) turns as the bone does and stands where it starts, without scales. With M_k(f) the matrices of a vertex's
// shares (driven_mesh.h) and F_k = J(0)^-1 M_k(0), what the file scales, shears or mirrors below a bone too,
//     M_k(f) p = J(f) F_k p = J(f) B_k^-1 (Q p),   B_k = Q F_k^-1.
// Q is one matrix for all that a skin moves, M_k(0) of its heaviest joint. So a mesh that is drawn as it was bound has Q = M_k(0) for all k: it is
// written as it is drawn, and B_k = J(0). Where it is drawn in another pose, or two skins bind one bone differently, B_k differs from that; a bone
// that is bound in two ways gets a second joint, which goes with it. Vertices that no bone moves have a joint that stands still.
// Cost     O(shares) once, O(bones) a frame.
// Errors   InputError for a bone that flattens some of its vertices (M_k(0) without an inverse) and is bound otherwise than it is drawn.
#pragma once
#include "driven_mesh.h"
#include "formats/exports/rig.h"

namespace bough {

class DrivenRig {
public:
    // In the drawn pose of the mesh: before its first go_to().
    explicit DrivenRig(const DrivenMesh&);
    Rig rig; // may be taken
    // In a frame of the tree's motion.
    RigPose pose_of(const MotionFrame&);

private:
    class Binding;
    DrivenBones bones_;
    std::vector<std::int32_t> bone_; // of each joint, -1: it stands still
    std::vector<DrivenBones::Pose> pose_;
};

} // namespace bough
