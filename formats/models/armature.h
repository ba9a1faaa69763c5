// armature.h: the rods of a model's armature: which nodes are bones, where each ends, how thick it is.
//
// Bones. A node that a skin or COLLADA calls a joint; in FBX every node that holds nothing and is no Null; in a file that
// names none and has no faces, every node that holds nothing. Left out, each counted in a note:
//   - a topmost node whose bones begin beside or at it rather than above it, unless the file calls it a joint: it is the
//     armature's frame, not wood;
//   - where a bone moves a vertex: an armature of its own none of whose bones moves a vertex (a topmost bone with two more in a row
//     below it), and what else moves no vertex, nor anything below it (IK targets, controls), but for the one place
//     below a bone that ends a chain, which is that bone's end;
//   - where none does (no skin, or one that moves none of them, which a note says): bones that have a rigger's word in their name (ik, ctrl, ctl,
//     control, controller, target, pole, mch), with nothing but such below them, unless all have;
//   - a bone without anything below it that says how long it is: alone, where no bone moves a vertex; Blender's `neutral_bone`.
// A node whose name ends in `_end`, `.end` or `nub` with nothing below it marks the end of its parent and is no bone.
// Ends. At such a mark; else where the file states it (Blender's COLLADA); else at the bone below that starts on this
// bone's own axis, the farthest: the local axis on which most bones of the file carry another within 1e-4 (Blender's
// is +Y); else, for a file whose bones have no such axis, at the start of the bone below with the longest way to a tip;
// else along the axis as far as the bark around its start goes (bark.h), or where there is none the vertices it moves most; else as
// long as the bone above. A bone reaches at least as far as the bones below it start.
// Radii. Of the bark around a bone (bark.h), told from twigs that have no bones of their own and move with it; other bones by the
// pipe rule (pipe_rule.h). The twigs are wood too (bark_twigs.h), branches beside those of the bones. Where one is more than twice as thick as where
// the bone before it starts, a note says so.
// Reads a ModelScene, its coordinates. O(nodes + vertices log vertices of a bone).
#pragma once
#include "formats/imports/bark_twigs.h"
#include "formats/imports/imported_tree.h"
#include "formats/imports/speedtree_xml.h"
#include "model_scene.h"

namespace bough {

struct Armature {
    std::vector<speedtree::Bone> bones; // all ends given; radius 0: not known
    std::vector<std::int32_t> node;     // of each bone
    std::vector<Twig> twigs;            // wood of the mesh that moves with bones but is none of theirs
    bool mesh_beside = false;           // standing_mesh() did not take the vertices as the skin places them
};

// `up`: unit vector in the scene's coordinates. Empty where there is no bone.
Armature armature_of(const ModelScene&, const Vec3& up, ImportNotes&);

// ---- armature_joints.cpp ---- the nodes that are bones and those that mark a bone's end.
struct ChosenJoints {
    std::vector<std::int32_t> bone;  // nodes, parents first
    std::vector<std::int32_t> above; // of each node: the bone it hangs on, as an index into `bone`, -1: none
    std::vector<std::int32_t> mark;  // nodes that are an end of the bone above them
};
ChosenJoints choose_joints(const ModelScene&, const Vec3& up, ImportNotes&);

// ---- armature_mesh.cpp ---- the vertices to measure by: where the skin places them, but where its bind matrices are not
// those of its nodes (mean distance from the bones at least twice as large) where the mesh's own node does; none, where
// both lie off by more than half of the armature's size. Needs the ends that the file states.
const std::vector<Vec3>& standing_mesh(const ModelScene&, Armature&, ImportNotes&);

// ---- armature_radii.cpp ---- the faces between these vertices (standing_mesh) as bark; its radii, which need ends.
BarkSurface surface_of(const ModelScene&, const std::vector<Vec3>& vertex, const Armature&);
void measure_radii(const Bark&, const ModelScene&, Armature&, ImportNotes&);

// ---- armature_tree.cpp ---- the bones as branches; what has no radius gets it by the pipe rule (pipe_rule.h). Twigs begin on the wood
// nearest to their bases (nearest_segment.h).
ImportedTree tree_of(const Armature&, ImportNotes&);

} // namespace bough
