#include "gltf_parts.h"
#include "usda_parts.h"
#include <algorithm>

namespace bough {
namespace {

constexpr int in_mesh = 2;

void add_vertex_interpolation(Text& text, const std::string& more = "") {
    if (!more.empty()) usda_line(text, in_mesh + 1, more);
    usda_line(text, in_mesh + 1, "interpolation = \"vertex\"");
    usda_line(text, in_mesh, ")");
}

} // namespace

void usda_meshes(Text& text, const std::string& root, const std::vector<std::string>& name, const RigMesh& mesh,
                 const std::vector<OwnLook>& look, const Vec3& origin) {
    const Skin& skin = mesh.skin;
    const SkinAttributes& attributes = mesh.attributes;
    for (std::size_t m = 0; m < skin.part.size(); ++m) {
        const SkinPart& part = skin.part[m];
        const VertexStretch used = vertices_of(skin, part);
        const std::size_t first = std::size_t(used.first), count = used.count();
        const auto at = [&](std::size_t i) {
            return Eigen::Vector3f((skin.position[first + i] - origin).cast<float>());
        };
        // How many joints move a vertex: alike for all in a mesh.
        std::size_t width = 1;
        for (std::size_t v = first; v < first + count; ++v)
            width = std::max(width, mesh.first_share[v + 1] - mesh.first_share[v]);
        const auto share = [&](std::size_t i) {
            const std::size_t v = first + i / width, k = mesh.first_share[v] + i % width;
            return k < mesh.first_share[v + 1] ? mesh.share[k] : RigMesh::Share{0, 0};
        };
        text.end_line();
        usda_line(text, 1, "def Mesh \"" + name[m] + "\" (");
        usda_line(text, in_mesh, "prepend apiSchemas = [\"MaterialBindingAPI\", \"SkelBindingAPI\"]");
        usda_line(text, 1, ")");
        usda_line(text, 1, "{");
        if (look[m].two_sided) usda_line(text, in_mesh, "uniform bool doubleSided = 1");
        Eigen::Vector3f low = at(0), high = low;
        for (std::size_t i = 0; i < count; ++i) {
            low = low.cwiseMin(at(i));
            high = high.cwiseMax(at(i));
        }
        usda_array(text, in_mesh, "float3[] extent = ", 2,
                   [&](Text& to, std::size_t i) { usda_tuple(to, i == 0 ? low : high); });
        usda_array(text, in_mesh, "int[] faceVertexCounts = ", part.index_count,
                   [](Text& to, std::size_t) { to.put('3'); });
        usda_array(text, in_mesh, "int[] faceVertexIndices = ", 3 * part.index_count, [&](Text& to, std::size_t i) {
            to.add_number(skin.triangle[part.first_index + i / 3][i % 3] - used.first);
        });
        usda_array(
            text, in_mesh, "normal3f[] normals = ", count,
            [&](Text& to, std::size_t i) { usda_tuple(to, Eigen::Vector3f(skin.normal[first + i].cast<float>())); },
            " (");
        add_vertex_interpolation(text);
        usda_array(text, in_mesh, "point3f[] points = ", count,
                   [&](Text& to, std::size_t i) { usda_tuple(to, at(i)); });
        for (std::size_t s = 0; s < attributes.uv.size(); ++s) {
            usda_array(
                text, in_mesh, "texCoord2f[] primvars:st" + (s > 0 ? std::to_string(s) : "") + " = ", count,
                [&](Text& to, std::size_t i) {
                    const auto& [u, v] = attributes.uv[s][first + i];
                    usda_tuple(to, Eigen::Vector2f(u, 1 - v)); // counted from the bottom of an image
                },
                " (");
            add_vertex_interpolation(text);
        }
        if (!attributes.color.empty()) {
            usda_array(
                text, in_mesh, "color4f[] primvars:vertexColor = ", count,
                [&](Text& to, std::size_t i) { usda_tuple(to, attributes.color[first + i]); }, " (");
            add_vertex_interpolation(text);
        }
        const std::string size = "elementSize = " + std::to_string(width);
        usda_array(
            text, in_mesh, "int[] primvars:skel:jointIndices = ", width * count,
            [&](Text& to, std::size_t i) { to.add_number(share(i).joint); }, " (");
        add_vertex_interpolation(text, size);
        usda_array(
            text, in_mesh, "float[] primvars:skel:jointWeights = ", width * count,
            [&](Text& to, std::size_t i) { to.add_number(share(i).weight); }, " (");
        add_vertex_interpolation(text, size);
        usda_line(
            text, in_mesh,
            "matrix4d primvars:skel:geomBindTransform = ( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1) )");
        usda_line(text, in_mesh, "uniform token subdivisionScheme = \"none\"");
        usda_line(text, in_mesh, "rel material:binding = <" + root + "/materials/" + name[m] + ">");
        usda_line(text, in_mesh, "rel skel:skeleton = <" + root + "/skeleton>");
        usda_line(text, 1, "}");
    }
}

} // namespace bough
