#include "gltf_parts.h"
#include <algorithm>
#include <memory>

namespace bough {
namespace {

// Changes of the positions and normals of a stretch of vertices with one target's weight.
struct Changes {
    std::vector<float> position, normal;
};

Changes changes_of(const Skin& skin, const VertexStretch& used, const Rustle& rustle, std::size_t target) {
    Changes made;
    made.position.assign(3 * used.count(), 0.0F);
    made.normal = made.position;
    for (std::size_t k = 0; k < skin.clump_leaf.size(); ++k) {
        const Vec3 axis = rustle.target(k, target), foot = rustle.foot(k);
        const auto first = std::size_t(skin.clump_leaf[k]);
        for (std::size_t v = first; v < first + leaf_vertices; ++v) {
            const Eigen::Vector3f moved = axis.cross(skin.position[v] - foot).cast<float>();
            const Eigen::Vector3f turned = axis.cross(skin.normal[v]).cast<float>();
            const std::size_t at = 3 * (v - std::size_t(used.first));
            std::copy_n(moved.data(), 3, made.position.begin() + std::ptrdiff_t(at));
            std::copy_n(turned.data(), 3, made.normal.begin() + std::ptrdiff_t(at));
        }
    }
    return made;
}

std::string bounds_of(const std::vector<float>& vectors) {
    Eigen::Vector3f low(vectors[0], vectors[1], vectors[2]), high = low;
    for (std::size_t k = 0; k < vectors.size(); k += 3) {
        const Eigen::Map<const Eigen::Vector3f> v(vectors.data() + k);
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
    }
    return gltf_bounds(low, high);
}

} // namespace

std::string gltf_targets(GltfFile& file, const Skin& skin, const SkinPart& part, const Rustle& rustle) {
    const VertexStretch used = vertices_of(skin, part);
    std::string text = ",\"targets\":[";
    for (std::size_t m = 0; m < Rustle::targets; ++m) {
        const auto changes = std::make_shared<const Changes>(changes_of(skin, used, rustle, m));
        const auto accessor = [&](const std::vector<float> Changes::*array, const std::string& bounds) {
            const int view =
                file.add_view(12 * used.count(), GltfTarget::vertices, 12, [changes, array](GltfBytes& to) {
                    for (const float x : (*changes).*array) to.add(x);
                });
            return std::to_string(file.add_accessor(view, 0, GltfType::f32, used.count(), "VEC3", bounds));
        };
        text += m == 0 ? "{\"POSITION\":" : ",{\"POSITION\":";
        text += accessor(&Changes::position, bounds_of(changes->position));
        text += ",\"NORMAL\":" + accessor(&Changes::normal, "") + "}";
    }
    return text + "]";
}

std::string gltf_target_weights() {
    std::string names, weights;
    for (std::size_t m = 0; m < Rustle::targets; ++m) {
        names += (m == 0 ? "\"rustle " : ",\"rustle ") + std::to_string(m + 1) + "\"";
        weights += m == 0 ? "0" : ",0";
    }
    return "\"weights\":[" + weights + "],\"extras\":{\"targetNames\":[" + names + "]}";
}

} // namespace bough
