#include "formats/documents/document_parts.h"
#include "gltf_parts.h"
#include "influence.h"
#include <algorithm>
#include <limits>

namespace bough {
namespace {

Eigen::Vector3f placed(const Vec3& position, const Vec3& origin) {
    return (position - origin).cast<float>();
}

std::string position_bounds(const Skin& skin, const VertexStretch& used, const Vec3& origin) {
    Eigen::Vector3f low = placed(skin.position[std::size_t(used.first)], origin), high = low;
    for (std::size_t v = std::size_t(used.first); v <= std::size_t(used.last); ++v) {
        const Eigen::Vector3f p = placed(skin.position[v], origin);
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return gltf_bounds(low, high);
}

template <class Number> void write_joints(GltfBytes& to, const Skin& skin, const JointGroups& groups) {
    for (std::size_t v = 0; v < skin.position.size(); ++v)
        for (const std::int32_t joint : influence_of(skin, groups, v).joint) to.add(Number(joint));
}

// Over 65535, which they add up to: what rounding leaves goes to the largest.
std::array<std::uint16_t, 4> short_weights(const std::array<float, 4>& weights) {
    std::array<std::uint16_t, 4> shorts;
    long rest = 65535;
    for (std::size_t k = 0; k < 4; ++k) {
        shorts[k] = std::uint16_t(std::lround(65535 * weights[k]));
        rest -= shorts[k];
    }
    const auto largest = std::max_element(shorts.begin(), shorts.end());
    *largest = std::uint16_t(*largest + rest);
    return shorts;
}

struct VertexViews {
    int position, normal, texture, joint, weight;
    GltfType joint_type;
};

// Views over all vertices of the skin; the parts' accessors begin somewhere in them.
VertexViews add_vertex_views(GltfFile& file, const Skin& skin, const JointGroups& groups, const Vec3& origin) {
    const std::uint64_t n = skin.position.size();
    const bool small = groups.size() <= 256;
    VertexViews views{};
    views.joint_type = small ? GltfType::u8 : GltfType::u16;
    views.position = file.add_view(12 * n, GltfTarget::vertices, 12, [&skin, origin](GltfBytes& to) {
        for (const Vec3& position : skin.position) {
            const Eigen::Vector3f p = placed(position, origin);
            to.add_all(p.x(), p.y(), p.z());
        }
    });
    views.normal = file.add_view(12 * n, GltfTarget::vertices, 12, [&skin](GltfBytes& to) {
        for (const Vec3& normal : skin.normal) to.add_all(float(normal.x()), float(normal.y()), float(normal.z()));
    });
    views.texture = file.add_view(8 * n, GltfTarget::vertices, 8, [&skin](GltfBytes& to) {
        for (const auto& [u, v] : skin.texture) to.add_all(u, 1 - v); // counted from the top of an image
    });
    views.joint =
        file.add_view((small ? 4 : 8) * n, GltfTarget::vertices, small ? 4 : 8, [&skin, &groups, small](GltfBytes& to) {
            small ? write_joints<std::uint8_t>(to, skin, groups) : write_joints<std::uint16_t>(to, skin, groups);
        });
    views.weight = file.add_view(8 * n, GltfTarget::vertices, 8, [&skin, &groups](GltfBytes& to) {
        for (std::size_t v = 0; v < skin.position.size(); ++v)
            for (const std::uint16_t weight : short_weights(influence_of(skin, groups, v).weight)) to.add(weight);
    });
    return views;
}

template <class Number> void write_indices(GltfBytes& to, const Skin& skin, const SkinPart& part, std::int32_t first) {
    for (std::size_t t = part.first_index; t < part.first_index + part.index_count; ++t)
        for (const std::int32_t v : skin.triangle[t]) to.add(Number(v - first));
}

// Indices count from the part's first vertex; 65535 would be a mark in u16.
int add_indices(GltfFile& file, const Skin& skin, const SkinPart& part, const VertexStretch& used) {
    const bool small = used.count() <= 65535;
    const std::uint64_t count = 3 * std::uint64_t(part.index_count);
    const int view = file.add_view((small ? 2 : 4) * count, GltfTarget::indices, 0,
                                   [&skin, &part, first = used.first, small](GltfBytes& to) {
                                       small ? write_indices<std::uint16_t>(to, skin, part, first)
                                             : write_indices<std::uint32_t>(to, skin, part, first);
                                   });
    return file.add_accessor(view, 0, small ? GltfType::u16 : GltfType::u32, count, "SCALAR");
}

double linear(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

// How rough a surface looks; rough bark, waxy leaves, soft petals, smooth fruit.
double roughness(const std::string& part) {
    if (part == "leaf") return 0.6;
    if (part == "petal") return 0.75;
    if (part == "fruit") return 0.35;
    return 0.95;
}

} // namespace

VertexStretch vertices_of(const Skin& skin, const SkinPart& part) {
    VertexStretch used;
    for (std::size_t t = part.first_index; t < part.first_index + part.index_count; ++t)
        for (const std::int32_t v : skin.triangle[t]) {
            used.first = std::min(used.first, v);
            used.last = std::max(used.last, v);
        }
    return used;
}

std::vector<std::string> gltf_primitives(GltfFile& file, const Skin& skin, const JointGroups& groups,
                                         const Vec3& origin, const std::vector<std::string>& targets) {
    const VertexViews views = add_vertex_views(file, skin, groups, origin);
    std::vector<std::string> all;
    for (std::size_t m = 0; m < skin.part.size(); ++m) {
        const VertexStretch used = vertices_of(skin, skin.part[m]);
        const std::uint64_t first = std::uint64_t(used.first), n = used.count();
        const std::uint64_t joint_bytes = views.joint_type == GltfType::u8 ? 4 : 8;
        const auto accessor = [&](int view, std::uint64_t bytes, GltfType component, const char* type,
                                  const std::string& bounds = "") {
            return std::to_string(file.add_accessor(view, first * bytes, component, n, type, bounds));
        };
        const std::string bounds = position_bounds(skin, used, origin);
        std::string text =
            "{\"attributes\":{\"POSITION\":" + accessor(views.position, 12, GltfType::f32, "VEC3", bounds);
        text += ",\"NORMAL\":" + accessor(views.normal, 12, GltfType::f32, "VEC3");
        text += ",\"TEXCOORD_0\":" + accessor(views.texture, 8, GltfType::f32, "VEC2");
        text += ",\"JOINTS_0\":" + accessor(views.joint, joint_bytes, views.joint_type, "VEC4");
        text += ",\"WEIGHTS_0\":" + accessor(views.weight, 8, GltfType::u16, "VEC4", ",\"normalized\":true");
        text += "},\"indices\":" + std::to_string(add_indices(file, skin, skin.part[m], used)) +
                ",\"material\":" + std::to_string(m) + targets[m] + "}";
        all.push_back(std::move(text));
    }
    return all;
}

std::string gltf_material(const std::string& part, const Vec3& srgb) {
    std::string text = "{\"name\":";
    append_string(text, part);
    const Eigen::Vector4d color(linear(srgb[0]), linear(srgb[1]), linear(srgb[2]), 1);
    text += ",\"pbrMetallicRoughness\":{\"baseColorFactor\":" + gltf_list(color) +
            ",\"metallicFactor\":0,\"roughnessFactor\":";
    append_number(text, roughness(part));
    return text + (part == "leaf" || part == "petal" ? "},\"doubleSided\":true}" : "}}");
}

std::string gltf_materials(const Skin& skin) {
    std::string text;
    for (const SkinPart& part : skin.part) text += (text.empty() ? "" : ",\n") + gltf_material(part.name, part.color);
    return text;
}

} // namespace bough
