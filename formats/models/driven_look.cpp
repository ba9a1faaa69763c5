#include "driven_look.h"
#include "formats/plain_text.h"
#include "gltf_document.h"
#include "gltf_uri.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;

double srgb(double linear) {
    const double l = std::clamp(linear, 0.0, 1.0);
    return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
}

const Json& at_or_empty(const Json& object, const char* key) {
    static const Json empty = Json::object();
    const auto found = object.find(key);
    return found == object.end() ? empty : *found;
}

const Json& color_texture(const Json& material) {
    return at_or_empty(at_or_empty(material, "pbrMetallicRoughness"), "baseColorTexture");
}

MapPlace place_of(const Json& texture) {
    MapPlace place;
    place.set = whole_number(texture, "texCoord", "a texture", 0);
    const Json& moved = at_or_empty(at_or_empty(texture, "extensions"), "KHR_texture_transform");
    place.set = whole_number(moved, "texCoord", "a texture", place.set);
    const double turn = moved.value("rotation", 0.0), c = std::cos(turn), s = std::sin(turn);
    place.turn << c, s, -s, c;
    for (std::size_t k = 0; k < 2; ++k) {
        if (moved.contains("scale")) place.turn.col(int(k)) *= moved["scale"].at(k).get<double>();
        if (moved.contains("offset")) place.at[int(k)] = moved["offset"].at(k).get<double>();
    }
    return place;
}

class Looks {
public:
    Looks(const GltfDocument& document, OwnMesh& mesh, std::vector<std::string>& notes)
        : document_(document), mesh_(mesh), notes_(notes) {}

    void add(std::int32_t number) {
        OwnPart part;
        part.name = number < 0 ? "none" : "material_" + std::to_string(number);
        part.material = -1;
        if (number >= 0) {
            const Json& material = document_.json["materials"][std::size_t(number)];
            part.name = free_name(material.value("name", part.name));
            part.material = std::int32_t(mesh_.material.size());
            const Json& given = at_or_empty(material, "pbrMetallicRoughness");
            std::array<double, 4> color{1, 1, 1, 1};
            const Json& factor = at_or_empty(given, "baseColorFactor");
            for (std::size_t k = 0; k < 4 && factor.is_array(); ++k) color[k] = factor.at(k).get<double>();
            part.color = {srgb(color[0]), srgb(color[1]), srgb(color[2])};
            Json pbr{{"baseColorFactor", Json::array({color[0], color[1], color[2], 1.0})}};
            if (color[3] < 1 && material.value("alphaMode", "OPAQUE") != "OPAQUE")
                notes_.push_back(in_ascii_quotes(part.name) + " is see-through all over: it is shown opaque");
            for (const char* factor_of : {"metallicFactor", "roughnessFactor"})
                if (given.contains(factor_of)) pbr[factor_of] = given[factor_of].get<double>();
            const MapPlace place = map_place_of(document_, number);
            const auto add_map = [&](Json& to, const Json& from, const char* map, const char* what) {
                const Json& texture = at_or_empty(from, map);
                if (const int image = image_of(texture, part.name + what, place); image >= 0)
                    to[map] = {{"index", image}};
            };
            add_map(pbr, given, "baseColorTexture", "");
            add_map(pbr, given, "metallicRoughnessTexture", "_roughness");
            Json look{{"name", part.name}, {"pbrMetallicRoughness", std::move(pbr)}};
            add_map(look, material, "normalTexture", "_normal");
            add_map(look, material, "occlusionTexture", "_occlusion");
            if (material.contains("alphaMode")) look["alphaMode"] = material["alphaMode"].get<std::string>();
            if (material.contains("alphaCutoff")) look["alphaCutoff"] = material["alphaCutoff"].get<double>();
            if (material.contains("doubleSided")) look["doubleSided"] = material["doubleSided"].get<bool>();
            const Json& light = at_or_empty(material, "emissiveFactor");
            if (std::any_of(light.begin(), light.end(), [](const Json& of) { return of.get<double>() > 0; }))
                notes_.push_back(in_ascii_quotes(part.name) + " emits light, which is not shown");
            mesh_.material.push_back(look.dump(-1, ' ', false, Json::error_handler_t::replace));
        } else {
            part.name = free_name(part.name);
        }
        mesh_.part.push_back(std::move(part));
    }

private:
    std::string free_name(std::string name) {
        for (char& c : name)
            if (static_cast<unsigned char>(c) <= ' ' || c == 127) c = '_';
        if (name.empty()) name = "material";
        const std::string stem = name;
        for (int& k = next_.try_emplace(stem, 2).first->second; !name_.insert(name).second; ++k)
            name = stem + "_" + std::to_string(k);
        return name;
    }

    // The mesh's image of a texture that a material names, -1: none that could be written. otherwise: its name, where the file has none.
    int image_of(const Json& texture, const std::string& otherwise, const MapPlace& expected) {
        if (!texture.contains("index")) return -1;
        const Json& of = document_.json.at("textures").at(texture["index"].get<std::size_t>());
        if (!of.contains("source")) { // an extension names one of another kind
            note("a texture has neither PNG nor JPEG");
            return -1;
        }
        const auto number = of["source"].get<std::size_t>();
        const auto [known, fresh] = image_.try_emplace(number, -1);
        if (!fresh) return known->second < 0 || lies_as(expected, texture, otherwise) ? known->second : -1;
        const Json& image = document_.json.at("images").at(number);
        const std::string bytes = bytes_of(image), place = "image " + std::to_string(number);
        const char* const type = image_type(bytes);
        if (!type || (type != std::string("image/png") && type != std::string("image/jpeg"))) {
            note(place + (bytes.empty() ? " is not in the file" : " is neither PNG nor JPEG"));
            return -1;
        }
        if (!lies_as(expected, texture, otherwise)) {
            image_.erase(known);
            return -1;
        }
        known->second = int(mesh_.image.size());
        const std::string name = valid_utf8(image.value("name", std::string()));
        mesh_.image.push_back({name.empty() ? otherwise : name, type, bytes});
        return known->second;
    }

    // A note says so where it does not.
    bool lies_as(const MapPlace& expected, const Json& texture, const std::string& name) {
        const MapPlace place = place_of(texture);
        const bool same = place.set == expected.set && place.turn == expected.turn && place.at == expected.at;
        if (!same) note(in_ascii_quotes(name) + " lies otherwise on the mesh than its material's colours");
        return same;
    }

    std::string bytes_of(const Json& image) const {
        if (!image.contains("bufferView")) {
            const std::string uri = image.value("uri", std::string());
            return uri.starts_with("data:") ? bytes_of_uri(uri, "") : std::string();
        }
        const Json& view = document_.json.at("bufferViews").at(image["bufferView"].get<std::size_t>());
        const std::size_t first = whole_number(view, "byteOffset", "an image's view", 0),
                          size = whole_number(view, "byteLength", "an image's view");
        if (first > document_.binary.size() || size > document_.binary.size() - first)
            throw std::out_of_range("an image's view names bytes that the file does not hold");
        return document_.binary.substr(first, size);
    }

    void note(const std::string& what) { notes_.push_back(what + ": its material does without it"); }

    const GltfDocument& document_;
    OwnMesh& mesh_;
    std::vector<std::string>& notes_;
    std::map<std::size_t, int> image_; // of each of the document's that was asked for
    std::set<std::string> name_;
    std::map<std::string, int> next_; // of each name that was asked for: the number to try next
};

} // namespace

MapPlace map_place_of(const GltfDocument& document, std::int32_t number) {
    if (number < 0) return {};
    const Json& material = document.json["materials"][std::size_t(number)];
    for (const Json* texture :
         {&color_texture(material), &at_or_empty(material, "normalTexture"),
          &at_or_empty(at_or_empty(material, "pbrMetallicRoughness"), "metallicRoughnessTexture")})
        if (!texture->empty()) return place_of(*texture);
    return place_of(at_or_empty(material, "occlusionTexture"));
}

void add_looks(const GltfDocument& document, const std::vector<std::int32_t>& materials, OwnMesh& mesh,
               std::vector<std::string>& notes) {
    Looks looks(document, mesh, notes);
    for (const std::int32_t material : materials) looks.add(material);
}

} // namespace bough
