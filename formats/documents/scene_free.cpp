#include "scene_parts.h"

namespace bough {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

const std::vector<std::string> contact_models{"impulse", "penalty"};

} // namespace

Fracture read_fracture(const json& value, const std::string& name) {
    Fracture fracture;
    ObjectReader object(value, name, "/fracture");
    for (const auto& [key, torque] : {std::pair{"branch", &fracture.branch},
                                      {"leaf", &fracture.leaf},
                                      {"petal", &fracture.petal},
                                      {"fruit", &fracture.fruit},
                                      {"strength", &fracture.strength},
                                      {"spread", &fracture.spread}})
        object.read(key, *torque);
    object.read("seed", fracture.seed);
    for (const json& entry : object.list("joints")) {
        const std::string at = object.at("joints") + "/" + std::to_string(fracture.joints.size());
        ObjectReader joint(entry, name, at);
        Fracture::Joint& to = fracture.joints.emplace_back();
        to.on = read_selector(joint.need("on"), name, joint.at("on"));
        joint.read("torque", to.torque);
        joint.finish();
    }
    object.finish();
    return fracture;
}

Ball read_ball(const json& value, const std::string& name, const std::string& at) {
    Ball ball;
    ObjectReader object(value, name, at);
    object.need("position");
    object.read("position", ball.position);
    object.read("velocity", ball.velocity);
    object.read("angular_velocity", ball.angular_velocity);
    object.need("radius");
    object.read("radius", ball.radius);
    object.need("mass");
    object.read("mass", ball.mass);
    object.finish();
    return ball;
}

Contact read_contact(const json& value, const std::string& name) {
    Contact contact;
    ObjectReader object(value, name, "/contact");
    contact.model = ContactModel(object.word("model", contact_models, std::size_t(contact.model)));
    object.read("restitution", contact.restitution);
    object.read("friction", contact.friction);
    object.read("rolling", contact.rolling);
    object.read("penalty", contact.penalty);
    object.read("trees", contact.trees);
    object.read("leaves", contact.leaves);
    object.read("ground", contact.ground);
    object.read("ground_height", contact.ground_height);
    object.finish();
    return contact;
}

LeafAir read_leaves(const json& value, const std::string& name) {
    LeafAir leaves;
    ObjectReader object(value, name, "/leaves");
    object.read("kappa", leaves.kappa);
    object.read("air_resistance", leaves.air_resistance);
    object.read("drag_ratio", leaves.drag_ratio);
    object.read("offset", leaves.offset);
    object.finish();
    return leaves;
}

// JSON has no infinity: what never breaks is left out.
ordered_json value_of(const Fracture& fracture) {
    ordered_json fields = ordered_json::object();
    for (const auto& [key, torque] : {std::pair{"branch", fracture.branch},
                                      {"leaf", fracture.leaf},
                                      {"petal", fracture.petal},
                                      {"fruit", fracture.fruit},
                                      {"strength", fracture.strength}})
        if (torque < Fracture::never) fields[key] = torque;
    fields["spread"] = fracture.spread;
    fields["seed"] = fracture.seed;
    for (const Fracture::Joint& joint : fracture.joints) {
        ordered_json entry{{"on", value_of(joint.on)}};
        if (joint.torque < Fracture::never) entry["torque"] = joint.torque;
        fields["joints"].push_back(entry);
    }
    return fields;
}

ordered_json value_of(const Ball& ball) {
    return {{"position", numbers(ball.position)},
            {"velocity", numbers(ball.velocity)},
            {"angular_velocity", numbers(ball.angular_velocity)},
            {"radius", ball.radius},
            {"mass", ball.mass}};
}

ordered_json value_of(const Contact& contact) {
    return {{"model", contact_models[std::size_t(contact.model)]},
            {"restitution", contact.restitution},
            {"friction", contact.friction},
            {"rolling", contact.rolling},
            {"penalty", contact.penalty},
            {"trees", contact.trees},
            {"leaves", contact.leaves},
            {"ground", contact.ground},
            {"ground_height", contact.ground_height}};
}

ordered_json value_of(const LeafAir& leaves) {
    return {{"kappa", leaves.kappa},
            {"air_resistance", leaves.air_resistance},
            {"drag_ratio", leaves.drag_ratio},
            {"offset", leaves.offset}};
}

} // namespace bough
