#include "own_maps.h"
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

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
    Files(const OwnMesh& mesh, const std::string& mtl, OwnMaps& to)
        : mesh_(mesh), to_(to), folder_(std::filesystem::path(mtl).stem().string() + "_textures/"),
          name_(mesh.image.size()) {}

    // The file of the texture that a material names, "" where it names none.
    std::string of(const json& material, const char* texture) {
        const json* at = &material;
        if (texture == std::string("baseColorTexture")) {
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
        const auto taken = [&] {
            return std::any_of(to_.image.begin(), to_.image.end(), [&](const ImageFile& f) { return f.name == name; });
        };
        for (int k = 2; taken(); ++k) name = stem + "_" + std::to_string(k) + kind;
        to_.image.push_back({name, &image.bytes});
        return name;
    }

private:
    const OwnMesh& mesh_;
    OwnMaps& to_;
    std::string folder_;
    std::vector<std::string> name_; // of each image, once it has one
};

} // namespace

OwnMaps maps_of(const OwnMesh& mesh, const std::string& mtl) {
    OwnMaps maps;
    Files files(mesh, mtl, maps);
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
