#include "own_maps.h"
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace bough {
namespace {

using nlohmann::json;

// A file's name without what a folder or an .mtl's line would take for something else.
std::string plain(const std::string& name) {
    std::string out;
    for (const char c : name) {
        const bool good =
            (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
        out += good ? c : '_';
    }
    return out.empty() ? "image" : out;
}

class Files {
public:
    Files(const OwnMesh& mesh, const std::string& file, std::vector<ImageFile>& to)
        : mesh_(mesh), to_(to), folder_(std::filesystem::path(file).stem().string() + "_textures/"),
          name_(mesh.image.size()) {}

    // The file of the texture that a material names, "" where it names none.
    std::string of(const json& material, const std::string& texture) {
        const json* at = &material;
        if (texture == "baseColorTexture" || texture == "metallicRoughnessTexture") {
            if (!material.contains("pbrMetallicRoughness")) return "";
            at = &material.at("pbrMetallicRoughness");
        }
        if (!at->contains(texture)) return "";
        const auto index = at->at(texture).at("index").get<std::size_t>();
        std::string& name = name_.at(index);
        if (!name.empty()) return name;
        const OwnImage& image = mesh_.image.at(index);
        const std::string stem = folder_ + plain(std::filesystem::path(image.name).stem().string()),
                          kind = image.type == "image/jpeg" ? ".jpg" : ".png";
        name = stem + kind;
        for (int& k = next_.try_emplace(stem, 2).first->second; !taken_.insert(name).second; ++k)
            name = stem + "_" + std::to_string(k) + kind;
        to_.push_back({name, &image.bytes});
        return name;
    }

private:
    const OwnMesh& mesh_;
    std::vector<ImageFile>& to_;
    std::string folder_;
    std::vector<std::string> name_; // of each image, once it has one
    std::set<std::string> taken_;
    std::map<std::string, int> next_; // of each name without ending that was asked for: the number to try next
};

OwnLook look_of(const json& material) {
    OwnLook look;
    const json pbr = material.value("pbrMetallicRoughness", json::object());
    const json factor = pbr.value("baseColorFactor", json::array({1, 1, 1, 1}));
    for (std::size_t k = 0; k < 3; ++k) look.color[int(k)] = factor.at(k).get<double>();
    look.metallic = pbr.value("metallicFactor", 1.0);
    look.roughness = pbr.value("roughnessFactor", 1.0);
    look.cutoff = material.value("alphaCutoff", 0.5);
    look.cut = material.value("alphaMode", "OPAQUE") != "OPAQUE";
    look.two_sided = material.value("doubleSided", false);
    return look;
}

} // namespace

OwnLook look_of(const std::string& material) {
    return look_of(json::parse(material));
}

OwnLooks looks_of(const OwnMesh& mesh, const std::string& file) {
    OwnLooks looks;
    Files files(mesh, file, looks.image);
    for (const OwnPart& part : mesh.part) {
        if (part.material < 0 || std::size_t(part.material) >= mesh.material.size()) {
            looks.part.emplace_back();
            continue;
        }
        const json material = json::parse(mesh.material[std::size_t(part.material)]);
        OwnLook& look = looks.part.emplace_back(look_of(material));
        look.color_map = files.of(material, "baseColorTexture");
        look.normal_map = files.of(material, "normalTexture");
        look.roughness_map = files.of(material, "metallicRoughnessTexture");
        look.occlusion_map = files.of(material, "occlusionTexture");
        look.cut &= !look.color_map.empty();
    }
    return looks;
}

OwnMaps maps_of(const OwnMesh& mesh, const std::string& mtl) {
    OwnMaps maps;
    Files files(mesh, mtl, maps.image);
    for (const OwnPart& part : mesh.part) {
        MtlMaps& of_part = maps.part.emplace_back();
        if (part.material < 0 || std::size_t(part.material) >= mesh.material.size()) continue;
        const json material = json::parse(mesh.material[std::size_t(part.material)]);
        of_part.color = files.of(material, "baseColorTexture");
        of_part.normal = files.of(material, "normalTexture");
        of_part.cut = !of_part.color.empty() && material.value("alphaMode", "OPAQUE") != "OPAQUE";
    }
    return maps;
}

} // namespace bough
