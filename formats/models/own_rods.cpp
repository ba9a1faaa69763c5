#include "own_rods.h"
#include "formats/imports/polyline_search.h"
#include <limits>
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
    if (!list.is_array()) return false;
    std::vector<double> number;
    number.reserve(list.size());
    for (const Json& value : list) {
        if (!value.is_number()) return false;
        number.push_back(value.get<double>());
        if (!(std::abs(number.back()) <= double(std::numeric_limits<float>::max()))) return false;
    }
    for (std::size_t from = 0; from < number.size();) {
        if (number.size() - from < 3) return false;
        const double branch = number[from], parent = number[from + 1], points = number[from + 2];
        from += 3;
        if (!is_index(branch) || branch < 0 || !is_index(parent) || !is_index(points) || points < 2) return false;
        if (double(number.size() - from) < 4 * points) return false;
        for (std::size_t point = 0; point < std::size_t(points); ++point, from += 4) {
            for (std::size_t k = 0; k < 4; ++k) number[from + k] = double(float(number[from + k])); // as it was written
            if (number[from + 3] < 0) return false;
            if (point == 0) continue;
            OwnRod rod{branch, point == 1 ? parent : branch};
            for (std::size_t k = 0; k < 8; ++k) rod[2 + k] = number[from - 4 + k];
            rods.push_back(rod);
        }
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
        if (!extras.contains("bough_wood")) continue;
        if (!read(extras["bough_wood"], own.rods[i])) return {};
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
