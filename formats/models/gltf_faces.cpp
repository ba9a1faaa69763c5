#include "gltf_faces.h"
#include "gltf_accessor.h"
#include <algorithm>

namespace bough {

using Json = nlohmann::ordered_json;

GltfFaces faces_of(const GltfDocument& document, const Json& primitive, const std::string& place, std::size_t points) {
    const std::size_t mode = whole_number(primitive, "mode", place, 4);
    std::vector<std::int32_t> index;
    if (primitive.contains("indices")) {
        for (const double i :
             values_of(document, primitive["indices"], {place + ": indices", "SCALAR", GltfNumbers::indices}))
            index.push_back(std::int32_t(i));
    } else {
        for (std::size_t k = 0; k < points; ++k) index.push_back(std::int32_t(k));
    }
    GltfFaces faces;
    faces.each = mode == 0 ? 0 : mode <= 3 ? 2 : 3;
    const std::size_t n = index.size();
    const auto add = [&](std::initializer_list<std::size_t> places) {
        for (const std::size_t k : places) faces.corner.push_back(index[k]);
    };
    if (mode == 1)
        for (std::size_t k = 0; k + 1 < n; k += 2) add({k, k + 1});
    if (mode == 2 || mode == 3)
        for (std::size_t k = 0; k + 1 < n; ++k) add({k, k + 1});
    if (mode == 2 && n > 2) add({n - 1, 0});
    if (mode == 4)
        for (std::size_t k = 0; k + 2 < n; k += 3) add({k, k + 1, k + 2});
    if (mode == 5)
        for (std::size_t k = 0; k + 2 < n; ++k) k % 2 == 0 ? add({k, k + 1, k + 2}) : add({k + 1, k, k + 2});
    if (mode == 6)
        for (std::size_t k = 1; k + 1 < n; ++k) add({0, k, k + 1});
    return faces;
}

std::vector<Vec3> points_of(const GltfDocument& document, const Json& primitive, const std::string& place) {
    const std::vector<double> numbers = values_of(document, primitive.at("attributes").at("POSITION"),
                                                  {place + ": POSITION", "VEC3", GltfNumbers::any});
    std::vector<Vec3> point;
    point.reserve(numbers.size() / 3);
    for (std::size_t k = 0; k + 2 < numbers.size(); k += 3)
        point.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
    return point;
}

std::vector<std::string> joint_sets(const Json& attributes) {
    std::vector<std::string> sets;
    for (const auto& [name, accessor] : attributes.items())
        for (const std::string_view kind : {"JOINTS_", "WEIGHTS_"}) {
            if (!name.starts_with(kind)) continue;
            std::string set = name.substr(kind.size());
            if (!set.empty() && set.find_first_not_of("0123456789") == std::string::npos)
                sets.push_back(std::move(set));
        }
    std::sort(sets.begin(), sets.end(), [](const std::string& a, const std::string& b) {
        return std::pair(a.size(), std::string_view(a)) < std::pair(b.size(), std::string_view(b));
    });
    sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
    return sets;
}

} // namespace bough
