#include "scene_parts.h"

namespace bough {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

WoodFactors read_factors(const json& value, const std::string& name, const std::string& at) {
    WoodFactors factors;
    ObjectReader object(value, name, at);
    object.read("stiffness", factors.stiffness);
    object.read("damping", factors.damping);
    object.read("density", factors.density);
    object.finish();
    return factors;
}

WoodCurve read_curve(const json& value, const std::string& name, const std::string& at) {
    WoodCurve curve;
    ObjectReader object(value, name, at);
    if (object.has("on")) curve.on = read_selector(object.need("on"), name, object.at("on"));
    object.need("radius");
    object.read("radius", curve.radius);
    // A list that is there but empty is one key short for each radius, not a list left out.
    for (const auto& [key, values] : {std::pair{"stiffness", &curve.stiffness}, {"damping", &curve.damping}}) {
        object.read(key, *values);
        if (object.has(key) && values->empty() && !curve.radius.empty())
            object.fail(key, "has 0 keys, expected " + std::to_string(curve.radius.size()) + " (one for each radius)");
    }
    object.read("relative", curve.relative);
    object.finish();
    return curve;
}

WoodFork read_fork(const json& value, const std::string& name) {
    WoodFork fork;
    ObjectReader object(value, name, "/wood/fork");
    object.need("factor");
    object.read("factor", fork.factor);
    object.need("length");
    object.read("length", fork.length);
    object.finish();
    return fork;
}

} // namespace

Wood read_wood(const json& value, const std::string& name) {
    Wood wood;
    ObjectReader object(value, name, "/wood");
    for (const auto& [kind, factors] :
         {std::pair{"branch", &wood.branch}, {"leaf", &wood.leaf}, {"petal", &wood.petal}, {"fruit", &wood.fruit}})
        if (object.has(kind)) *factors = read_factors(object.need(kind), name, object.at(kind));
    for (const json& curve : object.list("curves"))
        wood.curves.push_back(read_curve(curve, name, "/wood/curves/" + std::to_string(wood.curves.size())));
    if (object.has("fork")) wood.fork = read_fork(object.need("fork"), name);
    object.finish();
    return wood;
}

StaticLoad read_load(const json& value, const std::string& name) {
    StaticLoad load;
    ObjectReader object(value, name, "/load");
    object.read("branch", load.branch);
    object.read("leaf", load.leaf);
    object.read("petal", load.petal);
    object.read("fruit", load.fruit);
    object.finish();
    return load;
}

Fictitious read_fictitious(const json& value, const std::string& name) {
    Fictitious terms;
    ObjectReader object(value, name, "/fictitious");
    object.read("acceleration", terms.acceleration);
    object.read("turning", terms.turning);
    object.read("gyroscopic", terms.gyroscopic);
    object.finish();
    return terms;
}

ordered_json value_of(const Wood& wood) {
    ordered_json fields = ordered_json::object();
    for (const auto& [kind, factors] :
         {std::pair{"branch", &wood.branch}, {"leaf", &wood.leaf}, {"petal", &wood.petal}, {"fruit", &wood.fruit}})
        fields[kind] = {
            {"stiffness", factors->stiffness}, {"damping", factors->damping}, {"density", factors->density}};
    for (const WoodCurve& curve : wood.curves) {
        ordered_json entry = ordered_json::object();
        if (curve.on) entry["on"] = value_of(*curve.on);
        entry["radius"] = curve.radius;
        if (!curve.stiffness.empty()) entry["stiffness"] = curve.stiffness;
        if (!curve.damping.empty()) entry["damping"] = curve.damping;
        entry["relative"] = curve.relative;
        fields["curves"].push_back(entry);
    }
    if (wood.fork) fields["fork"] = {{"factor", wood.fork->factor}, {"length", wood.fork->length}};
    return fields;
}

ordered_json value_of(const StaticLoad& load) {
    return {{"branch", load.branch}, {"leaf", load.leaf}, {"petal", load.petal}, {"fruit", load.fruit}};
}

ordered_json value_of(const Fictitious& terms) {
    return {{"acceleration", terms.acceleration}, {"turning", terms.turning}, {"gyroscopic", terms.gyroscopic}};
}

} // namespace bough
