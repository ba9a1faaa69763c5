#include "own_materials.h"
#include "formats/exports/png_image.h"
#include "formats/inside.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include "texture_file.h"
#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace bough {
namespace {

using Json = nlohmann::ordered_json;
using speedtree::Map;
using speedtree::MeshMaterial;

double linear(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

const Map* map_of(const MeshMaterial& material, std::initializer_list<const char*> names) {
    for (const char* name : names)
        for (const Map& map : material.maps)
            if (lower_case(map.name) == name) return &map;
    return nullptr;
}

// What an image is called: its file's name without folders, those of Windows too, and ending.
std::string image_name(std::string file) {
    std::replace(file.begin(), file.end(), '\\', '/');
    return stem_of(file);
}

const Map* color_map(const MeshMaterial& material) {
    return map_of(material, {"color", "diffuse", "albedo", "basecolor"});
}

class Builder {
public:
    Builder(const std::string& name, const std::string& folder, bool flip_opacity, OwnMesh& mesh, ImportNotes& notes)
        : name_(name), textures_(folder), flip_opacity_(flip_opacity), mesh_(mesh), notes_(notes) {}

    void add(const MeshMaterial& material) {
        Json pbr, json{{"name", material.name}};
        const Map* const color = color_map(material);
        const Map* const opacity = map_of(material, {"opacity", "alpha"});
        const auto [base, masked] = base_image(color, opacity);
        const Vec3 factor = base >= 0 && color && !path_of(*color).empty() ? Vec3(Vec3::Ones()) : color_of(material);
        pbr["baseColorFactor"] = {linear(factor[0]), linear(factor[1]), linear(factor[2]), 1.0};
        if (base >= 0) pbr["baseColorTexture"] = {{"index", base}};
        pbr["metallicFactor"] = 0.0;
        const Map* const gloss = map_of(material, {"gloss"});
        const Map* const rough = gloss ? nullptr : map_of(material, {"roughness"});
        const int shine = gloss_image(gloss ? gloss : rough, gloss != nullptr);
        const double value = gloss && gloss->value ? 1 - *gloss->value : rough && rough->value ? *rough->value : 1;
        pbr["roughnessFactor"] = shine >= 0 ? 1.0 : std::clamp(value, 0.0, 1.0);
        if (shine >= 0) pbr["metallicRoughnessTexture"] = {{"index", shine}};
        json["pbrMetallicRoughness"] = std::move(pbr);
        if (const int normal = plain_image(map_of(material, {"normal"})); normal >= 0)
            json["normalTexture"] = {{"index", normal}};
        if (const int shade = plain_image(map_of(material, {"ao", "ambientocclusion"})); shade >= 0)
            json["occlusionTexture"] = {{"index", shade}};
        if (masked) json["alphaMode"] = "MASK", json["alphaCutoff"] = 0.5;
        if (masked || material.two_sided) json["doubleSided"] = true;
        mesh_.material.push_back(json.dump(-1, ' ', false, Json::error_handler_t::replace));
        for (const Map& map : material.maps)
            if (!map.file.empty() && !used_.contains(&map)) left_out_.insert(map.name);
        texture_.clear(); // pixels of many textures are much; one that is shared is decoded again
    }

    void add_notes() {
        for (const auto& [file, looked] : missing_) {
            const std::string texture = "texture " + bough::in_ascii_quotes(file);
            std::string text = texture + " not found, its material does without it; looked for";
            for (std::size_t k = 0; k < looked.tried.size(); ++k) text += (k > 0 ? ", " : " ") + looked.tried[k];
            if (!looked.folder.empty())
                text = texture + " is a folder, " + looked.folder + ", expected an image; its material does without it";
            if (looked.tried.empty()) text = texture + " not looked for, as what is read from a pipe stands nowhere";
            if (!looked.outside.empty() && looked.tried.empty())
                text = texture + " not opened, its material does without it";
            if (!looked.outside.empty()) text += "; " + looked.outside + " " + out_of_reach;
            notes_.lines.push_back(text);
        }
        for (const std::string& text : unread_) notes_.lines.push_back(text);
        if (left_out_.empty()) return;
        std::string names;
        for (const std::string& name : left_out_) names += (names.empty() ? "" : ", ") + name;
        notes_.lines.push_back("maps that glTF has no place for left out: " + names);
    }

private:
    // Where the map's image is, "" where there is none. Names that lead to one file have one path, so that it is embedded once.
    const std::string& path_of(const Map& map) {
        const auto [found, added] = path_.try_emplace(map.file);
        used_.insert(&map);
        if (!added || map.file.empty()) return found->second;
        TexturePlaces looked;
        const std::string path = textures_.find(map.file, looked);
        if (path.empty()) {
            missing_.emplace_back(map.file, std::move(looked));
            return found->second;
        }
        const std::string read = readable(map.file, path);
        std::error_code none;
        if (!read.empty()) found->second = std::filesystem::canonical(read, none).string();
        if (none) found->second = read;
        read_.try_emplace(found->second, read);
        return found->second;
    }

    // Null: not found, or none is named.
    const Texture* texture(const Map* map) {
        if (!map) return nullptr;
        const std::string& path = path_of(*map);
        if (path.empty()) return nullptr;
        const auto found = texture_.find(path);
        if (found != texture_.end()) return &found->second;
        return &texture_.emplace(path, read_texture(read_.at(path), file_line(name_, map->line))).first->second;
    }

    // The path itself; of an image of a kind that is not read, that of one of the same name beside it that may be, "" where there is none. A note
    // says so, once.
    std::string readable(const std::string& file, const std::string& path) {
        const std::string kind = unread_kind(path);
        if (kind.empty()) return path;
        const std::string text =
            "texture " + bough::in_ascii_quotes(file) + " is a " + kind + " image, which is not read: ";
        std::string stem = file;
        std::replace(stem.begin(), stem.end(), '\\', '/'); // of Windows
        stem.resize(stem.size() - std::filesystem::path(stem).extension().string().size());
        std::string found;
        for (const char* ending : {".png", ".tga", ".tif", ".tiff", ".jpg", ".jpeg", ".bmp"})
            if (TexturePlaces looked; found.empty()) {
                found = textures_.find(stem + ending, looked);
                if (!found.empty() && !unread_kind(found).empty()) found.clear(); // its ending says otherwise
            }
        if (noted_.insert(file).second)
            unread_.push_back(
                text +
                (found.empty()
                     ? "its material does without it; a PNG, TGA, TIFF, JPEG or BMP of that name beside it is taken"
                     : found + " is taken"));
        return found;
    }

    int add_image(const std::string& key, const std::string& name, std::string type, std::string bytes) {
        image_.emplace(key, int(mesh_.image.size()));
        mesh_.image.push_back({valid_utf8(name), std::move(type), std::move(bytes)});
        return int(mesh_.image.size()) - 1;
    }
    int known(const std::string& key) const {
        const auto found = image_.find(key);
        return found == image_.end() ? -1 : found->second;
    }

    int plain_image(const Map* map) {
        if (!map) return -1;
        const std::string key = path_of(*map);
        if (const int index = known(key); index >= 0) return index;
        const Texture* const found = texture(map);
        if (!found) return -1;
        const std::string name = image_name(map->file);
        if (!found->type.empty()) return add_image(key, name, found->type, found->bytes);
        return add_image(key, name, "image/png",
                         png_of(found->pixels.width, found->pixels.height, 4, found->pixels.rgba));
    }

    // The image of a material's colour and its mask; materials that share both share it, and its files are decoded once.
    struct Base {
        int image = -1;
        bool masked = false;
    };
    Base base_image(const Map* color, const Map* opacity) {
        const auto key = std::pair(color ? path_of(*color) : "", opacity ? path_of(*opacity) : "");
        const auto [found, added] = base_.try_emplace(key);
        if (added) found->second.image = made_base(color, opacity, found->second.masked);
        return found->second;
    }
    int made_base(const Map* color, const Map* opacity, bool& masked) {
        const Texture* const base = texture(color);
        const Texture* const mask = texture(opacity);
        masked = mask || (base && base->pixels.transparent());
        if (!mask || (base == mask && base->pixels.transparent() && !flip_opacity_)) return plain_image(color);
        const std::string key = (base ? path_of(*color) : "") + "\n" + path_of(*opacity);
        const Pixels& from = base ? base->pixels : mask->pixels;
        const int channel = mask->pixels.transparent() ? 3 : 0;
        std::vector<std::uint8_t> rgba = base ? from.rgba : std::vector<std::uint8_t>(from.rgba.size(), 255);
        for (int y = 0; y < from.height; ++y)
            for (int x = 0; x < from.width; ++x) {
                const std::uint8_t alpha = channel_at(mask->pixels, channel, x, y, from.width, from.height);
                rgba[4 * (std::size_t(y) * std::size_t(from.width) + std::size_t(x)) + 3] =
                    flip_opacity_ ? std::uint8_t(255 - alpha) : alpha;
            }
        return add_image(key, image_name(base ? color->file : opacity->file), "image/png",
                         png_of(from.width, from.height, 4, rgba));
    }

    // `inverted`: the map is gloss, not roughness.
    int gloss_image(const Map* map, bool inverted) {
        if (!map || path_of(*map).empty()) return -1;
        const std::string key = path_of(*map) + (inverted ? "\ngloss" : "\nroughness");
        if (const int index = known(key); index >= 0) return index;
        const Texture* const found = texture(map);
        if (!found) return -1;
        const Pixels& from = found->pixels;
        std::vector<std::uint8_t> rgb(from.rgba.size() / 4 * 3, 0);
        for (std::size_t k = 0; k < rgb.size() / 3; ++k)
            rgb[3 * k + 1] = inverted ? std::uint8_t(255 - from.rgba[4 * k]) : from.rgba[4 * k];
        return add_image(key, image_name(map->file) + " roughness", "image/png",
                         png_of(from.width, from.height, 3, rgb));
    }

    const std::string& name_;
    TextureFinder textures_;
    const bool flip_opacity_;
    OwnMesh& mesh_;
    ImportNotes& notes_;
    std::map<std::string, std::string> path_; // of the names that maps have
    std::map<std::string, std::string> read_; // of a path, as a map leads to it: what messages show
    std::map<std::string, Texture> texture_;  // by paths, as all below
    std::map<std::string, int> image_;
    std::map<std::pair<std::string, std::string>, Base> base_;
    std::vector<std::pair<std::string, TexturePlaces>> missing_;
    std::set<std::string> noted_;     // files of kinds that are not read
    std::vector<std::string> unread_; // notes of them
    std::set<const Map*> used_;
    std::set<std::string> left_out_;
};

} // namespace

Vec3 color_of(const MeshMaterial& material) {
    const Map* const map = color_map(material);
    return map && map->color ? Vec3(map->color->cwiseMax(0).cwiseMin(1)) : Vec3(Vec3::Constant(0.8));
}

void add_materials(const speedtree::MeshFile& file, const std::string& name, const std::string& folder, OwnMesh& mesh,
                   ImportNotes& notes) {
    Builder builder(name, folder, file.flip_opacity, mesh, notes);
    for (const MeshMaterial& material : file.materials) builder.add(material);
    MeshMaterial none;
    none.name = "none";
    builder.add(none);
    builder.add_notes();
}

} // namespace bough
