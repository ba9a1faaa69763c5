#include "gltf_references.h"
#include <algorithm>
#include <array>

namespace bough::gltf_references {
namespace {

// Known: those whose references are followed below, and those that have none to accessors, views or bytes.
bool is_known(std::string_view name) {
    constexpr std::array<std::string_view, 4> begins{"KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_"};
    constexpr std::array<std::string_view, 9> whole{
        "EXT_mesh_gpu_instancing",    "EXT_meshopt_compression", "KHR_animation_pointer",
        "KHR_draco_mesh_compression", "KHR_lights_punctual",     "KHR_mesh_quantization",
        "KHR_node_visibility",        "KHR_xmp_json_ld",         "EXT_lights_image_based"};
    return std::any_of(begins.begin(), begins.end(), [&](std::string_view b) { return name.starts_with(b); }) ||
           std::find(whole.begin(), whole.end(), name) != whole.end();
}

} // namespace

std::string unknown_extension(const Json& json) {
    if (!json.is_structured()) return "";
    if (json.is_object() && json.contains("extensions"))
        for (const auto& [name, content] : json["extensions"].items())
            if (!is_known(name)) return name;
    for (const auto& [key, value] : json.items()) {
        if (key == "extras") continue;
        if (std::string found = unknown_extension(value); !found.empty()) return found;
    }
    return "";
}

} // namespace bough::gltf_references
