#include "speedtree_bark.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include "speedtree_bones.h"
#include "speedtree_elements.h"
#include <algorithm>
#include <unordered_map>

namespace bough::speedtree {
namespace {

using IndexOf = std::unordered_map<std::int64_t, std::int32_t>; // of an ID

void read_object(const pugi::xml_node& node, const IndexOf& bones, const Fields& f, BarkSurface& surface) {
    const pugi::xml_node points = node.child("Points"), vertices = node.child("Vertices");
    if (!points || !node.child("Triangles")) return;
    const Vec3 origin = f.vector(node, "Abs", Vec3::Zero());
    const std::size_t first = surface.point.size();
    for (const Vec3& p : f.points(points, "")) surface.point.push_back(p + origin);
    const std::size_t count = surface.point.size() - first;
    surface.bone.resize(surface.point.size(), -1);
    const std::vector<std::int64_t> bone =
        vertices.child("BoneID") ? f.integers(vertices, "BoneID") : std::vector<std::int64_t>();
    for (const pugi::xml_node& triangles : node.children("Triangles")) {
        const std::vector<std::int32_t> corner = f.indices(triangles, "PointIndices", count, "points"),
                                        record = triangles.child("VertexIndices")
                                                     ? f.indices(triangles, "VertexIndices", bone.size(), "vertices")
                                                     : corner;
        if (bone.empty()) continue;
        f.expect_length(triangles, "VertexIndices", record.size(), corner.size());
        for (std::size_t k = 0; k < corner.size(); ++k) {
            std::int32_t& of_point = surface.bone[first + std::size_t(corner[k])];
            if (of_point >= 0 || std::size_t(record[k]) >= bone.size()) continue;
            const std::int64_t id = bone[std::size_t(record[k])];
            const auto found = bones.find(id);
            if (id != -1 && found == bones.end())
                f.refuse(vertices, "BoneID " + std::to_string(id) + " does not exist, expected the ID of a Bone or -1");
            of_point = found == bones.end() ? -1 : found->second;
        }
        for (std::size_t k = 0; k + 2 < corner.size(); k += 3) {
            std::array<std::int32_t, 3> made;
            for (std::size_t j = 0; j < 3; ++j) made[j] = std::int32_t(first) + corner[k + j];
            surface.triangle.push_back(made);
        }
    }
}

constexpr double rough = 0.05;

double middle_ratio(std::vector<double>& of) {
    std::sort(of.begin(), of.end());
    return 0.5 * (of[(of.size() - 1) / 2] + of[of.size() / 2]);
}

} // namespace

BarkSurface parse_bark(std::string_view content, const std::string& name, const std::vector<Bone>& bones) {
    IndexOf index;
    for (std::size_t b = 0; b < bones.size(); ++b) index.emplace(bones[b].id, std::int32_t(b));
    BarkSurface surface;
    Elements(content, name).each("Objects", "Object", [&](const pugi::xml_node& node, const Fields& f) {
        read_object(node, index, f, surface);
    });
    return surface;
}

void take_bark_radii(BarkSurface surface, std::vector<Bone>& bones, ImportNotes& notes) {
    if (surface.triangle.empty()) return;
    const std::vector<BarkTaper> tapers = bark_tapers(Bark(std::move(surface), bones.size()), bones);
    const BoneBranches chains = branches_of_bones(bones);
    std::vector<std::vector<double>> ratios(chains.branches.size());
    for (std::size_t b = 0; b < bones.size(); ++b)
        if (tapers[b].start > 0 && bones[b].radius > 0)
            ratios[std::size_t(chains.branch_of[b])].push_back(tapers[b].start / bones[b].radius);
    std::vector<double> factor(ratios.size(), 1), found;
    for (std::size_t k = 0; k < ratios.size(); ++k) {
        const double ratio = ratios[k].empty() ? 1 : middle_ratio(ratios[k]);
        if (std::abs(ratio - 1) > rough) found.push_back(factor[k] = ratio);
    }
    std::size_t taken = 0;
    for (std::size_t b = 0; b < bones.size(); ++b) {
        if (bones[b].radius > 0) {
            bones[b].radius *= factor[std::size_t(chains.branch_of[b])];
        } else if (tapers[b].start > 0) {
            bones[b].radius = tapers[b].start;
            bones[b].tip = tapers[b].end;
            ++taken;
        }
    }
    if (!found.empty()) {
        const auto [least, most] = std::minmax_element(found.begin(), found.end());
        notes.lines.push_back(
            "radii of bones brought to those of their bark: " + counted(found.size(), "branch", "branches") + " of " +
            std::to_string(factor.size()) + " multiplied by " + shown(*least) + " to " + shown(*most));
    }
    if (taken > 0)
        notes.lines.push_back(counted(taken, "bone", "bones") + " without Radius given that of the bark around");
}

} // namespace bough::speedtree
