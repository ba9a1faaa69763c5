#include "gltf_nodes.h"
#include "formats/error.h"
#include "formats/imports/imported_tree.h"
#include "gltf_document.h"
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

template <int n> Eigen::Matrix<double, n, 1> numbers(const Json& node, const char* key) {
    const Json& list = node.at(key);
    if (!list.is_array() || list.size() != n)
        throw std::out_of_range(std::string(key) + " holds another number of values than " + std::to_string(n));
    Eigen::Matrix<double, n, 1> result;
    for (int k = 0; k < n; ++k) result[k] = list[std::size_t(k)].get<double>();
    return result;
}

void read_place(const Json& node, Eigen::Affine3d& local, Quat& turned, Quat& flipped, double& unequal) {
    Vec3 scale = Vec3::Ones();
    flipped = Quat::Identity();
    local = Eigen::Affine3d::Identity();
    turned = Quat::Identity();
    if (node.contains("matrix")) {
        const auto m = numbers<16>(node, "matrix");
        local.matrix() = Eigen::Map<const Eigen::Matrix4d>(m.data());
        part(local.linear(), turned, scale);
    } else {
        if (node.contains("rotation")) {
            const auto q = numbers<4>(node, "rotation");
            turned = Quat(q[3], q[0], q[1], q[2]);
            if (!(turned.norm() > 0)) throw std::out_of_range("a rotation is no unit quaternion");
            turned.normalize();
        }
        if (node.contains("scale")) scale = numbers<3>(node, "scale");
        if (node.contains("translation")) local.translation() = numbers<3>(node, "translation");
        local.linear() = turned.toRotationMatrix() * scale.asDiagonal();
        // Negative scales are half a turn, or half a turn and the mirror of all three axes, which goes with any rotation.
        const Vec3 sign = scale.unaryExpr([](double s) { return s < 0 ? -1.0 : 1.0; });
        flipped = Quat(Mat3((sign.prod() * sign).asDiagonal()));
        turned = turned * flipped;
    }
    scale = scale.cwiseAbs();
    unequal = scale.minCoeff() > 0 ? scale.maxCoeff() / scale.minCoeff() - 1 : 1;
}

} // namespace

void part(const Mat3& linear, Quat& rotation, Vec3& scale) {
    const double determinant = linear.determinant();
    Mat3 R = linear;
    if (determinant < 0) R = -R; // a mirror is the scale's
    // Newton's iteration to the nearest rotation (Higham 1986).
    const double size = std::cbrt(std::abs(determinant));
    if (!(size > 0) || !std::isfinite(size)) {
        R = Mat3::Identity();
    } else {
        R /= size;
        for (int k = 0; k < 100; ++k) {
            const Mat3 next = 0.5 * (R + R.inverse().transpose());
            const double change = (next - R).norm();
            R = next;
            if (change < 1e-15) break;
        }
    }
    rotation = Quat(R).normalized();
    scale = (R.transpose() * linear).diagonal();
}

GltfNodes nodes_of(const Json& json, const std::string& name) {
    GltfNodes result;
    try {
        const Json& nodes = json.at("nodes");
        const std::size_t n = nodes.size();
        result.parent.assign(n, -1);
        result.local.resize(n);
        result.world.resize(n);
        result.turned.resize(n);
        result.flipped.resize(n);
        result.unequal.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            read_place(nodes[i], result.local[i], result.turned[i], result.flipped[i], result.unequal[i]);
            if (!nodes[i].contains("children")) continue;
            for (const Json& child : nodes[i]["children"]) {
                std::int32_t& parent = result.parent[checked_index(child, "a child of node " + std::to_string(i), n)];
                if (parent >= 0) throw std::out_of_range("node " + child.dump() + " has two parents");
                parent = std::int32_t(i);
            }
        }
        const ParentsFirst sorted = parents_first(result.parent);
        if (sorted.cycle >= 0) throw std::out_of_range("node " + std::to_string(sorted.cycle) + " is its own ancestor");
        for (const std::int32_t i : sorted.order) {
            const std::int32_t p = result.parent[i];
            result.world[i] = p < 0 ? result.local[i] : result.world[p] * result.local[i];
            if (p >= 0) result.turned[i] = (result.turned[p] * result.turned[i]).normalized();
        }
    } catch (const std::bad_alloc&) {
        throw; // not the file's fault
    } catch (const std::exception& error) {
        throw InputError(name, "is no glTF 2.0: " + std::string(error.what()));
    }
    return result;
}

std::vector<std::size_t> nodes_in_scene(const Json& json) {
    const Json& scenes = json.at("scenes");
    const Json& scene = scenes[checked_index(json.value("scene", Json(0)), "scene", scenes.size())];
    std::vector<char> seen(json.at("nodes").size(), false);
    std::vector<std::size_t> stack, found;
    const auto push = [&](const Json& list, const char* what) { // so that they come in their order
        for (std::size_t k = list.size(); k-- > 0;) stack.push_back(checked_index(list[k], what, seen.size()));
    };
    push(scene.value("nodes", Json::array()), "a node of the scene");
    while (!stack.empty()) {
        const std::size_t n = stack.back();
        stack.pop_back();
        if (seen[n]) throw std::out_of_range("node " + std::to_string(n) + " stands in the scene twice");
        seen[n] = true;
        found.push_back(n);
        push(json["nodes"][n].value("children", Json::array()), "a child");
    }
    return found;
}

} // namespace bough
