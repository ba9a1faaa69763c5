#include "driven_surface.h"
#include "gltf_accessor.h"
#include "gltf_check.h"
#include "gltf_faces.h"
#include "gltf_nodes.h"
#include "lib/base/counted.h"
#include "model_gltf.h"
#include "user_model.h"
#include <algorithm>
#include <limits>
#include <map>
#include <new>
#include <tuple>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

// A primitive as the file has it.
struct Primitive {
    struct Share {
        std::size_t vertex, joint;
        float weight;
    };
    std::vector<Eigen::Vector3f> position, normal;
    std::vector<std::array<float, 2>> uv;
    std::vector<std::array<std::int32_t, 3>> triangle;
    std::vector<Share> share; // sorted by vertex
};

// A primitive where a node shows it.
struct Shown {
    std::size_t material, mesh, primitive, node; // material: in the order of parts
};

class Reader {
public:
    Reader(const GltfDocument& document, std::vector<std::string>& notes)
        : document_(document), json_(document.json), notes_(notes) {}

    DrivenSurface read() {
        std::vector<std::int32_t> materials;
        std::vector<Shown> shown = shown_in_scene(materials);
        std::stable_sort(shown.begin(), shown.end(), [](const Shown& a, const Shown& b) {
            return std::tie(a.material, a.mesh, a.primitive) < std::tie(b.material, b.mesh, b.primitive);
        });
        add_looks(document_, materials, out_.look, notes_);
        Primitive primitive;
        const Shown* before = nullptr;
        for (const Shown& s : shown) {
            if (!before || before->material != s.material)
                out_.part.push_back(
                    {out_.look.part[s.material].name, out_.look.part[s.material].color, out_.triangle.size(), 0});
            // Nodes that show one primitive follow each other: it is read once.
            if (!before || before->mesh != s.mesh || before->primitive != s.primitive)
                primitive = read_primitive(s, map_place_of(document_, materials[s.material]));
            add(primitive, json_["nodes"][s.node], s.node);
            out_.part.back().index_count = out_.triangle.size() - out_.part.back().first_index;
            before = &s;
        }
        if (entries_of(json_, "animations") > 0)
            notes_.push_back(
                counted(entries_of(json_, "animations"), "animation of its own is", "animations of its own are") +
                " not shown: the tree moves it");
        if (colors_) notes_.push_back("colours of vertices are not shown");
        if (more_sets_)
            notes_.push_back("of several sets of texture coordinates that of each material's colours is shown alone");
        if (morphs_) notes_.push_back("morph targets are not shown: the mesh keeps its own shape under its bones");
        return std::move(out_);
    }

private:
    std::vector<Shown> shown_in_scene(std::vector<std::int32_t>& materials) {
        std::vector<Shown> shown;
        for (const std::size_t n : nodes_in_scene(json_)) {
            const Json& node = json_["nodes"][n];
            if (!node.contains("mesh")) continue;
            if (node.contains("extensions") && node["extensions"].contains("EXT_mesh_gpu_instancing")) {
                ++instanced_; // where the node itself is, none of them need stand
                continue;
            }
            const std::size_t mesh = index_of(node, "mesh", "a node", entries_of(json_, "meshes"));
            const Json& primitives = json_["meshes"][mesh].at("primitives");
            for (std::size_t p = 0; p < primitives.size(); ++p) {
                const Json& primitive = primitives[p];
                if (!primitive.at("attributes").contains("POSITION") ||
                    whole_number(primitive, "mode", primitive_place(mesh, p), 4) < 4)
                    continue; // lines and points
                const std::int32_t material =
                    primitive.contains("material") ? primitive["material"].get<std::int32_t>() : -1;
                const auto found = std::find(materials.begin(), materials.end(), material);
                shown.push_back({std::size_t(found - materials.begin()), mesh, p, n});
                if (found == materials.end()) materials.push_back(material);
            }
        }
        if (instanced_ > 0)
            notes_.push_back(counted(instanced_, "node's instances are", "nodes' instances are") +
                             " not shown (EXT_mesh_gpu_instancing)");
        return shown;
    }

    // Numbers of an attribute, `width` for each vertex.
    std::vector<double> numbers(const Json& accessor, const std::string& place, const char* type, GltfNumbers of,
                                std::size_t width, std::size_t vertices) {
        std::vector<double> values = values_of(document_, accessor, {place, type, of});
        if (values.size() != width * vertices)
            throw std::out_of_range(place + " has " + counted(values.size() / width, "element", "elements") +
                                    ", expected one for each of " + counted(vertices, "vertex", "vertices"));
        return values;
    }

    Primitive read_primitive(const Shown& s, const MapPlace& map) {
        const Json& from = json_["meshes"][s.mesh]["primitives"][s.primitive];
        const Json& attributes = from["attributes"];
        const std::string place = primitive_place(s.mesh, s.primitive);
        colors_ = colors_ || attributes.contains("COLOR_0");
        const std::string set = "TEXCOORD_" + std::to_string(map.set);
        for (const auto& [name, accessor] : attributes.items())
            more_sets_ = more_sets_ || (name.starts_with("TEXCOORD_") && name != set);
        morphs_ = morphs_ || !from.value("targets", Json::array()).empty();
        std::vector<Vec3> point = points_of(document_, from, place);
        const std::size_t n = point.size();
        const GltfFaces faces = faces_of(document_, from, place, n);
        std::vector<Vec3> normal(n, Vec3::Zero());
        const bool has_normals = attributes.contains("NORMAL");
        if (has_normals) {
            const std::vector<double> given =
                numbers(attributes["NORMAL"], place + ": NORMAL", "VEC3", GltfNumbers::any, 3, n);
            for (std::size_t v = 0; v < n; ++v) normal[v] = {given[3 * v], given[3 * v + 1], given[3 * v + 2]};
        }
        std::vector<double> uv(2 * n, 0);
        if (attributes.contains(set)) uv = numbers(attributes[set], place + ": " + set, "VEC2", GltfNumbers::any, 2, n);
        std::vector<std::int32_t> taken(n, -1);
        for (std::size_t k = 0; k + 2 < faces.corner.size(); k += 3) {
            const std::int32_t* const c = &faces.corner[k];
            if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue; // a strip's turn
            for (int j = 0; j < 3; ++j) taken.at(std::size_t(c[j])) = 0;
            if (has_normals) continue;
            const Vec3& a = point[std::size_t(c[0])];
            const Vec3 twice_area = (point[std::size_t(c[1])] - a).cross(point[std::size_t(c[2])] - a);
            for (int j = 0; j < 3; ++j) normal[std::size_t(c[j])] += twice_area;
        }
        Primitive made;
        for (std::size_t v = 0; v < n; ++v) {
            if (taken[v] < 0) continue;
            taken[v] = std::int32_t(made.position.size());
            made.position.push_back(point[v].cast<float>());
            made.normal.push_back(normal[v].normalized().cast<float>());
            const Eigen::Vector2d at = map.at + map.turn * Eigen::Vector2d(uv[2 * v], uv[2 * v + 1]);
            if (!(at.array().abs() < double(std::numeric_limits<float>::max())).all()) // by KHR_texture_transform
                throw std::out_of_range(place + ": " + set + " of vertex " + std::to_string(v) +
                                        " is moved beyond any float by its texture");
            made.uv.push_back({float(at[0]), float(1 - at[1])});
        }
        for (std::size_t k = 0; k + 2 < faces.corner.size(); k += 3) {
            const std::int32_t* const c = &faces.corner[k];
            if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
            made.triangle.push_back({taken[std::size_t(c[0])], taken[std::size_t(c[1])], taken[std::size_t(c[2])]});
        }
        read_shares(attributes, place, taken, made);
        return made;
    }

    void read_shares(const Json& attributes, const std::string& place, const std::vector<std::int32_t>& taken,
                     Primitive& made) {
        for (const std::string& set : joint_sets(attributes)) {
            const std::string joints = "JOINTS_" + set, weights = "WEIGHTS_" + set;
            const std::vector<double> joint = numbers(attributes.at(joints), place + ": " + joints, "VEC4",
                                                      GltfNumbers::joints, 4, taken.size()),
                                      weight = numbers(attributes.at(weights), place + ": " + weights, "VEC4",
                                                       GltfNumbers::weights, 4, taken.size());
            for (std::size_t k = 0; k < weight.size(); ++k)
                if (taken[k / 4] >= 0 && weight[k] > 0)
                    made.share.push_back({std::size_t(taken[k / 4]), std::size_t(joint[k]), float(weight[k])});
        }
        std::stable_sort(made.share.begin(), made.share.end(),
                         [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
    }

    // The first of a skin's matrices, one for each of its joints.
    std::int32_t matrices_of(std::size_t skin) {
        const auto [known, fresh] = skin_.try_emplace(skin, std::int32_t(out_.matrix.size()));
        if (!fresh) return known->second;
        const Json& of = json_["skins"][skin];
        const std::vector<double> binds =
            values_of(document_, of.at("inverseBindMatrices"),
                      {"skin " + std::to_string(skin) + ": inverseBindMatrices", "MAT4", GltfNumbers::floats});
        for (std::size_t k = 0; k < of.at("joints").size(); ++k) {
            DrivenSurface::Matrix matrix;
            matrix.set = sets_;
            matrix.node = std::int32_t(checked_index(of["joints"][k], "a joint", entries_of(json_, "nodes")));
            matrix.bind.matrix() = Eigen::Map<const Eigen::Matrix4d>(&binds.at(16 * k + 15) - 15);
            matrix.bind.makeAffine();
            out_.matrix.push_back(matrix);
        }
        ++sets_;
        return known->second;
    }

    std::int32_t matrix_of(std::size_t node) {
        const auto [known, fresh] = hung_.try_emplace(node, std::int32_t(out_.matrix.size()));
        if (fresh) out_.matrix.push_back({std::int32_t(node), sets_++, Eigen::Affine3d::Identity()});
        return known->second;
    }

    void add(const Primitive& from, const Json& node, std::size_t number) {
        const std::size_t base = out_.position.size(), n = from.position.size();
        if (base + n > std::size_t(std::numeric_limits<std::int32_t>::max()))
            throw std::length_error("its mesh has more than 2^31 - 1 vertices");
        out_.position.insert(out_.position.end(), from.position.begin(), from.position.end());
        out_.normal.insert(out_.normal.end(), from.normal.begin(), from.normal.end());
        out_.uv.insert(out_.uv.end(), from.uv.begin(), from.uv.end());
        for (const auto& [a, b, c] : from.triangle) {
            const auto first = std::int32_t(base);
            out_.triangle.push_back({first + a, first + b, first + c});
        }
        std::int32_t first = 0;
        std::size_t joints = 0, at = 0;
        if (node.contains("skin")) {
            const std::size_t skin = index_of(node, "skin", "a node", entries_of(json_, "skins"));
            first = matrices_of(skin);
            joints = json_["skins"][skin]["joints"].size();
        }
        for (std::size_t v = 0; v < n; ++v) {
            const std::size_t before = out_.share.size();
            for (; at < from.share.size() && from.share[at].vertex == v; ++at) {
                if (!node.contains("skin")) continue;
                if (from.share[at].joint >= joints) throw std::out_of_range("a joint is beyond its skin's");
                out_.share.push_back({first + std::int32_t(from.share[at].joint), from.share[at].weight});
            }
            if (out_.share.size() == before) out_.share.push_back({matrix_of(number), 1});
            out_.first_share.push_back(out_.share.size());
        }
    }

    const GltfDocument& document_;
    const Json& json_;
    std::vector<std::string>& notes_;
    DrivenSurface out_;
    std::map<std::size_t, std::int32_t> skin_, hung_; // first matrix of a skin, matrix of a node
    std::int32_t sets_ = 0;                           // of matrices
    std::size_t instanced_ = 0;
    bool colors_ = false, more_sets_ = false, morphs_ = false;
};

} // namespace

DrivenSurface surface_of(GltfDocument& document, const std::string& name, std::vector<std::string>& notes) {
    std::vector<std::string> found;
    DrivenSurface surface;
    try {
        if (joints_of(document).mesh_encoded)
            throw InputError(name, "holds a mesh in Draco's form, which is not read here; save it without compression");
        surface = Reader(document, found).read();
    } catch (const std::bad_alloc&) {
        throw; // not the file's fault
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) { // a type that is wrong, an index beyond
        throw InputError(name, "is no glTF 2.0: " + std::string(error.what()));
    }
    if (surface.triangle.empty()) throw NoSkinnedMesh(name, "has no triangles in its scene, expected a mesh");
    for (const std::string& note : found) notes.push_back(name + ": " + note);
    return surface;
}

} // namespace bough
