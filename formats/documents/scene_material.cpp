#include "scene_parts.h"

namespace bough {

using nlohmann::json;
using nlohmann::ordered_json;

MaterialChange read_material_change(const json& value, const std::string& name) {
    MaterialChange change;
    ObjectReader object(value, name, "/material");
    for (const auto& [key, number] : {std::pair{"E", &change.youngs_modulus},
                                      {"G", &change.shear_modulus},
                                      {"density", &change.density},
                                      {"damping_ratio", &change.damping_ratio},
                                      {"root_stiffness", &change.root_stiffness}})
        if (object.has(key)) object.read(key, number->emplace());
    object.finish();
    return change;
}

ordered_json value_of(const MaterialChange& change) {
    ordered_json fields = ordered_json::object();
    if (change.youngs_modulus) fields["E"] = *change.youngs_modulus;
    if (change.shear_modulus) fields["G"] = *change.shear_modulus;
    if (change.density) fields["density"] = *change.density;
    if (change.damping_ratio) fields["damping_ratio"] = *change.damping_ratio;
    if (change.root_stiffness) fields["root_stiffness"] = *change.root_stiffness;
    return fields;
}

} // namespace bough
