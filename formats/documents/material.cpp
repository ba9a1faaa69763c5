#include "material.h"
#include "formats/json_shape.h"
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace bough {

namespace {

using Json = nlohmann::ordered_json;

struct Number {
    const char* name;
    double Material::*value;
};

constexpr Number number_fields[] = {
    {"density", &Material::density},
    {"youngs_modulus", &Material::youngs_modulus},
    {"shear_modulus", &Material::shear_modulus},
    {"damping_ratio", &Material::damping_ratio},
    {"strength", &Material::strength},
    {"leaf_density", &Material::leaf_density},
    {"leaf_thickness", &Material::leaf_thickness},
    {"petal_thickness", &Material::petal_thickness},
    {"leaf_modulus", &Material::leaf_modulus},
    {"leaf_damping_ratio", &Material::leaf_damping_ratio},
    {"fruit_density", &Material::fruit_density},
    {"fruit_damping_ratio", &Material::fruit_damping_ratio},
};

std::string at(const std::string& file, const std::string& field) {
    return file + ": /" + field;
}

Json parse(std::string_view content, const std::string& file) {
    // A value of these is a number or text; a callback costs the square of what stands side by side.
    if (json_shape(content).depth > 2)
        throw InputError(file, "holds lists within lists, expected numbers and text alone");
    std::set<std::string> seen;
    const auto no_field_twice = [&](int depth, Json::parse_event_t event, Json& key) {
        if (event == Json::parse_event_t::key && depth == 1 && !seen.insert(key.get<std::string>()).second)
            throw InputError(at(file, key.get<std::string>()), "is given twice, expected once");
        return true;
    };
    try {
        return Json::parse(content, no_field_twice);
    } catch (const Json::parse_error& e) {
        const auto stop = content.begin() + std::ptrdiff_t(std::min(e.byte, content.size()));
        const auto line = 1 + std::count(content.begin(), stop, '\n');
        throw InputError(file + ":" + std::to_string(line), "is not JSON, expected a material document");
    } catch (const Json::out_of_range&) {
        throw InputError(file, "holds a number too large for a double, expected finite numbers");
    }
}

std::string text(const Json& value, const std::string& file, const std::string& field) {
    if (!value.is_string())
        throw InputError(at(file, field), std::string("is ") + value.type_name() + ", expected text");
    return value.get<std::string>();
}

double number(const Json& value, const std::string& file, const std::string& field) {
    if (!value.is_number())
        throw InputError(at(file, field), std::string("is ") + value.type_name() + ", expected a number");
    return value.get<double>();
}

void check_head(const Json& document, const std::string& file) {
    if (!document.is_object())
        throw InputError(file, std::string("is ") + document.type_name() + ", expected an object");
    const auto format = document.find("format");
    if (format == document.end() || *format != "bough-material")
        throw InputError(at(file, "format"), "is missing or another, expected \"bough-material\"");
    const auto version = document.find("version");
    if (version == document.end() || !version->is_number_integer() || *version != 1)
        throw InputError(at(file, "version"), "is missing or unknown, expected 1");
}

Material base(const Json& document, const std::string& file) {
    const auto like = document.find("like");
    if (like == document.end()) return wood_presets().front();
    const std::string name = text(*like, file, "like");
    if (const Material* found = find_wood(name)) return *found;
    std::string names;
    for (const Material& m : wood_presets()) names += (names.empty() ? "" : ", ") + m.name;
    throw InputError(at(file, "like"), "is \"" + name + "\", expected one of " + names);
}

} // namespace

Material read_material(std::string_view content, const std::string& file) {
    const Json document = parse(content, file);
    check_head(document, file);
    Material material = base(document, file);
    material.source = "like " + material.name + " (" + material.source + ")";
    material.name = file;
    for (const auto& [field, value] : document.items()) {
        if (field == "format" || field == "version" || field == "like") continue;
        if (field == "name") {
            material.name = text(value, file, field);
        } else if (field == "source") {
            material.source = text(value, file, field);
        } else {
            const auto known = std::find_if(std::begin(number_fields), std::end(number_fields),
                                            [&f = field](const Number& n) { return f == n.name; });
            if (known == std::end(number_fields)) throw InputError(at(file, field), "is not a field of a material");
            material.*(known->value) = number(value, file, field);
        }
    }
    if (const auto defect = check(material)) throw InputError(at(file, defect->field), defect->message);
    return material;
}

} // namespace bough
