#include "armature.h"
#include <algorithm>

namespace bough {
namespace {

struct VertexByBone {
    double along, off; // of the bone's length; [file unit] from its axis
};

double median(std::vector<double>& values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double radius_of(const std::vector<VertexByBone>& places) {
    std::vector<double> first_half, all;
    for (const VertexByBone& p : places) {
        all.push_back(p.off);
        if (p.along <= 0.5) first_half.push_back(p.off);
    }
    return first_half.size() >= 3 ? median(first_half) : all.size() >= 3 ? median(all) : 0;
}

} // namespace

void measure_radii(const ModelScene& scene, const std::vector<Vec3>& vertex, Armature& armature, ImportNotes& notes) {
    if (vertex.empty()) return;
    std::vector<std::int32_t> bone_of(scene.parent.size(), -1);
    for (std::size_t b = 0; b < armature.bones.size(); ++b) bone_of[armature.node[b]] = std::int32_t(b);
    std::vector<std::vector<VertexByBone>> places(armature.bones.size());
    for (std::size_t v = 0; v < vertex.size(); ++v) {
        const std::int32_t b = bone_of[scene.vertex_node[v]];
        if (b < 0) continue;
        const Vec3 axis = armature.bones[b].end - armature.bones[b].start;
        const double length = axis.norm();
        if (!(length > 0)) continue;
        const Vec3 from = vertex[v] - armature.bones[b].start;
        const double along = from.dot(axis) / length;
        places[b].push_back({along / length, (from - along / length * axis).norm()});
    }
    std::size_t measured = 0;
    for (std::size_t b = 0; b < places.size(); ++b) {
        armature.bones[b].radius = radius_of(places[b]);
        measured += armature.bones[b].radius > 0;
    }
    if (measured > 0)
        notes.lines.push_back("radii of " + std::to_string(measured) + " of " + std::to_string(places.size()) +
                              " bones measured on the mesh: the median distance from the bone of what it moves");
}

} // namespace bough
