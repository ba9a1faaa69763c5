// rigged_mesh.h: what a run shows as rigs (exports/rig.h): meshes that bodies move, and models' own, which their bones move.
#pragma once
#include "formats/exports/rig.h"
#include "formats/models/driven_mesh.h"
#include "frame_sink.h"
#include <functional>

namespace bough {

struct RiggedMesh {
    Rig rig;
    OwnMesh look; // materials and images of its parts, without surfaces
    std::function<RigPose(const MotionFrame&)> pose;
    std::function<void()> note; // what it cost, once the last frame is written
};

// Of all bodies, merged to as many joints as chosen. own: what the skin was made of. Keeps references to the tree and the notes.
RiggedMesh rigged(const Tree&, Skin, std::optional<OwnMesh> own, const GltfChoice&, std::vector<std::string>& notes);
// Of a model's own mesh, in its drawn pose.
RiggedMesh rigged(const DrivenMesh&);

inline double height_of(const Skin& skin) {
    double low = INFINITY, high = -INFINITY;
    for (const Vec3& p : skin.position) low = std::min(low, p.y()), high = std::max(high, p.y());
    return high - low;
}

} // namespace bough
