// scene_parts.h: the parts of a scene's document, each read from and written as a JSON value. `name`: the file; `at`: the part's JSON pointer.
#pragma once
#include "lib/model/scene.h"
#include "scene_fields.h"

namespace bough {

std::string text_of(const nlohmann::ordered_json&);
nlohmann::ordered_json numbers(const Vec3&);

// ---- scene_select.cpp ----
Selector read_selector(const nlohmann::json&, const std::string& name, const std::string& at);
nlohmann::ordered_json value_of(const Selector&);

// ---- scene_wind.cpp ----
void read_wind_fields(ObjectReader&, Wind&, const std::string& name, const std::string& at);
Wind read_wind_value(const nlohmann::json&, const std::string& name);
nlohmann::ordered_json value_of(const Wind&);

// ---- scene_free.cpp: what is free, and leaves in the air ----
Fracture read_fracture(const nlohmann::json&, const std::string& name);
Ball read_ball(const nlohmann::json&, const std::string& name, const std::string& at);
Contact read_contact(const nlohmann::json&, const std::string& name);
LeafAir read_leaves(const nlohmann::json&, const std::string& name);
nlohmann::ordered_json value_of(const Fracture&);
nlohmann::ordered_json value_of(const Ball&);
nlohmann::ordered_json value_of(const Contact&);

// ---- scene_simulate.cpp: which joints move ----
Simulate read_simulate(const nlohmann::json&, const std::string& name);
nlohmann::ordered_json value_of(const Simulate&);

} // namespace bough
