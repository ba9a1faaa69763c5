#include "driven_model.h"
#include "formats/plain_text.h"
#include "gltf_document.h"
#include "gltf_prune.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <map>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

float time_of(std::size_t frame, double fps) {
    return float(double(frame) / fps);
}

} // namespace

DrivenModel::DrivenModel(UserModel model, const Tree& tree, const DrivenOptions& options,
                         std::vector<std::string>& notes)
    : model_(std::move(model)), options_(options), bones_(model_, tree, options.place, notes),
      bone_(bones_.bone().size()) {
    try {
        find_nodes(notes);
        leave_out_animations(notes);
    } catch (const Json::exception& error) {
        throw InputError(model_.name, "is no glTF 2.0: " + std::string(error.what()));
    } catch (const std::out_of_range& error) {
        throw InputError(model_.name,
                         std::string("is no glTF 2.0: an index is beyond its list (") + error.what() + ")");
    }
}

void DrivenModel::find_nodes(std::vector<std::string>& notes) {
    const GltfNodes& nodes = bones_.nodes();
    std::vector<std::int32_t> above;
    std::vector<Quat> drawn;
    std::size_t unequal = 0;
    for (std::size_t b = 0; b < bone_.size(); ++b) {
        Driven& d = bone_[b];
        const DrivenBone& bone = bones_.bone()[b];
        const auto node = std::size_t(bone.node);
        const std::int32_t p = nodes.parent[node];
        bool equal = true;
        for (std::int32_t at = p; at >= 0; at = nodes.parent[std::size_t(at)])
            equal = equal && nodes.unequal[std::size_t(at)] <= 1e-3;
        unequal += !equal;
        d.above = bones_.bone_over(p);
        const std::int32_t at = d.above < 0 ? -1 : bones_.bone()[std::size_t(d.above)].node;
        d.translation = nodes.local[node].translation();
        const Eigen::Affine3d parent = p < 0 ? Eigen::Affine3d::Identity() : nodes.world[std::size_t(p)];
        const Quat parent_turned = p < 0 ? Quat(Quat::Identity()) : nodes.turned[std::size_t(p)];
        d.to_parent = at < 0 ? parent : Eigen::Affine3d(nodes.world[std::size_t(at)].inverse() * parent);
        const Quat from_above = at < 0 ? Quat(Quat::Identity()) : Quat(nodes.turned[std::size_t(at)].conjugate());
        d.offset = from_above * parent_turned;
        d.flipped = nodes.flipped[node];
        if (std::abs(d.to_parent.linear().determinant()) < 1e-300)
            throw InputError(model_.name, "has a bone below a node scaled to nothing");
        above.push_back(d.above);
        drawn.push_back(from_above * bone.turned);
        clear_matrix(b);
    }
    keys_ = std::make_unique<JointKeys>(above, drawn);
    if (unequal > 0)
        notes.push_back(
            model_.name + ": " +
            counted(
                unequal,
                "bone hangs on a node scaled unequally: its rotation is only near (.usda and OBJ have it right)",
                "bones hang on nodes scaled unequally: their rotations are only near (.usda and OBJ have them right)"));
}

void DrivenModel::clear_matrix(std::size_t bone) {
    Json& node = model_.document->json["nodes"][std::size_t(bones_.bone()[bone].node)];
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
    for (const DrivenBone& bone : bones_.bone()) nodes.push_back(std::size_t(bone.node));
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
    bones_.poses(frame, pose_);
    std::vector<Quat> turned(bone_.size());
    for (std::size_t b = 0; b < bone_.size(); ++b) {
        Driven& d = bone_[b];
        turned[b] = pose_[b].turned;
        const Eigen::Affine3d parent = d.above < 0 ? d.to_parent : pose_[std::size_t(d.above)].world * d.to_parent;
        const Vec3 local = parent.inverse() * Vec3(pose_[b].world.translation());
        d.off = std::max(d.off, (parent.linear() * (local - d.translation)).norm());
        d.path.push_back(local.cast<float>());
    }
    keys_->add(turned);
}

void DrivenModel::add_motion(Json& animation, std::size_t first_node) {
    keys_->thin(options_.key_tolerance);
    GltfDocument& document = *model_.document;
    for (const char* list : {"channels", "samplers"})
        if (!animation.contains(list)) animation[list] = Json::array();
    Json &samplers = animation["samplers"], &channels = animation["channels"];
    const auto add = [&](std::size_t input, std::size_t output, std::int32_t of, const char* path) {
        const std::size_t node = std::size_t(of) + first_node;
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
            Eigen::Vector4f q = (d.offset.conjugate() * keys_->key(b, f).cast<double>() * d.flipped.conjugate())
                                    .normalized()
                                    .coeffs()
                                    .cast<float>();
            if (q.dot(before) < 0) q = -q; // neighbours less than half a turn apart, as 4-vectors
            before = q;
            times.push_back(time_of(f, options_.fps));
            for (int k = 0; k < 4; ++k) values.push_back(q[k]);
        }
        if (!times.empty()) {
            const std::size_t input = input_of(times);
            add(input, add_floats(document, values, "VEC4", false), bones_.bone()[b].node, "rotation");
        }
        if (!(d.off > 1e-5 * bones_.size())) continue;
        times.clear(), values.clear();
        for (std::size_t f = 0; f < d.path.size(); ++f) {
            times.push_back(time_of(f, options_.fps));
            for (int k = 0; k < 3; ++k) values.push_back(d.path[f][k]);
        }
        const std::size_t input = input_of(times);
        add(input, add_floats(document, values, "VEC3", false), bones_.bone()[b].node, "translation");
    }
}

std::string DrivenModel::finish(const std::string& output_name) {
    GltfDocument& document = *model_.document;
    Json motion{{"name", "motion"}};
    add_motion(motion, 0);
    if (!options_.source.empty()) motion["extras"] = Json{{"source", options_.source}};
    Json animations = Json::array({std::move(motion)});
    if (document.json.contains("animations"))
        for (Json& other : document.json["animations"]) animations.push_back(std::move(other));
    document.json["animations"] = std::move(animations);
    return glb_of(document, output_name);
}

} // namespace bough
