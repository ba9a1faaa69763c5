#include "check_parts.h"

namespace bough {

std::optional<Defect> check(const Fracture& fracture, std::size_t trees) {
    const auto torque = [](const std::string& field, double value) -> std::optional<Defect> {
        if (value >= 0) return std::nullopt; // NaN is not
        return Defect{"fracture/" + field, -1, "is " + shortest_text(value) + ", expected 0 or more"};
    };
    for (const auto& [field, value] : {std::pair{"branch", fracture.branch},
                                       {"leaf", fracture.leaf},
                                       {"petal", fracture.petal},
                                       {"fruit", fracture.fruit},
                                       {"strength", fracture.strength}})
        if (auto defect = torque(field, value)) return defect;
    if (auto defect = at_least("fracture/spread", fracture.spread, 0)) return defect;
    for (std::size_t i = 0; i < fracture.joints.size(); ++i) {
        const std::string at = "joints/" + std::to_string(i);
        if (auto defect = check(fracture.joints[i].on, "fracture/" + at + "/on", trees)) return defect;
        if (auto defect = torque(at + "/torque", fracture.joints[i].torque)) return defect;
    }
    return std::nullopt;
}

std::optional<Defect> check(const Ball& ball, const std::string& at) {
    if (auto defect = not_too_far(at + "/position", ball.position)) return defect;
    if (auto defect = not_too_far(at + "/velocity", ball.velocity)) return defect;
    if (auto defect = finite(at + "/angular_velocity", ball.angular_velocity)) return defect;
    if (auto defect = above_zero(at + "/radius", ball.radius)) return defect;
    if (auto defect = not_too_far(at + "/radius", ball.radius)) return defect;
    return above_zero(at + "/mass", ball.mass);
}

std::optional<Defect> check(const Contact& contact) {
    if (auto defect = one_of("contact/model", std::size_t(contact.model), {"impulse", "penalty"})) return defect;
    if (!(contact.restitution >= 0 && contact.restitution <= 1))
        return Defect{"contact/restitution", -1, "is " + shortest_text(contact.restitution) + ", expected 0 to 1"};
    if (auto defect = at_least("contact/friction", contact.friction, 0)) return defect;
    if (auto defect = at_least("contact/rolling", contact.rolling, 0)) return defect;
    if (auto defect = at_least("contact/penalty", contact.penalty, 0)) return defect;
    if (!std::isfinite(contact.ground_height))
        return Defect{"contact/ground_height", -1, "is not finite, expected metres"};
    return not_too_far("contact/ground_height", contact.ground_height);
}

} // namespace bough
