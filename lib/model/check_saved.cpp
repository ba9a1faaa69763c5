#include "../base/shortest_text.h"
#include "motion.h"
#include "splines.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace bough {
namespace {

constexpr double most_steps = 9e15; // a double counts them

std::optional<Defect> check_count(const SavedState& state) {
    if (state.frame < 0) return Defect{"frame", -1, "is " + std::to_string(state.frame) + ", expected 0 or more"};
    if (state.parts < 1 || state.part < 1 || state.part > state.parts)
        return Defect{"part", -1,
                      "is " + std::to_string(state.part) + " of " + std::to_string(state.parts) +
                          ", expected 1 to the number of /parts"};
    if (!(state.fps > 0) || !std::isfinite(state.fps))
        return Defect{"fps", -1, "is " + shortest_text(state.fps) + ", expected frames a second, more than 0"};
    if (state.substeps < 1)
        return Defect{"substeps", -1, "is " + std::to_string(state.substeps) + ", expected 1 or more"};
    if (double(state.frame) * state.substeps > most_steps)
        return Defect{"frame", -1,
                      "is " + std::to_string(state.frame) + ", of " + std::to_string(state.substeps) +
                          " steps each, expected at most 9e15 steps"};
    return std::nullopt;
}

// Empty, or what a message may repeat.
bool is_name(const std::string& text) {
    const auto fits = [](char c) { return c >= ' ' && c <= '~'; };
    return text.size() <= 40 && std::all_of(text.begin(), text.end(), fits);
}

std::optional<Defect> check_step_change(const SavedState& state) {
    const std::vector<double>& change = state.step_change;
    if (change.empty()) return std::nullopt;
    const double steps = double(state.frame) * state.substeps;
    if (change.size() != 2 || change[0] != std::floor(change[0]) || !(change[0] <= steps) || !(change[0] >= -1e15))
        return Defect{"step_change", -1, "expected two numbers: steps, at most those of /frame, and seconds"};
    return std::nullopt;
}

std::optional<Defect> check_finite(const SavedState& state) {
    const auto not_finite = [](const char* field, std::size_t k) {
        return Defect{field, std::int64_t(k), "is not finite, expected a finite number"};
    };
    for (const auto& [field, list] : {std::pair{"theta", &state.theta},
                                      {"theta_dot", &state.theta_dot},
                                      {"theta_change", &state.theta_change},
                                      {"theta_dot_change", &state.theta_dot_change},
                                      {"scaled_rate", &state.scaled_rate},
                                      {"spin_dot", &state.spin_dot}})
        for (std::size_t k = 0; k < list->size(); ++k)
            if (!(*list)[k].allFinite()) return not_finite(field, k);
    for (const auto& [field, list] : {std::pair{"free_bodies", &state.free_bodies},
                                      {"sleep", &state.sleep},
                                      {"attachments", &state.attachments},
                                      {"step_change", &state.step_change}})
        for (std::size_t k = 0; k < list->size(); ++k)
            if (!std::isfinite((*list)[k])) return not_finite(field, k);
    return std::nullopt;
}

} // namespace

std::optional<Defect> check(const SavedState& state) {
    if (auto defect = check_count(state)) return defect;
    if (state.precision != "float" && state.precision != "double")
        return Defect{"precision", -1, R"(is neither "float" nor "double")"};
    for (const auto& [field, word] : {std::pair{"solver", &state.solver}, {"scheme", &state.scheme}})
        if (!is_name(*word)) return Defect{field, -1, "is no name, expected at most 40 characters of ASCII"};
    if (auto defect = check_finite(state)) return defect;
    if (auto defect = check_step_change(state)) return defect;
    if (!(state.articulated_step >= 0) || !std::isfinite(state.articulated_step))
        return Defect{"articulated_step", -1, "is " + shortest_text(state.articulated_step) + ", expected seconds"};
    return std::nullopt;
}

} // namespace bough
