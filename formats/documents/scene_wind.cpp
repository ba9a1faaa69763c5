#include "lib/base/counted.h"
#include "scene_parts.h"

namespace bough {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

// One number, or a list of them.
void read_each(ObjectReader& object, const std::string& key, std::vector<double>& to) {
    if (!object.has(key)) return;
    const json& value = object.need(key);
    if (value.is_array()) return object.read(key, to);
    if (!value.is_number())
        object.fail(key, "is " + text_of(ordered_json(value)) + ", expected a number or a list of them");
    to = {value.get<double>()};
}

void read_each(ObjectReader& object, const std::string& name, const std::string& key, std::vector<std::int32_t>& to) {
    if (!object.has(key)) return;
    const json& value = object.need(key);
    if (!value.is_array()) {
        to.assign(1, 0);
        return object.read(key, to.front());
    }
    to.clear();
    for (const json& entry : value) {
        if (!entry.is_number_integer() || entry.get<double>() != entry.get<std::int32_t>())
            throw InputError(name + ": " + object.at(key) + "/" + std::to_string(to.size()),
                             "is " + text_of(ordered_json(entry)) + ", expected an integer of 32 bits");
        to.push_back(entry.get<std::int32_t>());
    }
}

// [x, z]
void read_point(ObjectReader& object, const std::string& key, double& x, double& z) {
    std::vector<double> numbers{x, z};
    object.read(key, numbers);
    if (numbers.size() != 2)
        object.fail(key, "has " + counted(numbers.size(), "number", "numbers") + ", expected 2 (x, z)");
    x = numbers[0];
    z = numbers[1];
}

WindGrid read_grid(const json& value, const std::string& name, const std::string& at) {
    WindGrid grid;
    ObjectReader object(value, name, at);
    object.need("origin");
    read_point(object, "origin", grid.x, grid.z);
    for (const auto& [key, number] : {std::pair{"columns", &grid.columns}, {"rows", &grid.rows}}) {
        object.need(key);
        object.read(key, *number);
    }
    object.need("cell");
    object.read("cell", grid.cell);
    object.read("velocity", grid.velocity);
    if (object.has("velocity") && grid.velocity.empty())
        object.fail("velocity", "is empty, expected one [x, y, z], or one for each cell");
    read_each(object, name, "octaves", grid.octaves);
    read_each(object, "persistence", grid.persistence);
    read_each(object, "phase", grid.phase);
    object.read("frequency", grid.frequency);
    object.finish();
    return grid;
}

WindSwirl read_swirl(const json& value, const std::string& name, const std::string& at) {
    WindSwirl swirl;
    ObjectReader object(value, name, at);
    read_point(object, "center", swirl.x, swirl.z);
    object.read("radius", swirl.radius);
    object.need("angle");
    read_each(object, "angle", swirl.angle);
    object.read("period", swirl.period);
    if (object.has("wavelength")) object.read("wavelength", swirl.wavelength.emplace());
    object.finish();
    return swirl;
}

// One value by itself, more as a list.
template <class A> ordered_json each(const std::vector<A>& list) {
    return list.size() == 1 ? ordered_json(list.front()) : ordered_json(list);
}

ordered_json value_of(const WindGrid& grid) {
    ordered_json fields{
        {"origin", {grid.x, grid.z}}, {"cell", grid.cell}, {"columns", grid.columns}, {"rows", grid.rows}};
    if (grid.velocity.size() == 1)
        fields["velocity"] = numbers(grid.velocity.front());
    else
        for (const Vec3& v : grid.velocity) fields["velocity"].push_back(numbers(v));
    fields["octaves"] = each(grid.octaves);
    fields["persistence"] = each(grid.persistence);
    fields["phase"] = each(grid.phase);
    fields["frequency"] = grid.frequency;
    return fields;
}

ordered_json value_of(const WindSwirl& swirl) {
    ordered_json fields{{"center", {swirl.x, swirl.z}}};
    if (!swirl.radius.empty()) fields["radius"] = swirl.radius;
    fields["angle"] = swirl.radius.empty() ? each(swirl.angle) : ordered_json(swirl.angle);
    fields["period"] = swirl.period;
    if (swirl.wavelength) fields["wavelength"] = *swirl.wavelength;
    return fields;
}

} // namespace

// at: the wind's own JSON pointer.
void read_wind_fields(ObjectReader& object, Wind& wind, const std::string& name, const std::string& at) {
    object.need("velocity");
    object.read("velocity", wind.velocity);
    object.read("reference_height", wind.reference_height);
    object.read("profile", wind.profile);
    object.read("turbulence", wind.turbulence);
    object.read("gust_factor", wind.gust_factor);
    object.read("gust_period", wind.gust_period);
    object.read("seed", wind.seed);
    if (object.has("grid")) wind.grid = read_grid(object.need("grid"), name, at + "/grid");
    if (object.has("swirl")) wind.swirl = read_swirl(object.need("swirl"), name, at + "/swirl");
    if (object.has("shelter")) {
        ObjectReader shelter(object.need("shelter"), name, at + "/shelter");
        shelter.need("cell");
        shelter.read("cell", wind.shelter.emplace().cell);
        shelter.finish();
    }
    if (object.has("period")) object.read("period", wind.period.emplace());
    object.finish();
}

Wind read_wind_value(const json& value, const std::string& name) {
    if (value.is_string()) {
        const std::string preset = value.get<std::string>();
        if (const std::optional<Wind> wind = wind_preset(preset)) return *wind;
        throw InputError(name + ": /wind",
                         "is " + in_quotes(preset) + ", expected calm, breeze, gusty, storm or an object");
    }
    Wind wind;
    ObjectReader object(value, name, "/wind");
    read_wind_fields(object, wind, name, "/wind");
    return wind;
}

ordered_json value_of(const Wind& wind) {
    ordered_json fields{{"velocity", numbers(wind.velocity)},
                        {"reference_height", wind.reference_height},
                        {"profile", wind.profile},
                        {"turbulence", wind.turbulence},
                        {"gust_factor", wind.gust_factor},
                        {"gust_period", wind.gust_period},
                        {"seed", wind.seed}};
    if (wind.grid) fields["grid"] = value_of(*wind.grid);
    if (wind.swirl) fields["swirl"] = value_of(*wind.swirl);
    if (wind.shelter) fields["shelter"] = {{"cell", wind.shelter->cell}};
    if (wind.period) fields["period"] = *wind.period;
    return fields;
}

} // namespace bough
