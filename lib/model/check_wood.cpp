#include "../base/counted.h"
#include "check_parts.h"

namespace bough {
namespace {

std::optional<Defect> check(const WoodFactors& factors, const std::string& at) {
    if (auto defect = at_least(at + "/stiffness", factors.stiffness, 0)) return defect;
    if (auto defect = at_least(at + "/damping", factors.damping, 0)) return defect;
    return above_zero(at + "/density", factors.density);
}

std::optional<Defect> check(const WoodCurve& curve, const std::string& at, std::size_t trees) {
    if (curve.on)
        if (auto defect = check(*curve.on, at + "/on", trees)) return defect;
    if (curve.radius.empty()) return Defect{at + "/radius", -1, "is empty, expected at least one radius"};
    for (std::size_t k = 0; k < curve.radius.size(); ++k) {
        const std::string field = at + "/radius/" + std::to_string(k);
        if (auto defect = at_least(field, curve.radius[k], 0)) return defect;
        if (k > 0 && !(curve.radius[k] > curve.radius[k - 1]))
            return Defect{field, -1, "is " + shortest_text(curve.radius[k]) + ", expected more than the one before it"};
    }
    if (curve.stiffness.empty() && curve.damping.empty())
        return Defect{at, -1, "changes nothing, expected stiffness or damping"};
    for (const auto& [key, values] : {std::pair{"/stiffness", &curve.stiffness}, {"/damping", &curve.damping}}) {
        if (!values->empty() && values->size() != curve.radius.size())
            return Defect{at + key, -1,
                          "has " + counted(values->size(), "key", "keys") + ", expected " +
                              std::to_string(curve.radius.size()) + " (one for each radius)"};
        for (std::size_t k = 0; k < values->size(); ++k)
            if (auto defect = at_least(at + key + "/" + std::to_string(k), (*values)[k], 0)) return defect;
    }
    return std::nullopt;
}

} // namespace

std::optional<Defect> check(const Wood& wood, std::size_t trees) {
    for (const auto& [kind, factors] :
         {std::pair{"branch", wood.branch}, {"leaf", wood.leaf}, {"petal", wood.petal}, {"fruit", wood.fruit}})
        if (auto defect = check(factors, std::string("wood/") + kind)) return defect;
    for (std::size_t k = 0; k < wood.curves.size(); ++k)
        if (auto defect = check(wood.curves[k], "wood/curves/" + std::to_string(k), trees)) return defect;
    if (!wood.fork) return std::nullopt;
    if (auto defect = above_zero("wood/fork/factor", wood.fork->factor)) return defect;
    return above_zero("wood/fork/length", wood.fork->length);
}

std::optional<Defect> check(const StaticLoad& load) {
    for (const auto& [kind, value] :
         {std::pair{"branch", load.branch}, {"leaf", load.leaf}, {"petal", load.petal}, {"fruit", load.fruit}})
        if (auto defect = at_least(std::string("load/") + kind, value, 0)) return defect;
    return std::nullopt;
}

std::optional<Defect> check(const Fictitious& terms) {
    for (const auto& [key, value] :
         {std::pair{"acceleration", terms.acceleration}, {"turning", terms.turning}, {"gyroscopic", terms.gyroscopic}})
        if (auto defect = at_least(std::string("fictitious/") + key, value, 0)) return defect;
    return std::nullopt;
}

} // namespace bough
