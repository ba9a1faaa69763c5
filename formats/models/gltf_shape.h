// gltf_shape.h: what kind each value of a glTF document is of (glTF 2.0, chapter 5), looked at once, so that its readers need not say it of each.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bough {

// Throws InputError with the place of the first value that is of another kind, or is missing though glTF asks for it. Of names that glTF does not have,
// extras and extensions nothing is said. O(document).
void require_gltf_shape(const nlohmann::ordered_json& document, const std::string& name);

} // namespace bough
