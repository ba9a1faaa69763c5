// usda.h: moving meshes as USD text (.usda): skinned meshes, their skeleton, and a motion as time samples of it (UsdSkel).
//
// One SkelRoot, the default prim: a Skeleton whose joints are a rig's (rig.h), below each other as paths, each with a name that nothing else has, a
// Mesh for each part of the rig's, bound to it, and UsdPreviewSurface materials, whose images stand beside the file (own_maps.h). Metres, Y up; time
// codes count frames from 0. restTransforms are the drawn pose, bindTransforms what the joints were bound at. The SkelAnimation holds every joint's
// rotation in each frame, and its place: drawn, or in each frame where a joint leaves its own. Where the mesh lies so far from the origin that floats
// are coarse (float_range.h), the SkelRoot is moved there. `st` is the first set of UV, `st1` the next; `vertexColor` are colours that came with the
// mesh.
// (No USD library is in Debian 12. The layout is that of OpenUSD's documentation of UsdSkel, UsdGeom and UsdShade.)
// Cost: O(joints) and 16 bytes a joint for each frame, 28 a joint that travels; all else when it is finished.
// Errors  OutputError.
#pragma once
#include "formats/open.h"
#include "formats/text.h"
#include "own_maps.h"
#include "rig.h"

namespace bough {

struct UsdaOptions {
    double fps = 30;
    std::string generator, source; // of the layer's customLayerData; source: left out when empty
};

class UsdaWriter {
public:
    // name: of the SkelRoot; "": tree. look: of each part of the rig's mesh. Keeps references to the output, the rig and the looks.
    UsdaWriter(Output&, const std::string& name, const Rig&, const std::vector<OwnLook>& look, const UsdaOptions&);
    void write(const RigPose&); // the next frame
    void finish();              // all of the file. Once; the caller finishes the Output
    // [bytes] What the frames so far will take, about: each after the second as much as that one.
    std::uint64_t waiting() const { return frames_ < 2 ? first_bytes_ : first_bytes_ + (frames_ - 1) * second_bytes_; }

private:
    Vec3 place_of(const RigPose&, std::size_t joint) const;
    void add_rotations(Text&, std::size_t frame) const;
    void add_places(Text&, std::size_t frame) const;
    void add_head(Text&, const std::string& name) const;
    void add_skeleton(Text&, const std::string& root, const std::vector<std::string>& path) const;
    void add_motion(Text&, const std::vector<std::string>& path) const;

    Output& output_;
    const std::string name_;
    const Rig& rig_;
    const std::vector<OwnLook>& look_;
    const UsdaOptions options_;
    const Vec3 origin_;
    std::vector<Vec3> drawn_;             // place of each joint in its parent's frame
    std::vector<std::int32_t> traveller_; // of each joint: which of those that travel it is, -1: none
    std::size_t travellers_ = 0;
    std::size_t frames_ = 0;
    std::uint64_t first_bytes_ = 0, second_bytes_ = 0;
    std::vector<Eigen::Vector4f> rotation_; // x, y, z, w of each joint in its parent's frame, frame after frame
    std::vector<Eigen::Vector3f> place_;    // of each that travels, likewise
    bool moves_ = false;                    // one of these has left its place
};

} // namespace bough
