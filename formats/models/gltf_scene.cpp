#include "formats/error.h"
#include "formats/plain_text.h"
#include "gltf_accessor.h"
#include "gltf_faces.h"
#include "gltf_nodes.h"
#include "lib/base/counted.h"
#include "model_gltf.h"
#include "model_scene.h"
#include <algorithm>
#include <limits>
#include <new>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

// What times a custom attribute of lines is a radius; 0: it is none.
double radius_factor(std::string_view attribute) {
    const std::string name = lower_case(attribute);
    if (name == "_radius") return 1;
    return name == "_diameter" || name == "_width" || name == "_thickness" ? 0.5 : 0;
}

class SceneReader {
public:
    SceneReader(const GltfDocument& document, const GltfJoints& joints, const GltfNodes& nodes, ModelScene& out)
        : document_(document), json_(document.json), joints_(joints), nodes_(nodes), out_(out) {}

    void read() {
        read_nodes();
        std::vector<char> seen(entries_of(json_, "meshes"), false);
        for (std::size_t i = 0; i < out_.index.size(); ++i) {
            const Json& node = json_["nodes"][std::size_t(out_.index[i])];
            if (!node.contains("mesh")) continue;
            const std::size_t mesh = index_of(node, "mesh", "a node", seen.size());
            for (std::size_t p = 0; p < json_["meshes"][mesh].at("primitives").size(); ++p)
                read_primitive(mesh, p, node, out_.index[i], !seen[mesh]);
            seen[mesh] = true;
        }
        std::vector<Vec3>& by_node = out_.vertex_by_node;
        constexpr double rounding = 1e-5; // of single precision
        bool apart = false;
        for (std::size_t v = 0; v < by_node.size(); ++v)
            apart = apart || (by_node[v] - out_.vertex[v]).norm() > rounding * (1 + out_.vertex[v].norm());
        if (!apart) by_node = {};
    }

private:
    const Eigen::Affine3d& world(std::int32_t node) const { return nodes_.world[std::size_t(node)]; }

    void read_nodes() {
        self_.assign(nodes_.parent.size(), -1);
        for (const std::size_t n : nodes_in_scene(json_)) add_node(n);
    }

    void add_node(std::size_t n) {
        const std::int32_t parent = nodes_.parent[n];
        self_[n] = std::int32_t(out_.parent.size());
        out_.parent.push_back(parent < 0 ? -1 : self_[std::size_t(parent)]);
        out_.name.push_back(joints_.name[n]);
        out_.index.push_back(std::int32_t(n));
        out_.role.push_back(joints_.joint[n]                     ? NodeRole::joint
                            : json_["nodes"][n].contains("mesh") ? NodeRole::holder
                                                                 : NodeRole::open);
        out_.place.push_back(nodes_.world[n].translation());
        Mat3 axes = nodes_.world[n].linear();
        for (int k = 0; k < 3; ++k) axes.col(k).normalize();
        out_.axes.push_back(axes);
        out_.tip.push_back(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
        if (joints_.own.rods.empty() || !joints_.own.ours[n]) return;
        // What our own file says of a joint.
        const std::vector<OwnRod>& rods = joints_.own.rods[n];
        if (rods.empty()) out_.role.back() = NodeRole::holder;
        for (const OwnRod& rod : rods) {
            out_.own_rod.push_back(in_world(rod, nodes_.world[n]));
            const OwnRod& at = out_.own_rod.back();
            if (rod[0] == rods.front()[0]) out_.tip.back() = {at[6], at[7], at[8]};
        }
    }

    void read_primitive(std::size_t mesh, std::size_t number, const Json& node, std::int32_t self, bool first_time) {
        const Json& primitive = json_["meshes"][mesh]["primitives"][number];
        const Json& attributes = primitive.at("attributes");
        if (!attributes.contains("POSITION")) return;
        const std::string place = primitive_place(mesh, number);
        const bool skinned = node.contains("skin") && attributes.contains("JOINTS_0");
        if (skinned && !first_time) return;
        const std::vector<Vec3> point = points_of(document_, primitive, place);
        const GltfFaces faces = faces_of(document_, primitive, place, point.size());
        if (faces.each == 3) out_.triangles += std::int64_t(faces.corner.size() / 3);
        std::vector<Vec3> placed;
        for (const Vec3& p : point) placed.push_back(world(self) * p);
        if (skinned) {
            ++out_.skinned_meshes;
            std::vector<std::int32_t> most(point.size(), -1);
            const std::vector<Vec3> moved = move(attributes, node, place, point, placed, most);
            if (faces.each == 3) add_skinned(moved, placed, most, faces);
            placed = moved;
        }
        if (faces.each == 2 && !faces.corner.empty()) add_lines(attributes, placed, self, place, faces);
    }

    // Vertices as the joints place them (linear blend), and which moves each most.
    std::vector<Vec3> move(const Json& attributes, const Json& node, const std::string& place,
                           const std::vector<Vec3>& point, const std::vector<Vec3>& placed,
                           std::vector<std::int32_t>& most) {
        const std::size_t number = index_of(node, "skin", "a node", entries_of(json_, "skins"));
        const Json& skin = json_["skins"][number];
        const std::vector<double> matrices =
            values_of(document_, skin.at("inverseBindMatrices"),
                      {"skin " + std::to_string(number) + ": inverseBindMatrices", "MAT4", GltfNumbers::floats});
        std::vector<std::int32_t> joint;
        std::vector<Eigen::Affine3d> by;
        for (std::size_t k = 0; k < skin.at("joints").size(); ++k) {
            joint.push_back(std::int32_t(checked_index(skin["joints"][k], "a joint", nodes_.parent.size())));
            Eigen::Affine3d bind;
            bind.matrix() = Eigen::Map<const Eigen::Matrix4d>(matrices.data() + 16 * k);
            by.push_back(world(joint.back()) * bind);
        }
        std::vector<Vec3> moved(point.size(), Vec3::Zero());
        std::vector<double> sum(point.size(), 0), largest(point.size(), 0);
        for (const std::string& set : joint_sets(attributes)) {
            const std::string joints = "JOINTS_" + set, weights = "WEIGHTS_" + set;
            const std::vector<double> of = values_of(document_, attributes[joints],
                                                     {place + ": " + joints, "VEC4", GltfNumbers::joints}),
                                      share = values_of(document_, attributes[weights],
                                                        {place + ": " + weights, "VEC4", GltfNumbers::weights});
            for (std::size_t k = 0; k < share.size(); ++k) {
                if (!(share[k] > 0)) continue;
                const std::size_t v = k / 4, j = std::size_t(of[k]);
                moved[v] += share[k] * (by.at(j) * point[v]);
                sum[v] += share[k];
                const std::int32_t self = self_[std::size_t(joint[j])]; // -1: in another scene
                if (share[k] > largest[v] && self >= 0) largest[v] = share[k], most[v] = self;
            }
        }
        for (std::size_t v = 0; v < moved.size(); ++v) moved[v] = sum[v] > 0 ? Vec3(moved[v] / sum[v]) : placed[v];
        return moved;
    }

    void add_skinned(const std::vector<Vec3>& moved, const std::vector<Vec3>& placed,
                     const std::vector<std::int32_t>& most, const GltfFaces& faces) {
        std::vector<std::int32_t> taken(moved.size(), -1);
        for (std::size_t v = 0; v < moved.size(); ++v) {
            if (most[v] < 0 || !moved[v].allFinite()) continue;
            taken[v] = std::int32_t(out_.vertex.size());
            out_.vertex.push_back(moved[v]);
            out_.vertex_node.push_back(most[v]);
            out_.vertex_by_node.push_back(placed[v]);
        }
        for (std::size_t k = 0; k + 2 < faces.corner.size(); k += 3) {
            std::array<std::int32_t, 3> corner;
            for (std::size_t j = 0; j < 3; ++j) corner[j] = taken[std::size_t(faces.corner[k + j])];
            if (std::min({corner[0], corner[1], corner[2]}) >= 0) out_.face.push_back(corner);
        }
    }

    void add_lines(const Json& attributes, const std::vector<Vec3>& placed, std::int32_t self, const std::string& place,
                   const GltfFaces& faces) {
        const auto first = std::int32_t(out_.line_point.size());
        out_.line_point.insert(out_.line_point.end(), placed.begin(), placed.end());
        std::vector<double> radius(placed.size(), 0);
        for (const auto& [name, accessor] : attributes.items()) {
            const double factor = radius_factor(name);
            if (factor == 0) continue;
            radius = values_of(document_, accessor, {place + ": " + name, "SCALAR", GltfNumbers::any});
            if (radius.size() != placed.size())
                throw std::out_of_range(place + ": " + name + " has " + counted(radius.size(), "number", "numbers") +
                                        ", expected one for each of " + counted(placed.size(), "vertex", "vertices"));
            const double scale = factor * std::cbrt(std::abs(world(self).linear().determinant()));
            for (double& r : radius) r *= scale;
            break;
        }
        out_.line_radius.insert(out_.line_radius.end(), radius.begin(), radius.end());
        for (std::size_t k = 0; k + 1 < faces.corner.size(); k += 2)
            out_.line.push_back({first + faces.corner[k], first + faces.corner[k + 1]});
    }

    const GltfDocument& document_;
    const Json& json_;
    const GltfJoints& joints_;
    const GltfNodes& nodes_;
    ModelScene& out_;
    std::vector<std::int32_t> self_; // of each of the file's nodes, among those of the scene; -1: not in it
};

} // namespace

ModelScene scene_of_gltf(std::string_view content, const ImportOptions& options) {
    ModelScene out;
    ImportNotes none;
    GltfDocument document = read_gltf(content, options.name, options.folder, GltfImages::leave, none);
    try {
        out.animations = std::int64_t(entries_of(document.json, "animations"));
        const GltfJoints joints = joints_of(document);
        out.mesh_encoded = joints.mesh_encoded;
        out.other_scenes = std::int64_t(joints.other_scenes);
        out.own_others = joints.own.others;
        out.unit = 1;
        SceneReader(document, joints, nodes_of(document.json, options.name), out).read();
    } catch (const std::bad_alloc&) {
        throw; // not the file's fault
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        // A type that is wrong, an index beyond.
        throw InputError(options.name, "is no glTF 2.0: " + std::string(error.what()));
    }
    const bool stated = std::count(out.role.begin(), out.role.end(), NodeRole::joint) > 0;
    out.open_are_joints = !stated && out.triangles == 0;
    return out;
}

} // namespace bough
