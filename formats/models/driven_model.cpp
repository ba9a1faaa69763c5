#include "driven_model.h"
#include "formats/plain_text.h"
#include "gltf_document.h"
#include "gltf_nodes.h"
#include "gltf_prune.h"
#include "lib/base/counted.h"
#include "lib/model/drawn_pose.h"
#include <algorithm>
#include <map>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

float time_of(std::size_t frame, double fps) {
    return float(double(frame) / fps);
}

// Meshes that no bone moves: neither skinned nor hung on one.
std::size_t still_meshes(const Json& json, const GltfNodes& nodes, const std::vector<char>& driven) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < nodes.parent.size(); ++i) {
        if (!json["nodes"][i].contains("mesh") || json["nodes"][i].contains("skin")) continue;
        std::int32_t at = std::int32_t(i);
        while (at >= 0 && !driven[std::size_t(at)]) at = nodes.parent[std::size_t(at)];
        count += at < 0;
    }
    return count;
}

} // namespace

DrivenModel::DrivenModel(UserModel model, const Tree& tree, const DrivenOptions& options,
                         std::vector<std::string>& notes)
    : model_(std::move(model)), options_(options) {
    const Eigen::Affine3d world_from_file = Eigen::Translation3d(options.position) *
                                            Eigen::AngleAxisd(options.yaw, Vec3::UnitY()) *
                                            Eigen::Translation3d(model_.moved);
    file_from_world_ = world_from_file.inverse();
    const DrawnPose pose = drawn_pose(tree);
    drawn_R_wb_ = pose.R_wb;
    drawn_x_w_ = pose.x_w;
    std::vector<speedtree::Bone> bones = model_.armature.bones;
    for (speedtree::Bone& bone : bones) {
        bone.start = world_from_file * bone.start;
        bone.end = world_from_file * bone.end;
    }
    const BoneBodies bodies = bodies_of_bones(bones, tree, drawn_R_wb_, drawn_x_w_);
    constexpr const char* expected = "; expected the model that the tree was made from, in its own units and up axis";
    const double ratio = bodies.tree_size / bodies.bones_size;
    if (!(ratio > 0.5 && ratio < 2))
        throw InputError(model_.name, "its bones are " + shown(bodies.bones_size) + " m large, the tree is " +
                                          shown(bodies.tree_size) + " m" + expected);
    if (2 * bodies.missed > bones.size())
        throw InputError(model_.name, std::to_string(bodies.missed) + " of its " + std::to_string(bones.size()) +
                                          " bones lie beside the tree, up to " + shown(bodies.worst) + " m" + expected);
    if (bodies.missed > 0)
        notes.push_back(model_.name + ": " + std::to_string(bodies.missed) + " of " + std::to_string(bones.size()) +
                        " bones lie beside the tree, up to " + shown(bodies.worst) + " m: they go with the bone above");
    for (std::size_t b = 0; b < bones.size(); ++b) {
        if (bodies.turn[b] < 0) continue;
        Driven driven;
        driven.node = model_.joint[b];
        driven.turn = bodies.turn[b];
        driven.place = bodies.place[b];
        bone_.push_back(std::move(driven));
    }
    size_ = bodies.bones_size;
    try {
        find_nodes(notes);
        leave_out_animations(notes);
    } catch (const Json::exception& error) {
        throw InputError(model_.name, "is no glTF 2.0: " + valid_utf8(error.what()));
    } catch (const std::out_of_range& error) {
        throw InputError(model_.name,
                         std::string("is no glTF 2.0: an index is beyond its list (") + error.what() + ")");
    }
}

void DrivenModel::find_nodes(std::vector<std::string>& notes) {
    const GltfNodes nodes = nodes_of(model_.document->json, model_.name);
    std::vector<std::int32_t> bone_of(nodes.parent.size(), -1), above;
    std::vector<Quat> drawn;
    std::vector<char> is_driven(nodes.parent.size(), false);
    std::size_t unequal = 0;
    // A bone stands after those above it in the armature; so do the nodes.
    for (std::size_t b = 0; b < bone_.size(); ++b) {
        Driven& d = bone_[b];
        const auto node = std::size_t(d.node);
        bone_of[node] = std::int32_t(b);
        is_driven[node] = true;
        const std::int32_t p = nodes.parent[node];
        std::int32_t at = p;
        bool equal = true;
        for (; at >= 0; at = nodes.parent[std::size_t(at)]) equal = equal && nodes.unequal[std::size_t(at)] <= 1e-3;
        unequal += !equal;
        for (at = p; at >= 0 && bone_of[std::size_t(at)] < 0;) at = nodes.parent[std::size_t(at)];
        d.above = at < 0 ? -1 : bone_of[std::size_t(at)];
        d.turned = nodes.turned[node];
        d.linear = nodes.world[node].linear();
        d.start = nodes.world[node].translation();
        d.translation = nodes.local[node].translation();
        const Eigen::Affine3d parent = p < 0 ? Eigen::Affine3d::Identity() : nodes.world[std::size_t(p)];
        const Quat parent_turned = p < 0 ? Quat(Quat::Identity()) : nodes.turned[std::size_t(p)];
        d.to_parent = at < 0 ? parent : Eigen::Affine3d(nodes.world[std::size_t(at)].inverse() * parent);
        const Quat from_above = at < 0 ? Quat(Quat::Identity()) : Quat(nodes.turned[std::size_t(at)].conjugate());
        d.offset = from_above * parent_turned;
        if (std::abs(d.to_parent.linear().determinant()) < 1e-300)
            throw InputError(model_.name, "has a bone below a node scaled to nothing");
        above.push_back(d.above);
        drawn.push_back(from_above * d.turned);
        clear_matrix(b);
    }
    keys_ = std::make_unique<JointKeys>(above, drawn);
    if (unequal > 0)
        notes.push_back(model_.name + ": " +
                        counted(unequal, "bone hangs on a node scaled unequally: its rotation is only near",
                                "bones hang on nodes scaled unequally: their rotations are only near"));
    if (const std::size_t still = still_meshes(model_.document->json, nodes, is_driven))
        notes.push_back(
            model_.name + ": " +
            counted(still, "mesh stays still: no bone carries it", "meshes stay still: no bone carries them"));
}

void DrivenModel::clear_matrix(std::size_t bone) {
    Json& node = model_.document->json["nodes"][std::size_t(bone_[bone].node)];
    if (!node.contains("matrix")) return;
    Eigen::Matrix4d m;
    for (int k = 0; k < 16; ++k) m(k % 4, k / 4) = node["matrix"][std::size_t(k)].get<double>();
    Quat q;
    Vec3 scale;
    part(m.topLeftCorner<3, 3>(), q, scale);
    node.erase("matrix");
    node["translation"] = Json::array({m(0, 3), m(1, 3), m(2, 3)});
    node["rotation"] = Json::array({q.x(), q.y(), q.z(), q.w()});
    node["scale"] = Json::array({scale.x(), scale.y(), scale.z()});
}

void DrivenModel::leave_out_animations(std::vector<std::string>& notes) {
    if (!model_.document->json.contains("animations")) return;
    std::vector<std::size_t> nodes;
    for (const Driven& d : bone_) nodes.push_back(std::size_t(d.node));
    std::sort(nodes.begin(), nodes.end());
    Json kept = Json::array();
    std::string left_out;
    std::vector<std::size_t> arrays; // of what is left out
    for (const Json& animation : model_.document->json["animations"]) {
        bool ours = false;
        for (const Json& channel : animation.at("channels")) {
            const Json& target = channel.at("target");
            ours = ours || (target.contains("node") &&
                            std::binary_search(nodes.begin(), nodes.end(), target["node"].get<std::size_t>()));
        }
        if (!ours) {
            kept.push_back(animation);
            continue;
        }
        left_out += (left_out.empty() ? "" : ", ") + bough::in_ascii_quotes(animation.value("name", std::string()));
        for (const Json& sampler : animation.at("samplers"))
            for (const char* array : {"input", "output"}) arrays.push_back(sampler.at(array).get<std::size_t>());
    }
    model_.document->json["animations"] = std::move(kept);
    if (!left_out.empty())
        notes.push_back(model_.name + ": animations of the same bones left out for the new one: " + left_out);
    if (const std::string unknown = prune(*model_.document, arrays); !unknown.empty())
        notes.push_back(model_.name + ": the arrays of what was left out stay in the file, as it uses " +
                        bough::in_ascii_quotes(unknown) + ", which may name them");
}

void DrivenModel::write(const MotionFrame& frame) {
    std::vector<Quat> turned(bone_.size());
    std::vector<Eigen::Affine3d> world(bone_.size());
    const Mat3 file_R = file_from_world_.linear();
    for (std::size_t b = 0; b < bone_.size(); ++b) {
        Driven& d = bone_[b];
        const auto t = std::size_t(d.turn), p = std::size_t(d.place);
        const Mat3 turn =
            file_R * frame.rotation[t].toRotationMatrix() * drawn_R_wb_[t].transpose() * file_R.transpose();
        const Vec3 start_w = file_from_world_.inverse() * d.start;
        const Vec3 place =
            file_from_world_ * Vec3(frame.position[p] + frame.rotation[p].toRotationMatrix() *
                                                            (drawn_R_wb_[p].transpose() * (start_w - drawn_x_w_[p])));
        world[b].linear() = turn * d.linear;
        world[b].translation() = place;
        world[b].makeAffine();
        turned[b] = Quat(turn) * d.turned;
        const Eigen::Affine3d parent = d.above < 0 ? d.to_parent : world[std::size_t(d.above)] * d.to_parent;
        const Vec3 local = parent.inverse() * place;
        d.off = std::max(d.off, (parent.linear() * (local - d.translation)).norm());
        d.path.push_back(local.cast<float>());
    }
    keys_->add(turned);
}

std::string DrivenModel::finish(const std::string& output_name) {
    keys_->thin(options_.key_tolerance);
    GltfDocument& document = *model_.document;
    Json samplers = Json::array(), channels = Json::array();
    const auto add = [&](std::size_t input, std::size_t output, std::int32_t node, const char* path) {
        channels.push_back(Json{{"sampler", samplers.size()}, {"target", Json{{"node", node}, {"path", path}}}});
        samplers.push_back(Json{{"input", input}, {"output", output}});
    };
    std::map<std::vector<float>, std::size_t> inputs; // times, once for all bones that share them
    const auto input_of = [&](const std::vector<float>& times) {
        const auto [at, fresh] = inputs.try_emplace(times, 0);
        if (fresh) at->second = add_floats(document, times, "SCALAR", true);
        return at->second;
    };
    for (std::size_t b = 0; b < bone_.size(); ++b) {
        const Driven& d = bone_[b];
        std::vector<float> times, values;
        Eigen::Vector4f before = Eigen::Vector4f::Zero();
        for (std::size_t f = 0; f < keys_->frames(); ++f) {
            if (!keys_->has_key(b, f)) continue;
            Eigen::Vector4f q =
                (d.offset.conjugate() * keys_->key(b, f).cast<double>()).normalized().coeffs().cast<float>();
            if (q.dot(before) < 0) q = -q; // neighbours less than half a turn apart, as 4-vectors
            before = q;
            times.push_back(time_of(f, options_.fps));
            for (int k = 0; k < 4; ++k) values.push_back(q[k]);
        }
        if (!times.empty()) {
            const std::size_t input = input_of(times);
            add(input, add_floats(document, values, "VEC4", false), d.node, "rotation");
        }
        if (!(d.off > 1e-5 * size_)) continue;
        times.clear(), values.clear();
        for (std::size_t f = 0; f < d.path.size(); ++f) {
            times.push_back(time_of(f, options_.fps));
            for (int k = 0; k < 3; ++k) values.push_back(d.path[f][k]);
        }
        const std::size_t input = input_of(times);
        add(input, add_floats(document, values, "VEC3", false), d.node, "translation");
    }
    Json motion{{"name", "motion"}, {"channels", std::move(channels)}, {"samplers", std::move(samplers)}};
    if (!options_.source.empty()) motion["extras"] = Json{{"source", options_.source}};
    Json animations = Json::array({std::move(motion)});
    if (document.json.contains("animations"))
        for (Json& other : document.json["animations"]) animations.push_back(std::move(other));
    document.json["animations"] = std::move(animations);
    return glb_of(document, output_name);
}

} // namespace bough
