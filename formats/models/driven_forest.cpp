#include "driven_forest.h"
#include "gltf_complete.h"
#include "joined_gltf.h"
#include <numeric>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

// Takes the animation out of the list; it becomes the first, or its channels those of the first.
void put_first(Json& animations, std::size_t from, bool there_is_one) {
    Json motion = std::move(animations[from]);
    animations.erase(from);
    if (!there_is_one) {
        animations.insert(animations.begin(), std::move(motion));
        return;
    }
    Json& first = animations[0];
    const std::size_t samplers = first.at("samplers").size();
    for (Json& channel : motion.at("channels")) {
        channel["sampler"] = channel.at("sampler").get<std::size_t>() + samplers;
        first["channels"].push_back(std::move(channel));
    }
    for (Json& sampler : motion.at("samplers")) first["samplers"].push_back(std::move(sampler));
}

} // namespace

DrivenForest::DrivenForest(UserModel model, const std::vector<DrivenStand>& stands, DrivenOptions options,
                           std::vector<std::string>& notes)
    : model_(std::move(model)), options_(std::move(options)) {
    try { // before the frames
        add_missing_scene(model_.document->json);
        require_joinable(*model_.document, model_.name);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(model_.name, "is no glTF 2.0: " + std::string(error.what()));
    }
    std::vector<std::string> again; // the same of each tree
    for (const DrivenStand& stand : stands) {
        options_.place = stand.place;
        stand_.emplace_back(model_, stand.tree, options_, stand_.empty() ? notes : again);
        name_.push_back(stand.name);
        place_.push_back(stand.place);
    }
}

void DrivenForest::join_to(GltfDocument& to) {
    GltfDocument& document = *model_.document;
    try {
        const std::size_t nodes = entries_of(document.json, "nodes");
        std::vector<GltfStand> stands;
        for (std::size_t k = 0; k < stand_.size(); ++k) {
            const Vec3 moved = Eigen::AngleAxisd(place_[k].yaw, Vec3::UnitY()) * model_.moved;
            stands.push_back({name_[k], place_[k].position + moved, place_[k].yaw});
        }
        draw_at(document, stands);
        Json motion{{"name", "motion"}};
        for (std::size_t k = 0; k < stand_.size(); ++k) stand_[k].add_motion(motion, k * nodes);
        if (!options_.source.empty()) motion["extras"] = Json{{"source", options_.source}};
        Json animations = Json::array({std::move(motion)});
        if (document.json.contains("animations"))
            for (Json& other : document.json["animations"]) animations.push_back(std::move(other));
        document.json["animations"] = std::move(animations);
        const std::size_t before = entries_of(to.json, "animations");
        join(to, std::move(document), model_.name);
        put_first(to.json["animations"], before, before > 0);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(model_.name, "is no glTF 2.0: " + std::string(error.what()));
    }
}

std::size_t DrivenForest::bones() const {
    return std::accumulate(stand_.begin(), stand_.end(), std::size_t(0),
                           [](std::size_t sum, const DrivenModel& model) { return sum + model.bones(); });
}

std::size_t DrivenForest::keys() const {
    return std::accumulate(stand_.begin(), stand_.end(), std::size_t(0), [](std::size_t sum, const DrivenModel& model) {
        return sum + model.keys().joints() * model.keys().frames();
    });
}

std::size_t DrivenForest::keys_written() const {
    return std::accumulate(stand_.begin(), stand_.end(), std::size_t(0),
                           [](std::size_t sum, const DrivenModel& model) { return sum + model.keys().count(); });
}

std::string glb_with(const std::string& glb, std::vector<DrivenForest>& forests, const std::string& generator,
                     const std::string& source, const std::string& output_name) {
    ImportNotes none;
    GltfDocument document =
        glb.empty() ? empty_gltf(generator, source) : read_gltf(glb, output_name, "", GltfImages::leave, none);
    for (DrivenForest& forest : forests) forest.join_to(document);
    return glb_of(document, output_name);
}

} // namespace bough
