#include "formats/documents/material.h"
#include <catch2/catch.hpp>

using namespace bough;

namespace {

std::string with(const std::string& fields) {
    return "{\"format\": \"bough-material\", \"version\": 1" + (fields.empty() ? "" : ", " + fields) + "}";
}

std::string material_error(const std::string& content) {
    try {
        read_material(content, "my.json");
    } catch (const InputError& e) {
        return e.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("a material file without numbers is the default preset under the file's name") {
    const Material m = read_material(with(""), "my.json"), preset = wood_presets().front();
    CHECK(m.name == "my.json");
    CHECK(m.density == preset.density);
    CHECK(m.fruit_damping_ratio == preset.fruit_damping_ratio);
}

TEST_CASE("a material file's fields replace those of the preset it is like") {
    const Material m = read_material(
        with("\"like\": \"black-willow\", \"name\": \"stiff willow\", \"source\": \"me\", \"density\": 901, "
             "\"youngs_modulus\": 8e9, \"shear_modulus\": 5.5e8, \"damping_ratio\": 0.02, \"leaf_density\": 700, "
             "\"leaf_thickness\": 3e-4, \"leaf_modulus\": 1e9, \"leaf_damping_ratio\": 0, \"fruit_density\": 950"),
        "my.json");
    CHECK(m.name == "stiff willow");
    CHECK(m.source == "me");
    CHECK(m.density == 901);
    CHECK(m.youngs_modulus == 8e9);
    CHECK(m.shear_modulus == 5.5e8);
    CHECK(m.damping_ratio == 0.02);
    CHECK(m.leaf_density == 700);
    CHECK(m.leaf_thickness == 3e-4);
    CHECK(m.leaf_modulus == 1e9);
    CHECK(m.leaf_damping_ratio == 0);
    CHECK(m.fruit_density == 950);
    CHECK(m.fruit_damping_ratio == find_wood("black-willow")->fruit_damping_ratio);
}

TEST_CASE("what is wrong in a material file is said in one line with its place") {
    CHECK_THAT(material_error(""), Catch::StartsWith("my.json:1: "));
    CHECK_THAT(material_error("{\n\"format\": \"bough-material\",\n\"version\" 1}"), Catch::StartsWith("my.json:3: "));
    CHECK_THAT(material_error("[1]"), Catch::Contains("expected an object"));
    CHECK_THAT(material_error("{\"version\": 1}"), Catch::StartsWith("my.json: /format: "));
    CHECK_THAT(material_error("{\"format\": \"bough-tree\", \"version\": 1}"), Catch::Contains("bough-material"));
    CHECK_THAT(material_error("{\"format\": \"bough-material\", \"version\": 2}"),
               Catch::StartsWith("my.json: /version: "));
    CHECK_THAT(material_error(with("\"densty\": 900")), Catch::StartsWith("my.json: /densty: "));
    CHECK_THAT(material_error(with("\"density\": \"900\"")), Catch::Contains("/density: is string, expected a number"));
    CHECK_THAT(material_error(with("\"like\": \"red\\noak\"")),
               Catch::Contains("/like: is \"red?oak\", expected one of"));
    CHECK_THAT(material_error(with("\"density\": 900, \"density\": 901")), Catch::Contains("/density: is given twice"));
    CHECK_THAT(material_error(with("\"density\": -900")), Catch::Contains("/density: is not a finite number above 0"));
    CHECK_THAT(material_error(with("\"density\": 1e999")), Catch::Contains("too large"));
    CHECK_THAT(material_error(with("\"name\": 3")), Catch::Contains("/name: is number, expected text"));
    CHECK_THAT(material_error(with("\"like\": \"granite\"")),
               Catch::Contains("expected one of red-maple, sugar-maple"));
    CHECK_THAT(material_error(with("\"density\": 900") + "x"), Catch::StartsWith("my.json:1: "));
}
