#include "formats/documents/document_parts.h"
#include "gltf_parts.h"
#include "own_mesh.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

struct Look { // what all vertices of a part have
    std::size_t uv = 0;
    bool color = false, bytes = true; // bytes: all colours within 0..1
    bool tangent = false;             // all have one, and a normal map to take it
};

Look look_of(const OwnMesh& mesh, const OwnPart& part) {
    Look look;
    look.tangent = part.material >= 0 && std::size_t(part.material) < mesh.material.size() &&
                   mesh.material[std::size_t(part.material)].find("\"normalTexture\"") != std::string::npos;
    const auto add = [&](const OwnSurface& s) {
        look.tangent &= s.tangent.size() == s.position.size();
        look.uv = std::max(look.uv, s.uv.size());
        look.color |= !s.color.empty();
        for (const auto& color : s.color)
            for (const float c : color) look.bytes &= c >= 0 && c <= 1;
    };
    add(part.standing);
    std::int32_t last = -1; // places of one shape mostly follow each other
    for (const OwnPlace& place : part.placed)
        if (place.shape != last) add(mesh.shape[std::size_t(last = place.shape)]);
    return look;
}

std::string bounds_of(const OwnMesh& mesh, const OwnPart& part, const Eigen::Vector3f& origin) {
    Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::infinity()), high = -low;
    each_vertex(mesh, part, [&](const OwnSurface& from, std::size_t v, const OwnPlace* place) {
        const Eigen::Vector3f p = position_of(from, v, place) - origin;
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    });
    return gltf_bounds(low, high);
}

// A vertex's two groups and the second's weight, which is 0 where they are one.
struct TwoGroups {
    std::int32_t first, other;
    float second;
};

TwoGroups groups_of(const OwnPart& part, const JointGroups& groups, const OwnSurface& from, std::size_t v,
                    const OwnPlace* place) {
    const OwnShare share = share_of(part, from, v, place);
    const std::int32_t a = groups.group[std::size_t(share.first)], b = groups.group[std::size_t(share.second)];
    if (a == b || share.weight <= 0) return {a, 0, 0};
    if (share.weight >= 1) return {b, 0, 0};
    return {a, b, share.weight};
}

template <class Number>
void write_own_joints(GltfBytes& to, const OwnMesh& mesh, const OwnPart& part, const JointGroups& groups) {
    each_vertex(mesh, part, [&](const OwnSurface& from, std::size_t v, const OwnPlace* place) {
        const TwoGroups two = groups_of(part, groups, from, v, place);
        to.add_all(Number(two.first), Number(two.other), Number(0), Number(0));
    });
}

template <class Number> void write_own_indices(GltfBytes& to, const OwnMesh& mesh, const OwnPart& part) {
    std::size_t base = 0;
    const auto add = [&](const OwnSurface& from) {
        for (const auto& [a, b, c] : from.triangle)
            to.add_all(Number(base + std::size_t(a)), Number(base + std::size_t(b)), Number(base + std::size_t(c)));
        base += from.position.size();
    };
    add(part.standing);
    for (const OwnPlace& place : part.placed) add(mesh.shape[std::size_t(place.shape)]);
}

std::string add_colors(GltfFile& file, const OwnMesh& mesh, const OwnPart& part, const Look& look, std::size_t n) {
    const auto color_of = [](const OwnSurface& from, std::size_t v) {
        return from.color.empty() ? std::array<float, 4>{1, 1, 1, 1} : from.color[v];
    };
    const int stride = look.bytes ? 8 : 16;
    const int view = file.add_view(
        std::uint64_t(stride) * n, GltfTarget::vertices, stride, [&mesh, &part, look, color_of](GltfBytes& to) {
            each_vertex(mesh, part, [&](const OwnSurface& from, std::size_t v, const OwnPlace*) {
                for (const float c : color_of(from, v)) {
                    if (look.bytes)
                        to.add(std::uint16_t(std::lround(c * 65535)));
                    else
                        to.add(c);
                }
            });
        });
    return std::to_string(file.add_accessor(view, 0, look.bytes ? GltfType::u16 : GltfType::f32, n, "VEC4",
                                            look.bytes ? ",\"normalized\":true" : ""));
}

std::string primitive(GltfFile& file, const OwnMesh& mesh, const OwnPart& part, const JointGroups& groups,
                      const Eigen::Vector3f& origin) {
    const std::size_t n = vertices_of(mesh, part);
    const Look look = look_of(mesh, part);
    const auto add = [&](std::uint64_t bytes, GltfType type, const char* width, GltfFile::Write write,
                         const std::string& bounds = "") {
        const int view = file.add_view(bytes * n, GltfTarget::vertices, int(bytes), std::move(write));
        return std::to_string(file.add_accessor(view, 0, type, n, width, bounds));
    };
    std::string text =
        "{\"attributes\":{\"POSITION\":" +
        add(
            12, GltfType::f32, "VEC3",
            [&mesh, &part, origin](GltfBytes& to) {
                each_vertex(mesh, part, [&](const OwnSurface& from, std::size_t v, const OwnPlace* place) {
                    const Eigen::Vector3f p = position_of(from, v, place) - origin;
                    to.add_all(p.x(), p.y(), p.z());
                });
            },
            bounds_of(mesh, part, origin));
    text += ",\"NORMAL\":" + add(12, GltfType::f32, "VEC3", [&mesh, &part](GltfBytes& to) {
                each_vertex(mesh, part, [&](const OwnSurface& from, std::size_t v, const OwnPlace* place) {
                    const Eigen::Vector3f p = normal_of(from, v, place);
                    to.add_all(p.x(), p.y(), p.z());
                });
            });
    if (look.tangent)
        text += ",\"TANGENT\":" + add(16, GltfType::f32, "VEC4", [&mesh, &part](GltfBytes& to) {
                    each_vertex(mesh, part, [&](const OwnSurface& from, std::size_t v, const OwnPlace* place) {
                        for (const float t : tangent_of(from, v, place)) to.add(t);
                    });
                });
    for (std::size_t s = 0; s < look.uv; ++s)
        text += ",\"TEXCOORD_" + std::to_string(s) +
                "\":" + add(8, GltfType::f32, "VEC2", [&mesh, &part, s](GltfBytes& to) {
                    each_vertex(mesh, part, [&](const OwnSurface& from, std::size_t v, const OwnPlace*) {
                        const std::array<float, 2> uv = s < from.uv.size() ? from.uv[s][v] : std::array<float, 2>{0, 0};
                        to.add_all(uv[0], uv[1]);
                    });
                });
    if (look.color) text += ",\"COLOR_0\":" + add_colors(file, mesh, part, look, n);
    const bool small = groups.size() <= 256;
    text += ",\"JOINTS_0\":" + add(small ? 4 : 8, small ? GltfType::u8 : GltfType::u16, "VEC4",
                                   [&mesh, &part, &groups, small](GltfBytes& to) {
                                       small ? write_own_joints<std::uint8_t>(to, mesh, part, groups)
                                             : write_own_joints<std::uint16_t>(to, mesh, part, groups);
                                   });
    // Shares of 65535, which sum to it.
    text += ",\"WEIGHTS_0\":" +
            add(
                8, GltfType::u16, "VEC4",
                [&mesh, &part, &groups](GltfBytes& to) {
                    each_vertex(mesh, part, [&](const OwnSurface& from, std::size_t v, const OwnPlace* place) {
                        const float share = groups_of(part, groups, from, v, place).second;
                        // Of two joints neither is left with nothing.
                        const auto second =
                            std::uint16_t(share > 0 ? std::clamp(std::lround(65535 * share), 1L, 65534L) : 0);
                        to.add_all(std::uint16_t(65535 - second), second, std::uint16_t(0), std::uint16_t(0));
                    });
                },
                ",\"normalized\":true");
    const std::uint64_t count = 3 * std::uint64_t(triangles_of(mesh, part));
    const bool short_index = n <= 65535;
    const int view = file.add_view((short_index ? 2 : 4) * count, GltfTarget::indices, 0,
                                   [&mesh, &part, short_index](GltfBytes& to) {
                                       short_index ? write_own_indices<std::uint16_t>(to, mesh, part)
                                                   : write_own_indices<std::uint32_t>(to, mesh, part);
                                   });
    const int indices = file.add_accessor(view, 0, short_index ? GltfType::u16 : GltfType::u32, count, "SCALAR");
    return text + "},\"indices\":" + std::to_string(indices) + ",\"material\":" + std::to_string(part.material) + "}";
}

} // namespace

std::string gltf_own_mesh(GltfFile& file, const OwnMesh& mesh, const JointGroups& groups, const Vec3& origin) {
    std::string text;
    for (const OwnPart& part : mesh.part)
        text += (text.empty() ? "" : ",\n") + primitive(file, mesh, part, groups, origin.cast<float>());
    return "{\"name\":\"mesh\",\"primitives\":[\n" + text + "]}";
}

std::string gltf_own_materials(GltfFile& file, const OwnMesh& mesh) {
    std::string materials, images, textures;
    for (const std::string& material : mesh.material) materials += (materials.empty() ? "" : ",\n") + material;
    for (std::size_t i = 0; i < mesh.image.size(); ++i) {
        const OwnImage& image = mesh.image[i];
        const int view = file.add_view(image.bytes.size(), GltfTarget::none, 0, [&image](GltfBytes& to) {
            for (const char c : image.bytes) to.add(c);
        });
        images += std::string(i > 0 ? "," : "") + "{\"name\":";
        append_string(images, image.name);
        images += ",\"mimeType\":\"" + image.type + "\",\"bufferView\":" + std::to_string(view) + "}";
        textures += std::string(i > 0 ? "," : "") + "{\"sampler\":0,\"source\":" + std::to_string(i) + "}";
    }
    std::string text = "\"materials\":[\n" + materials + "]";
    if (images.empty()) return text;
    // Bark is tiled; blurred from afar.
    return text +
           ",\n\"samplers\":[{\"magFilter\":9729,\"minFilter\":9987,\"wrapS\":10497,\"wrapT\":10497}],\n\"textures\":"
           "[" +
           textures + "],\n\"images\":[" + images + "]";
}

} // namespace bough
