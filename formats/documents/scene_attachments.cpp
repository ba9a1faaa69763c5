#include "scene_parts.h"

namespace bough {

using nlohmann::json;
using nlohmann::ordered_json;

Attachment read_attachment(const json& value, const std::string& name, const std::string& at) {
    Attachment held;
    ObjectReader object(value, name, at);
    held.on = read_selector(object.need("on"), name, object.at("on"));
    if (object.has("with")) held.with = read_selector(object.need("with"), name, object.at("with"));
    if (object.has("target")) object.read("target", held.target.emplace());
    object.read("time", held.time);
    object.read("position", held.position);
    if (held.time.empty() && object.has("time")) object.fail("time", "has 0 times, expected at least 2");
    object.read("stiffness", held.stiffness);
    object.read("damping", held.damping);
    object.read("from", held.from);
    object.read("to", held.to);
    object.finish();
    return held;
}

ordered_json value_of(const Attachment& held) {
    ordered_json fields{{"on", value_of(held.on)}};
    if (held.with) fields["with"] = value_of(*held.with);
    if (held.target) fields["target"] = numbers(*held.target);
    if (!held.time.empty()) fields["time"] = held.time;
    for (const Vec3& p : held.position) fields["position"].push_back(numbers(p));
    fields["stiffness"] = held.stiffness;
    fields["damping"] = held.damping;
    if (std::isfinite(held.from)) fields["from"] = held.from;
    if (std::isfinite(held.to)) fields["to"] = held.to;
    return fields;
}

} // namespace bough
