#include "armature.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"

namespace bough {

BarkSurface surface_of(const ModelScene& scene, const std::vector<Vec3>& vertex, const Armature& armature) {
    std::vector<std::int32_t> bone_of(scene.parent.size(), -1);
    for (std::size_t b = 0; b < armature.bones.size(); ++b) bone_of[armature.node[b]] = std::int32_t(b);
    BarkSurface surface{vertex, scene.face, {}};
    for (const std::int32_t node : scene.vertex_node) surface.bone.push_back(bone_of[node]);
    return surface;
}

namespace {

// Blender's Skin modifier draws wood of radius r as a square of 2 r, from the trunk to the twigs; other programs have more corners on a
// trunk, and their corners stand on its circle.
double corner_factor(const std::vector<BarkTaper>& tapers) {
    std::size_t rings = 0, square = 0, thickest = 0;
    for (std::size_t b = 0; b < tapers.size(); ++b) {
        rings += std::size_t(tapers[b].rings);
        square += std::size_t(tapers[b].square);
        if (tapers[b].start > tapers[thickest].start) thickest = b;
    }
    return 5 * square > 4 * rings && tapers[thickest].square > 0 ? std::sqrt(0.5) : 1;
}

} // namespace

void measure_radii(const Bark& bark, const ModelScene& scene, Armature& armature, ImportNotes& notes) {
    std::vector<speedtree::Bone>& bones = armature.bones;
    const std::vector<BarkTaper> tapers = bark_tapers(bark, bones);
    const double factor = corner_factor(tapers);
    std::size_t measured = 0, growing = 0;
    std::string first;
    for (std::size_t b = 0; b < bones.size(); ++b) { // parents first
        bones[b].radius = factor * tapers[b].start;
        bones[b].tip = factor * tapers[b].end;
        measured += tapers[b].start > 0;
        const double before = bones[b].parent >= 0 ? bones[bones[b].parent].radius : 0;
        if (!(before > 0) || !(bones[b].radius > 2 * before)) continue;
        if (++growing == 1)
            first = in_ascii_quotes(scene.name[armature.node[b]]) + ", " + shown(bones[b].radius / before) +
                    " times as thick";
    }
    if (measured == 0) return;
    armature.twigs = twigs_without_bones(bark, bones, tapers);
    for (Twig& twig : armature.twigs)
        for (double& r : twig.radius) r *= factor;
    notes.lines.push_back("radii of " + std::to_string(measured) + " of " + std::to_string(bones.size()) +
                          " bones measured on the mesh: the circle of the bark around each" +
                          (factor < 1 ? ", square as Blender's Skin modifier draws it: half its sides" : ""));
    if (!armature.twigs.empty())
        notes.lines.push_back(counted(armature.twigs.size(), "twig without a bone of its own is wood",
                                      "twigs without bones of their own are wood") +
                              " by the mesh; --skin moves them with the bones they have");
    if (growing > 0)
        notes.lines.push_back("the bark of " + counted(growing, "bone is", "bones is") +
                              " more than twice as thick as that of the bone before (" + first + ")");
}

} // namespace bough
