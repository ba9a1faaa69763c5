#include "check_parts.h"

namespace bough {
namespace {

std::optional<Defect> check_levels(const Simulate& by) {
    for (const auto& [key, level] : {std::pair{"first_level", by.first_level}, {"last_level", by.last_level}})
        if (level && *level < 0)
            return Defect{std::string("simulate/") + key, -1, "is " + std::to_string(*level) + ", expected 0 or more"};
    if (by.first_level && by.last_level && *by.last_level < *by.first_level)
        return Defect{"simulate/last_level", -1,
                      "is " + std::to_string(*by.last_level) + ", expected at least /simulate/first_level, " +
                          std::to_string(*by.first_level)};
    return std::nullopt;
}

std::optional<Defect> check_box(const Simulate::Box& box) {
    if (auto defect = finite("simulate/box/least", box.least)) return defect;
    if (auto defect = finite("simulate/box/most", box.most)) return defect;
    for (int k = 0; k < 3; ++k)
        if (box.most[k] < box.least[k])
            return Defect{"simulate/box/most", k,
                          "is " + shortest_text(box.most[k]) + ", expected at least that of /simulate/box/least, " +
                              shortest_text(box.least[k])};
    return std::nullopt;
}

std::optional<Defect> check_view(const Simulate::View& view) {
    if (auto defect = finite("simulate/view/from", view.from)) return defect;
    if (!(view.angle > 0 && view.angle < 180))
        return Defect{"simulate/view/angle", -1,
                      "is " + shortest_text(view.angle) + ", expected more than 0 and less than 180"};
    return above_zero("simulate/view/pixels", view.pixels);
}

} // namespace

std::optional<Defect> check_simulate(const Scene& scene) {
    if (!scene.simulate) return std::nullopt;
    const Simulate& by = *scene.simulate;
    if (auto defect = check_levels(by)) return defect;
    if (auto defect = at_least("simulate/radius", by.radius, 0)) return defect;
    for (std::size_t k = 0; k < by.subtrees.size(); ++k)
        if (auto defect = check(by.subtrees[k], "simulate/subtrees/" + std::to_string(k), scene.trees.size()))
            return defect;
    if (by.box)
        if (auto defect = check_box(*by.box)) return defect;
    if (auto defect = at_least("simulate/error", by.error, 0)) return defect;
    if (by.view)
        if (auto defect = check_view(*by.view)) return defect;
    if (by.view && by.error == 0) return Defect{"simulate/view", -1, "goes only with /simulate/error, in pixels then"};
    const bool chooses = by.first_level || by.last_level || by.radius > 0 || !by.subtrees.empty() || by.box;
    if (!chooses && by.error == 0)
        return Defect{"simulate", -1,
                      "leaves nothing out, expected first_level, last_level, radius, subtrees, box or error"};
    const char* other = scene.fracture ? "/fracture" : !scene.balls.empty() ? "/balls" : "/walkers";
    if (scene.fracture || !scene.balls.empty() || !scene.walkers.empty())
        return Defect{"simulate", -1,
                      std::string("stands beside ") + other +
                          ", expected one of them: what breaks, is hit or walked on must be able to move"};
    return std::nullopt;
}

} // namespace bough
