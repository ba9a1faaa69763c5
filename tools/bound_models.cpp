#include "bound_models.h"
#include "formats/models/gltf_references.h"
#include "lib/model/split.h"
#include <map>
#include <numbers>

namespace bough {
namespace {

// Where a scene puts its tree.
Eigen::Affine3d place_of(const Scene& scene, std::size_t tree) {
    if (scene.trees.empty()) return Eigen::Affine3d::Identity();
    const Placement& place = scene.trees[tree];
    return Eigen::Translation3d(place.position) * Eigen::AngleAxisd(place.yaw * std::numbers::pi / 180, Vec3::UnitY());
}

// A glTF material whose images are `by` further on.
std::string with_images(const std::string& material, std::size_t by) {
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(material);
    gltf_references::each_texture_index(json, [by](auto& index) { index = index.template get<std::size_t>() + by; });
    return json.dump();
}

// What has no mesh yet: trees that look alike together, and with the first of them what stands behind all trees. looks: none, and all look alike.
std::vector<std::pair<TreeLook, Bodies>> by_look(const std::vector<char>& bound, const std::vector<TreeRange>& ranges,
                                                 const std::vector<TreeLook>& looks) {
    std::vector<std::pair<TreeLook, Bodies>> groups;
    std::map<TreeLook, std::size_t> known;
    const auto take = [&](const TreeLook& look, std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            if (bound[i]) continue;
            const auto [group, added] = known.try_emplace(look, groups.size());
            if (added) groups.emplace_back(look, Bodies());
            groups[group->second].second.push_back(std::int32_t(i));
        }
    };
    std::size_t behind = 0;
    for (std::size_t k = 0; k < ranges.size(); ++k) {
        const std::size_t end = ranges[k].first_body + ranges[k].bodies;
        take(looks.empty() ? TreeLook() : looks[k], ranges[k].first_body, end);
        behind = std::max(behind, end);
    }
    take(groups.empty() ? TreeLook() : TreeLook(groups.front().first), behind, bound.size());
    return groups;
}

} // namespace

SharedParts share(OwnMesh& to, OwnMesh& more) {
    const SharedParts at{to.shape.size(), to.material.size()};
    for (const std::string& material : more.material) to.material.push_back(with_images(material, to.image.size()));
    std::move(more.image.begin(), more.image.end(), std::back_inserter(to.image));
    std::move(more.shape.begin(), more.shape.end(), std::back_inserter(to.shape));
    return at;
}

void add_parts(OwnMesh& to, OwnMesh&& more, const SharedParts& at, const Bodies& bodies) {
    for (OwnPart& part : more.part) {
        if (part.material >= 0) part.material += std::int32_t(at.material);
        for (auto& two : part.body)
            for (std::int32_t& body : two) body = bodies[std::size_t(body)];
        for (OwnPlace& place : part.placed) {
            place.shape += std::int32_t(at.shape);
            place.body = bodies[std::size_t(place.body)];
            if (place.foot >= 0) place.foot = bodies[std::size_t(place.foot)];
        }
        to.part.push_back(std::move(part));
    }
}

OwnMesh bound_mesh(std::vector<FileModel> models, const Tree& shown, const Setting& setting, const OtherTrees& other,
                   const std::function<OwnMesh(const Tree&)>& made, std::vector<std::string>& notes) {
    const std::vector<TreeRange>& ranges = setting.whole ? setting.whole->places.whole : setting.ranges;
    if (!models.empty() && ranges.size() == 1 && ranges.front().bodies == shown.size_bodies())
        return bound_to(std::move(models.front().model), shown, place_of(setting.scene, 0), notes);
    OwnMesh mesh;
    std::vector<char> bound(shown.size_bodies(), false);
    for (const std::int32_t i : other.elsewhere) bound[std::size_t(i)] = true;
    for (FileModel& file : models) {
        std::optional<SharedParts> at;
        std::vector<std::string> said;
        for (const std::size_t k : file.trees) {
            Bodies bodies;
            for (std::size_t i = 0; i < ranges[k].bodies; ++i) bodies.push_back(std::int32_t(ranges[k].first_body + i));
            for (const std::int32_t i : bodies) bound[std::size_t(i)] = true;
            said.clear(); // of each tree the same
            const bool last = k == file.trees.back();
            OwnMesh own = bound_to(last ? std::move(file.model) : file.model, part_of(shown, bodies),
                                   place_of(setting.scene, k), said);
            if (!at) at = share(mesh, own);
            add_parts(mesh, std::move(own), *at, bodies);
        }
        notes.insert(notes.end(), said.begin(), said.end());
    }
    for (auto& [look, bodies] : by_look(bound, ranges, other.looks)) {
        Tree rest = part_of(shown, bodies);
        if (!other.looks.empty()) rest.name = look.name, rest.color = look.color;
        OwnMesh others = made(rest);
        const SharedParts at = share(mesh, others);
        add_parts(mesh, std::move(others), at, bodies);
    }
    return mesh;
}

} // namespace bough
