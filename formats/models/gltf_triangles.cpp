#include "envelope_mesh.h"
#include "gltf_accessor.h"
#include "gltf_faces.h"
#include "gltf_nodes.h"
#include "model_gltf.h"
#include <new>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

void add_mesh(const GltfDocument& document, std::size_t mesh, const Eigen::Affine3d& world, EnvelopeMesh& out) {
    const Json& primitives = document.json["meshes"][mesh].at("primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
        if (!primitives[p].at("attributes").contains("POSITION")) continue;
        const std::string place = primitive_place(mesh, p);
        const std::vector<Vec3> points = points_of(document, primitives[p], place);
        const GltfFaces faces = faces_of(document, primitives[p], place, points.size());
        if (faces.each != 3) continue;
        const auto first = std::int32_t(out.vertex.size());
        for (const Vec3& point : points) out.vertex.push_back(world * point);
        for (std::size_t k = 0; k + 2 < faces.corner.size(); k += 3)
            out.triangle.push_back({first + faces.corner[k], first + faces.corner[k + 1], first + faces.corner[k + 2]});
    }
}

} // namespace

EnvelopeMesh triangles_of_gltf(std::string_view content, const std::string& folder, const std::string& name) {
    EnvelopeMesh out;
    ImportNotes none;
    try {
        GltfDocument document = read_gltf(content, name, folder, GltfImages::leave, none);
        if (joints_of(document).mesh_encoded)
            throw InputError(name, "holds a mesh in Draco's form, which is not read here; save it without compression");
        const GltfNodes nodes = nodes_of(document.json, name);
        for (const std::size_t n : nodes_in_scene(document.json))
            if (const Json& node = document.json["nodes"][n]; node.contains("mesh"))
                add_mesh(document, node["mesh"].get<std::size_t>(), nodes.world[n], out);
    } catch (const std::bad_alloc&) {
        throw InputError(name, "what is in it needs more memory than there is");
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) { // a type that is wrong, an index beyond
        throw InputError(name, "is no glTF 2.0: " + std::string(error.what()));
    }
    return out;
}

} // namespace bough
