#include "armature.h"
#include "formats/imports/speedtree_bones.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <array>

namespace bough {
namespace {

using speedtree::Bone;
constexpr double on_axis = 1e-4; // how far from a bone's axis another starts that goes on, over its distance

// One of the six directions +x -x +y -y +z -z of a node's own axes.
Vec3 own_axis(const ModelScene& scene, std::int32_t node, int axis) {
    return (axis % 2 == 0 ? 1 : -1) * scene.axes[std::size_t(node)].col(axis / 2);
}

bool lies_on(const Vec3& step, const Vec3& direction) {
    const double along = step.dot(direction);
    return along > 0 && (step - along * direction).norm() <= on_axis * along;
}

struct Rods {
    const ModelScene& scene;
    const ChosenJoints& chosen;
    Armature made;
    std::vector<std::vector<std::int32_t>> below; // of each bone: nodes of the bones and marks that hang on it
    const std::vector<Vec3>* vertex = nullptr;    // to measure by: standing_mesh
    const Bark* bark = nullptr;                   // likewise; null: there is none
};

// The axis along which most bones carry another one; -1: less than half of those that carry any.
int usual_axis(const Rods& r) {
    std::array<std::size_t, 6> votes{};
    std::size_t carrying = 0;
    for (std::size_t b = 0; b < r.made.bones.size(); ++b) {
        carrying += !r.below[b].empty();
        for (int axis = 0; axis < 6; ++axis) {
            const Vec3 direction = own_axis(r.scene, r.made.node[b], axis);
            votes[std::size_t(axis)] += std::any_of(r.below[b].begin(), r.below[b].end(), [&](std::int32_t node) {
                return lies_on(r.scene.place[std::size_t(node)] - r.made.bones[b].start, direction);
            });
        }
    }
    const auto most = std::max_element(votes.begin(), votes.end());
    return 2 * *most >= carrying && *most > 0 ? int(most - votes.begin()) : -1;
}

void set_end(Bone& bone, const Vec3& end) {
    bone.end = end;
    bone.has_end = true;
}

// Ends that stand in the file: marks, tips, the bone that goes on.
void take_ends(Rods& r, int axis) {
    for (const std::int32_t mark : r.chosen.mark) {
        Bone& bone = r.made.bones[std::size_t(r.chosen.above[std::size_t(mark)])];
        const Vec3& place = r.scene.place[std::size_t(mark)];
        if (!bone.has_end || (place - bone.start).norm() > (bone.end - bone.start).norm()) set_end(bone, place);
    }
    for (std::size_t b = 0; b < r.made.bones.size(); ++b) {
        Bone& bone = r.made.bones[b];
        const auto node = std::size_t(r.made.node[b]);
        if (bone.has_end) continue;
        if (r.scene.tip[node].allFinite()) {
            set_end(bone, r.scene.tip[node]);
            continue;
        }
        if (axis < 0) continue;
        double farthest = 0;
        for (const std::int32_t child : r.below[b]) {
            const Vec3 step = r.scene.place[std::size_t(child)] - bone.start;
            if (!lies_on(step, own_axis(r.scene, r.made.node[b], axis)) || step.norm() <= farthest) continue;
            farthest = step.norm();
            set_end(bone, r.scene.place[std::size_t(child)]);
        }
    }
}

// How far the vertices of each bone reach from its start along a direction; 0 for fewer than 3.
std::vector<double> reach(const Rods& r, const std::vector<Vec3>& direction) {
    std::vector<std::int32_t> bone_of(r.scene.parent.size(), -1), count(r.made.bones.size(), 0);
    for (std::size_t b = 0; b < r.made.bones.size(); ++b) bone_of[std::size_t(r.made.node[b])] = std::int32_t(b);
    std::vector<double> farthest(r.made.bones.size(), 0);
    for (std::size_t v = 0; v < r.vertex->size(); ++v) {
        const std::int32_t b = bone_of[std::size_t(r.scene.vertex_node[v])];
        if (b < 0) continue;
        ++count[std::size_t(b)];
        farthest[std::size_t(b)] =
            std::max(farthest[std::size_t(b)],
                     ((*r.vertex)[v] - r.made.bones[std::size_t(b)].start).dot(direction[std::size_t(b)]));
    }
    for (std::size_t b = 0; b < farthest.size(); ++b)
        if (count[b] < 3) farthest[b] = 0;
    return farthest;
}

// The way from each bone's start to the middle of its vertices; zero where it has none.
std::vector<Vec3> toward_vertices(const Rods& r) {
    std::vector<Vec3> sum(r.scene.parent.size(), Vec3::Zero()), result;
    std::vector<double> count(r.scene.parent.size(), 0);
    for (std::size_t v = 0; v < r.vertex->size(); ++v) {
        sum[std::size_t(r.scene.vertex_node[v])] += (*r.vertex)[v];
        ++count[std::size_t(r.scene.vertex_node[v])];
    }
    for (std::size_t b = 0; b < r.made.bones.size(); ++b) {
        const auto node = std::size_t(r.made.node[b]);
        result.push_back(count[node] > 0 ? Vec3(sum[node] / count[node] - r.made.bones[b].start) : Vec3(Vec3::Zero()));
    }
    return result;
}

// As far as the bark around a bone's start goes on, which twigs that the same bone moves do not; 0: there is none.
double bark_reach(const Rods& r, std::size_t b, const Vec3& direction, double vertices_reach) {
    if (!r.bark) return 0;
    const Bone& bone = r.made.bones[b];
    double length = vertices_reach;
    if (bone.parent >= 0) length = std::min(length, (bone.start - r.made.bones[std::size_t(bone.parent)].start).norm());
    for (const double place : {0.02, 0.05, 0.1, 0.2}) {
        const BarkRing ring = r.bark->ring(std::int32_t(b), bone.start + place * length * direction, direction);
        if (ring.radius > 0) return r.bark->reach(std::int32_t(b), ring.piece, bone.start, direction, 2 * ring.radius);
    }
    return 0;
}

// Ends of the bones that have none yet: tips, and bones whose axis no other follows.
void make_ends(Rods& r, int axis, ImportNotes& notes) {
    const std::vector<Vec3> middle = toward_vertices(r);
    std::vector<Vec3> direction;
    for (std::size_t b = 0; b < r.made.bones.size(); ++b) {
        const Bone& bone = r.made.bones[b];
        const Vec3 step =
            bone.parent >= 0 ? Vec3(bone.start - r.made.bones[std::size_t(bone.parent)].start) : Vec3(Vec3::Zero());
        direction.push_back(axis >= 0                ? own_axis(r.scene, r.made.node[b], axis)
                            : step.squaredNorm() > 0 ? step.normalized()
                                                     : middle[b].normalized());
    }
    const std::vector<double> reaches = reach(r, direction);
    std::size_t by_mesh = 0, by_parent = 0;
    for (std::size_t b = 0; b < r.made.bones.size(); ++b) { // parents first
        Bone& bone = r.made.bones[b];
        if (bone.has_end || (axis < 0 && !r.below[b].empty())) continue;
        const double by_bark = reaches[b] > 0 ? bark_reach(r, b, direction[b], reaches[b]) : 0;
        double length = by_bark > 0 ? by_bark : reaches[b];
        ++(length > 0 ? by_mesh : by_parent);
        if (!(length > 0) && bone.parent >= 0) {
            const Bone& above = r.made.bones[std::size_t(bone.parent)];
            length = above.has_end ? (above.end - above.start).norm() : (bone.start - above.start).norm();
        }
        for (const std::int32_t child : r.below[b])
            length = std::max(length, (r.scene.place[std::size_t(child)] - bone.start).dot(direction[b]));
        set_end(bone, bone.start + length * direction[b]);
    }
    if (by_mesh > 0)
        notes.lines.push_back(counted(by_mesh, "bone without an end: it reaches as far as its bark or vertices",
                                      "bones without an end: they reach as far as their bark or vertices"));
    if (by_parent > 0)
        notes.lines.push_back(counted(by_parent, "bone without an end: as long as the bone it goes on from",
                                      "bones without an end: as long as the bone they go on from"));
}

} // namespace

Armature armature_of(const ModelScene& scene, const Vec3& up, ImportNotes& notes) {
    const ChosenJoints chosen = choose_joints(scene, up, notes);
    Rods r{scene, chosen, {}, {}};
    for (const std::int32_t node : chosen.bone) {
        Bone bone;
        bone.id = node;
        bone.parent = chosen.above[std::size_t(node)];
        bone.start = scene.place[std::size_t(node)];
        r.made.bones.push_back(bone);
        r.made.node.push_back(node);
    }
    r.below.resize(r.made.bones.size());
    for (const std::vector<std::int32_t>* nodes : {&chosen.bone, &chosen.mark})
        for (const std::int32_t node : *nodes)
            if (const std::int32_t b = chosen.above[std::size_t(node)]; b >= 0) r.below[std::size_t(b)].push_back(node);
    const int axis = usual_axis(r);
    take_ends(r, axis);
    r.vertex = &standing_mesh(scene, r.made, notes);
    std::optional<Bark> bark;
    if (!r.vertex->empty()) bark.emplace(surface_of(scene, *r.vertex, r.made), r.made.bones.size());
    if (bark) r.bark = &*bark;
    make_ends(r, axis, notes);
    ImportNotes by_longest_way; // as the header says; no guess about an end that the file lacks
    speedtree::complete_ends(r.made.bones, by_longest_way);
    if (bark) measure_radii(*bark, scene, r.made, notes);
    return std::move(r.made);
}

} // namespace bough
