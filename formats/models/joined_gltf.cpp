#include "joined_gltf.h"
#include "formats/plain_text.h"
#include "gltf_references.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;
namespace refs = gltf_references;

void move_by(Json& index, std::size_t by) {
    index = checked_index(index, "an index", SIZE_MAX) + by;
}

void move_if(Json& object, const char* key, std::size_t by) {
    if (object.contains(key)) move_by(object[key], by);
}

void move_all(Json& object, const char* list, std::size_t by) {
    refs::each_of(object, list, [by](Json& index) { move_by(index, by); });
}

Json& list_of(Json& json, const char* list) {
    if (!json.contains(list)) json[list] = Json::array();
    return json[list];
}

// Nodes, skins and channels of animations, when nodes and skins stand so much further on.
void move_nodes(Json& node, std::size_t nodes, std::size_t skins) {
    move_all(node, "children", nodes);
    move_if(node, "skin", skins);
}
void move_joints(Json& skin, std::size_t nodes) {
    move_all(skin, "joints", nodes);
    move_if(skin, "skeleton", nodes);
}
void move_targets(Json& animation, std::size_t nodes) {
    refs::each_of(animation, "channels", [nodes](Json& channel) { move_if(channel.at("target"), "node", nodes); });
}

Json& scene_of(Json& json) {
    Json& scenes = list_of(json, "scenes");
    const std::size_t shown = whole_number(json, "scene", "the document", 0);
    if (scenes.size() <= shown) throw std::out_of_range("scene " + std::to_string(shown) + " is not there");
    return scenes[shown];
}

Json placing_node(const GltfStand& stand, Json children) {
    Json node{{"name", stand.name}};
    if (!stand.position.isZero(0))
        node["translation"] = Json::array({stand.position.x(), stand.position.y(), stand.position.z()});
    if (stand.yaw != 0) node["rotation"] = Json::array({0, std::sin(stand.yaw / 2), 0, std::cos(stand.yaw / 2)});
    if (!children.empty()) node["children"] = std::move(children);
    return node;
}

// Known: extensions whose references to other lists are moved below, and those that have none.
bool may_be_moved(std::string_view name) {
    constexpr std::array<std::string_view, 4> begins{"KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_"};
    constexpr std::array<std::string_view, 7> whole{
        "FB_ngon_encoding",    "EXT_mesh_gpu_instancing", "EXT_meshopt_compression", "KHR_draco_mesh_compression",
        "KHR_lights_punctual", "KHR_mesh_quantization",   "KHR_node_visibility"};
    return std::any_of(begins.begin(), begins.end(), [&](std::string_view b) { return name.starts_with(b); }) ||
           std::find(whole.begin(), whole.end(), name) != whole.end();
}

// Moves what a document's lists name of each other by the lengths of those that they are put behind.
class Mover {
public:
    Mover(GltfDocument& to, GltfDocument& more) : to_(to), json_(more.json) {
        to_.binary.resize((to_.binary.size() + 3) / 4 * 4);
    }

    void move() {
        move_arrays();
        move_looks();
        refs::each_of(json_, "meshes", [this](Json& mesh) {
            refs::each_of(mesh, "primitives", [this](Json& primitive) {
                move_if(primitive, "material", before("materials"));
                if (Json* variants = refs::extension(primitive, "KHR_materials_variants"))
                    refs::each_of(*variants, "mappings", [this](Json& mapping) {
                        move_if(mapping, "material", before("materials"));
                        move_all(mapping, "variants", listed_before("KHR_materials_variants", "variants"));
                    });
            });
        });
        refs::each_of(json_, "nodes", [this](Json& node) {
            move_nodes(node, before("nodes"), before("skins"));
            move_if(node, "mesh", before("meshes"));
            move_if(node, "camera", before("cameras"));
            if (Json* light = refs::extension(node, "KHR_lights_punctual"))
                move_if(*light, "light", listed_before("KHR_lights_punctual", "lights"));
        });
        refs::each_of(json_, "skins", [this](Json& skin) { move_joints(skin, before("nodes")); });
        refs::each_of(json_, "animations", [this](Json& animation) { move_targets(animation, before("nodes")); });
        for (Json& scene : list_of(json_, "scenes")) move_all(scene, "nodes", before("nodes"));
    }

private:
    std::size_t before(const char* list) const { return entries_of(to_.json, list); }
    // Of a list that an extension of the document holds.
    std::size_t listed_before(const char* extension, const char* list) const {
        if (!to_.json.contains("extensions") || !to_.json["extensions"].contains(extension)) return 0;
        return entries_of(to_.json["extensions"][extension], list);
    }

    void move_arrays() {
        refs::each_accessor_index(json_, [this](Json& index) { move_by(index, before("accessors")); });
        refs::each_view_index(json_, [this](Json& index) { move_by(index, before("bufferViews")); });
        // Buffer 0 of both is one, which the bytes of `more` follow; others have no bytes.
        const std::size_t others = std::max<std::size_t>(before("buffers"), 1) - 1, bytes = to_.binary.size();
        const auto move_place = [&](Json& place) {
            if (const std::size_t buffer = whole_number(place, "buffer", "a view"); buffer > 0)
                place["buffer"] = buffer + others;
            else if (const std::size_t at = whole_number(place, "byteOffset", "a view", 0) + bytes; at > 0)
                place["byteOffset"] = at;
        };
        refs::each_of(json_, "bufferViews", [&](Json& view) {
            move_place(view);
            if (Json* packed = refs::extension(view, "EXT_meshopt_compression")) move_place(*packed);
        });
    }

    void move_looks() {
        refs::each_of(json_, "textures", [this](Json& texture) {
            move_if(texture, "source", before("images"));
            move_if(texture, "sampler", before("samplers"));
            if (!texture.contains("extensions")) return;
            for (Json& other : texture["extensions"])
                if (other.is_object()) move_if(other, "source", before("images"));
        });
        refs::each_of(json_, "materials", [this](Json& material) {
            refs::each_texture_index(material, [this](Json& index) { move_by(index, before("textures")); });
        });
    }

    GltfDocument& to_;
    Json& json_;
};

void add_names(Json& to, const Json& more, const char* list) {
    if (!more.contains(list)) return;
    Json& names = list_of(to, list);
    for (const Json& name : more[list])
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

// Lists of the document's own extensions, and what else stands at its top.
void add_top(Json& to, Json& more, const std::string& name) {
    add_names(to, more, "extensionsUsed");
    add_names(to, more, "extensionsRequired");
    if (more.contains("extensions"))
        for (auto& [extension, content] : more["extensions"].items())
            for (auto& [key, value] : content.items()) {
                Json& here = to["extensions"][extension][key];
                if (here.is_null())
                    here = std::move(value);
                else if (here.is_array() && value.is_array())
                    here.insert(here.end(), value.begin(), value.end());
            }
    if (const std::string owner = more["asset"].value("copyright", std::string()); !owner.empty()) {
        const std::string others = to["asset"].value("copyright", std::string());
        if (others.find(owner) == std::string::npos)
            to["asset"]["copyright"] = others.empty() ? owner : others + "; " + owner;
    }
    if (more.contains("extras")) to["extras"][name] = std::move(more["extras"]);
}

} // namespace

void require_joinable(const GltfDocument& document, const std::string& name) {
    for (const Json& extension : document.json.value("extensionsUsed", Json::array()))
        if (!may_be_moved(extension.get<std::string>()))
            throw InputError(
                name, "uses " + in_ascii_quotes(extension.get<std::string>()) +
                          ", which cannot be put into a scene's .glb; the file as INPUT can, and -o NAME.usda or "
                          "NAME_%d.obj show the scene");
}

void draw_at(GltfDocument& document, const std::vector<GltfStand>& stands) {
    Json& json = document.json;
    const Json top = scene_of(json).value("nodes", Json::array());
    const std::size_t nodes = entries_of(json, "nodes"), skins = entries_of(json, "skins"),
                      animations = entries_of(json, "animations");
    for (std::size_t k = 1; k < stands.size(); ++k) {
        for (std::size_t i = 0; i < nodes; ++i) {
            Json node = json["nodes"][i];
            move_nodes(node, k * nodes, k * skins);
            json["nodes"].push_back(std::move(node));
        }
        for (std::size_t i = 0; i < skins; ++i) {
            Json skin = json["skins"][i];
            move_joints(skin, k * nodes);
            json["skins"].push_back(std::move(skin));
        }
        for (std::size_t i = 0; i < animations; ++i) {
            Json animation = json["animations"][i];
            move_targets(animation, k * nodes);
            json["animations"].push_back(std::move(animation));
        }
    }
    Json drawn = Json::array();
    for (std::size_t k = 0; k < stands.size(); ++k) {
        Json placed = Json::array(), skinned = Json::array();
        for (const Json& index : top) {
            const std::size_t node = checked_index(index, "a scene's node", nodes) + k * nodes;
            const Json& of = json["nodes"][node];
            const bool by_joints = of.contains("mesh") && of.contains("skin") && entries_of(of, "children") == 0;
            (by_joints ? skinned : placed).push_back(node);
        }
        json["nodes"].push_back(placing_node(stands[k], std::move(placed)));
        drawn.push_back(json["nodes"].size() - 1);
        for (Json& node : skinned) drawn.push_back(std::move(node));
    }
    scene_of(json)["nodes"] = std::move(drawn);
}

void join(GltfDocument& to, GltfDocument&& more, const std::string& name) {
    require_joinable(more, name);
    Mover(to, more).move();
    Json& here = to.json;
    for (const char* list : {"accessors", "bufferViews", "meshes", "materials", "textures", "images", "samplers",
                             "cameras", "skins", "animations", "nodes"}) {
        if (entries_of(more.json, list) == 0) continue;
        Json& items = list_of(here, list);
        for (Json& item : more.json[list]) items.push_back(std::move(item));
    }
    for (std::size_t i = 0; i < entries_of(more.json, "buffers"); ++i)
        if (i > 0 || entries_of(here, "buffers") == 0)
            list_of(here, "buffers").push_back(std::move(more.json["buffers"][i]));
    to.binary += more.binary;
    more.binary = {};
    if (!here.contains("scenes")) here["scenes"] = Json::array({Json::object()}), here["scene"] = 0;
    Json& drawn = list_of(scene_of(here), "nodes");
    for (const Json& node : scene_of(more.json).value("nodes", Json::array())) drawn.push_back(node);
    add_top(here, more.json, name);
}

GltfDocument empty_gltf(const std::string& generator, const std::string& source) {
    GltfDocument document;
    document.json["asset"] = Json{{"version", "2.0"}, {"generator", generator}};
    if (!source.empty()) document.json["asset"]["extras"] = Json{{"source", source}};
    return document;
}

} // namespace bough
