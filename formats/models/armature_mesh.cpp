#include "armature.h"
#include "formats/plain_text.h"
#include <algorithm>
#include <limits>

namespace bough {
namespace {

using speedtree::Bone;

// A bone whose end is not stated goes on as far as from its parent's start to its own.
Vec3 likely_end(const std::vector<Bone>& bones, const Bone& bone) {
    if (bone.has_end || bone.parent < 0) return bone.has_end ? bone.end : bone.start;
    return 2 * bone.start - bones[std::size_t(bone.parent)].start;
}

// Mean distance of the vertices from the bones that move them; 0 without any.
double mean_distance(const std::vector<Vec3>& vertex, const std::vector<std::int32_t>& bone,
                     const std::vector<Bone>& bones, const std::vector<Vec3>& end) {
    double sum = 0, count = 0;
    for (std::size_t v = 0; v < vertex.size(); ++v) {
        if (bone[v] < 0) continue;
        const Vec3 &a = bones[std::size_t(bone[v])].start, &b = end[std::size_t(bone[v])];
        sum += (a + projected(a, b, vertex[v]) * (b - a) - vertex[v]).norm();
        ++count;
    }
    return count > 0 ? sum / count : 0;
}

} // namespace

const std::vector<Vec3>& standing_mesh(const ModelScene& scene, Armature& armature, ImportNotes& notes) {
    static const std::vector<Vec3> none;
    std::vector<std::int32_t> bone_of(scene.parent.size(), -1), bone;
    for (std::size_t b = 0; b < armature.bones.size(); ++b) bone_of[std::size_t(armature.node[b])] = std::int32_t(b);
    for (const std::int32_t node : scene.vertex_node) bone.push_back(bone_of[std::size_t(node)]);
    std::vector<Vec3> end;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Bone& b : armature.bones) {
        end.push_back(likely_end(armature.bones, b));
        low = low.cwiseMin(b.start).cwiseMin(end.back());
        high = high.cwiseMax(b.start).cwiseMax(end.back());
    }
    const double by_skin = mean_distance(scene.vertex, bone, armature.bones, end),
                 by_node = mean_distance(scene.vertex_by_node, bone, armature.bones, end);
    const bool elsewhere = !scene.vertex_by_node.empty() && by_node < 0.5 * by_skin;
    const double off = elsewhere ? by_node : by_skin, extent = (high - low).norm();
    if (extent > 0 && off > 0.5 * extent) {
        armature.mesh_beside = true;
        notes.lines.push_back("the skin's bind matrices put the mesh " + shown(off / extent) +
                              " times the armature's size beside its bones: radii are not measured on it");
        return none;
    }
    if (!elsewhere) return scene.vertex;
    armature.mesh_beside = true;
    notes.lines.push_back("the skin's bind matrices put the mesh beside its bones (an armature moved or scaled by what "
                          "it hangs on?): measured where the mesh's own node stands");
    return scene.vertex_by_node;
}

} // namespace bough
