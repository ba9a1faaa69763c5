#include "float_range.h"
#include "formats/documents/document_parts.h"
#include "gltf_parts.h"
#include "skin_attributes.h"
#include "vat_parts.h"
#include <algorithm>

namespace bough {

namespace {

struct Writer {
    GltfFile& file;
    const ReducedSkin& mesh;
    const SkinAttributes& attributes;
    const Vec3 origin;
    const std::size_t height;

    // The columns of a part.
    struct Stretch {
        std::size_t first, count;
    };

    Eigen::Vector3f position_in_file(std::size_t column) const {
        return (mesh.skin.position[column] - origin).cast<float>();
    }

    // take(vertex of the skin, column, GltfBytes) adds `width` floats.
    template <class Take>
    std::string add_attribute(const Stretch& of, int width, Take take, const std::string& bounds = "") const {
        const int view = file.add_view(std::uint64_t(4 * width) * of.count, GltfTarget::vertices, 4 * width,
                                       [this, of, take](GltfBytes& to) {
                                           for (std::size_t c = of.first; c < of.first + of.count; ++c)
                                               take(std::size_t(mesh.vertex[c]), c, to);
                                       });
        const std::string type = "VEC" + std::to_string(width);
        return std::to_string(file.add_accessor(view, 0, GltfType::f32, of.count, type.c_str(), bounds));
    }

    std::string bounds_of(const Stretch& of) const {
        Eigen::Vector3f low = position_in_file(of.first), high = low;
        for (std::size_t c = of.first; c < of.first + of.count; ++c) {
            low = low.cwiseMin(position_in_file(c));
            high = high.cwiseMax(position_in_file(c));
        }
        return gltf_bounds(low, high);
    }

    std::string primitive(std::size_t m, std::int32_t material) const {
        const SkinPart& part = mesh.skin.part[m];
        const VertexStretch used = vertices_of(mesh.skin, part);
        const Stretch of{std::size_t(used.first), used.count()};
        std::string text = "{\"attributes\":{\"POSITION\":" + add_attribute(
                                                                  of, 3,
                                                                  [this](std::size_t, std::size_t c, GltfBytes& to) {
                                                                      const Eigen::Vector3f p = position_in_file(c);
                                                                      to.add_all(p.x(), p.y(), p.z());
                                                                  },
                                                                  bounds_of(of));
        text += ",\"NORMAL\":" + add_attribute(of, 3, [this](std::size_t, std::size_t c, GltfBytes& to) {
                    const Vec3& n = mesh.skin.normal[c];
                    to.add_all(float(n.x()), float(n.y()), float(n.z()));
                });
        for (std::size_t s = 0; s < attributes.uv.size(); ++s)
            text += ",\"TEXCOORD_" + std::to_string(s == 0 ? 0 : s + 1) +
                    "\":" + add_attribute(of, 2, [this, s](std::size_t v, std::size_t, GltfBytes& to) {
                        to.add_all(attributes.uv[s][v][0], attributes.uv[s][v][1]);
                    });
        text += ",\"TEXCOORD_1\":" + add_attribute(of, 2, [this](std::size_t, std::size_t c, GltfBytes& to) {
                    to.add_all(float((double(c) + 0.5) / double(mesh.vertex.size())), float(0.5 / double(height)));
                });
        if (!attributes.color.empty())
            text += ",\"COLOR_0\":" + add_attribute(of, 4, [this](std::size_t v, std::size_t, GltfBytes& to) {
                        for (const float c : attributes.color[v]) to.add(c);
                    });
        const int view = file.add_view(6 * part.index_count, GltfTarget::indices, 0, [this, &part, of](GltfBytes& to) {
            for (std::size_t t = part.first_index; t < part.first_index + part.index_count; ++t)
                for (const std::int32_t c : mesh.skin.triangle[t]) to.add(std::uint16_t(std::size_t(c) - of.first));
        });
        const int indices = file.add_accessor(view, 0, GltfType::u16, 3 * part.index_count, "SCALAR");
        return text + "},\"indices\":" + std::to_string(indices) +
               (material < 0 ? "" : ",\"material\":" + std::to_string(material)) + "}";
    }
};

} // namespace

void write_vat_mesh(Output& output, const std::string& name, const ReducedSkin& mesh, const VatLook& look,
                    std::size_t height, const VatOptions& options) {
    GltfFile file;
    const Skin& skin = *look.skin;
    const OwnMesh* const own = look.own;
    const SkinAttributes attributes = attributes_of(skin, own);
    const Vec3 origin = floats_suffice(mesh.skin.position) ? Vec3(Vec3::Zero()) : mesh.skin.position[0];
    const Writer writer{file, mesh, attributes, origin, height};
    std::string primitives;
    for (std::size_t m = 0; m < mesh.skin.part.size(); ++m)
        if (mesh.skin.part[m].index_count > 0)
            primitives +=
                (primitives.empty() ? "" : ",\n") + writer.primitive(m, own ? own->part[m].material : std::int32_t(m));
    std::string materials = own ? own->material.empty() ? "" : gltf_own_materials(file, *own)
                                : "\"materials\":[\n" + gltf_materials(skin) + "]";
    if (!materials.empty()) materials += ",\n";
    std::string quoted;
    append_string(quoted, name);
    std::string node = "{\"name\":" + quoted + ",\"mesh\":0";
    if (!origin.isZero(0)) node += ",\"translation\":" + gltf_list(origin);
    file.write(output, gltf_asset(options.generator, options.source) +
                           ",\n\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\n\"nodes\":[" + node + "}],\n" + materials +
                           "\"meshes\":[{\"name\":" + quoted + ",\"primitives\":[\n" + primitives + "]}]");
}

} // namespace bough
