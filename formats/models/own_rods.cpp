#include "own_rods.h"
#include "formats/imports/polyline_search.h"
#include <map>
#include <nlohmann/json.hpp>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

bool is_index(double number) {
    return number >= -1 && number < 2147483647.0 && number == std::floor(number);
}

// False where it is not what we write.
bool read(const Json& list, std::vector<OwnRod>& rods) {
    if (!list.is_array() || list.size() % std::tuple_size_v<OwnRod> != 0) return false;
    for (std::size_t from = 0; from < list.size(); from += std::tuple_size_v<OwnRod>) {
        OwnRod rod;
        for (std::size_t k = 0; k < rod.size(); ++k) {
            if (!list[from + k].is_number()) return false;
            rod[k] = list[from + k].get<double>();
            if (!std::isfinite(rod[k])) return false;
        }
        if (!is_index(rod[0]) || rod[0] < 0 || !is_index(rod[1]) || rod[5] < 0 || rod[9] < 0) return false;
        rods.push_back(rod);
    }
    return true;
}

} // namespace

OwnRods own_rods(const Json& nodes) {
    OwnRods own;
    own.rods.resize(nodes.size());
    own.ours.assign(nodes.size(), false);
    bool any = false;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!nodes[i].contains("extras") || !nodes[i]["extras"].is_object()) continue;
        const Json& extras = nodes[i]["extras"];
        if (!extras.contains("bough_rods")) continue;
        if (!read(extras["bough_rods"], own.rods[i])) return {};
        own.ours[i] = true;
        any = any || !own.rods[i].empty();
        if (extras.contains("bough_others") && extras["bough_others"].is_number())
            own.others += std::int64_t(std::clamp(extras["bough_others"].get<double>(), 0.0, 1e12));
    }
    return any ? own : OwnRods{};
}

OwnRod in_world(const OwnRod& rod, const Eigen::Affine3d& world) {
    OwnRod result = rod;
    const double scale = std::cbrt(std::abs(world.linear().determinant()));
    for (const std::size_t from : {std::size_t(2), std::size_t(6)}) {
        const Vec3 place = world * Vec3(rod[from], rod[from + 1], rod[from + 2]);
        for (std::size_t k = 0; k < 3; ++k) result[from + k] = place[std::ptrdiff_t(k)];
        result[from + 3] = scale * rod[from + 3];
    }
    return result;
}

std::vector<ImportedBranch> branches_of(const std::vector<OwnRod>& rods) {
    std::map<double, std::int32_t> place; // of a branch's number in the file
    for (const OwnRod& rod : rods) place[rod[0]] = 0;
    std::int32_t count = 0;
    for (auto& [number, index] : place) index = count++;
    std::vector<ImportedBranch> branches(place.size());
    for (const OwnRod& rod : rods) {
        ImportedBranch& branch = branches[std::size_t(place.find(rod[0])->second)];
        if (branch.point.empty()) {
            const auto parent = place.find(rod[1]); // one that came before, so that there is no cycle
            const bool carried = parent != place.end() && !branches[std::size_t(parent->second)].point.empty();
            branch.parent = carried ? parent->second : -1;
            branch.point.emplace_back(rod[2], rod[3], rod[4]);
            branch.radius.push_back(0);
        }
        branch.radius.back() = rod[5];
        branch.point.emplace_back(rod[6], rod[7], rod[8]);
        branch.radius.push_back(rod[9]);
    }
    BranchSearch search(branches);
    for (ImportedBranch& branch : branches)
        if (branch.parent >= 0)
            branch.parent_at = search.nearest(std::size_t(branch.parent), branch.point.front()).fraction;
    return branches;
}

} // namespace bough
