#include "model_kind.h"
#include "formats/plain_text.h"
#include <algorithm>

namespace bough {

std::optional<AssimpKind> model_kind(std::string_view content) {
    content = without_bom(content);
    if (content.starts_with("Kaydara FBX Binary")) return AssimpKind::fbx;
    if (content.starts_with("glTF")) return AssimpKind::glb;
    const std::size_t first = content.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return {};
    const std::string_view head = content.substr(first, 4096);
    if (head.starts_with("; FBX")) return AssimpKind::fbx;
    if (head[0] == '<' && head.find("<COLLADA") != std::string_view::npos) return AssimpKind::dae;
    if (head[0] == '{' && head.find("\"bough-") == std::string_view::npos &&
        content.find("\"asset\"") != std::string_view::npos)
        return AssimpKind::gltf;
    return {};
}

const char* model_kind_name(AssimpKind kind) {
    switch (kind) {
    case AssimpKind::obj:
        return "OBJ";
    case AssimpKind::fbx:
        return "FBX";
    case AssimpKind::gltf:
    case AssimpKind::glb:
        return "glTF";
    default:
        return "COLLADA";
    }
}

double collada_unit(std::string_view content) {
    const std::size_t unit = content.find("<unit");
    if (unit == std::string_view::npos) return 1;
    const std::string_view element = content.substr(unit, std::min(content.find('>', unit), content.size()) - unit);
    const std::size_t meter = element.find("meter=");
    if (meter == std::string_view::npos || meter + 7 >= element.size()) return 1;
    const std::string_view value = element.substr(meter + 7);
    const std::optional<double> metres = parse_number(value.substr(0, value.find_first_of("\"'")));
    return metres && *metres > 0 ? *metres : 1;
}

} // namespace bough
