// gltf_shape.h: what kind the values of a glTF document are of that are read most (glTF 2.0, chapter 5), looked at once, so that a reader need not
// say it of each.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bough {

// Throws InputError with the place of the first value that is of another kind, or is missing though glTF asks for it. An optional one may be
// null. Nothing is said of names that glTF does not have, of extras, and of what stands in extensions. O(document).
void require_gltf_shape(const nlohmann::ordered_json& document, const std::string& name);

} // namespace bough
