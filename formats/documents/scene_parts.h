// scene_parts.h: the parts of a scene's document, each read from and written as a JSON value. `name`: the file; `at`: the part's JSON pointer.
#pragma once
#include "lib/model/scene.h"
#include "scene.h"
#include "scene_fields.h"

namespace bough {

std::string text_of(const nlohmann::ordered_json&);
nlohmann::ordered_json numbers(const Vec3&);

// ---- scene_select.cpp ----
Selector read_selector(const nlohmann::json&, const std::string& name, const std::string& at);
nlohmann::ordered_json value_of(const Selector&);

// ---- scene_trees.cpp: where trees stand, and who walks on them ----
void read_placements(const nlohmann::json&, const std::string& name, const std::string& at, std::vector<Placement>&);
Walker read_walker(const nlohmann::json&, const std::string& name, const std::string& at);
nlohmann::ordered_json value_of(const Placement&);
nlohmann::ordered_json value_of(const Walker&);

// ---- scene_attachments.cpp ----
Attachment read_attachment(const nlohmann::json&, const std::string& name, const std::string& at);
nlohmann::ordered_json value_of(const Attachment&);

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
nlohmann::ordered_json value_of(const LeafAir&);

// ---- scene_material.cpp ----
MaterialChange read_material_change(const nlohmann::json&, const std::string& name);
nlohmann::ordered_json value_of(const MaterialChange&);

// ---- scene_overrides.cpp ----
void override_field(nlohmann::json& document, const SceneOverride&);
// Which of them a place in the document comes of: the one whose path goes along with its JSON pointer farthest.
const SceneOverride& nearest_override(const std::vector<SceneOverride>&, const std::string& at);
// ---- scene_wood.cpp: what trees are made of and carry, and the analytic solver's lagged terms ----
Wood read_wood(const nlohmann::json&, const std::string& name);
StaticLoad read_load(const nlohmann::json&, const std::string& name);
Fictitious read_fictitious(const nlohmann::json&, const std::string& name);
nlohmann::ordered_json value_of(const Wood&);
nlohmann::ordered_json value_of(const StaticLoad&);
nlohmann::ordered_json value_of(const Fictitious&);
// ---- scene_simulate.cpp: which joints move ----
Simulate read_simulate(const nlohmann::json&, const std::string& name);
nlohmann::ordered_json value_of(const Simulate&);

} // namespace bough
