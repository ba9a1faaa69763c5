#include "../base/counted.h"
#include "check_parts.h"

namespace bough {
namespace {

constexpr std::int64_t most_cells = std::int64_t(1) << 22; // what lanes look up (wide_pair.h)
constexpr std::int32_t most_octaves = 32;

// A list of one value or of one a cell, each of which passes.
template <class A, class Check>
std::optional<Defect> check_cells(const std::string& at, const A& list, std::int64_t cells, Check&& passes) {
    if (list.size() != 1 && std::int64_t(list.size()) != cells)
        return Defect{at, -1,
                      "has " + counted(list.size(), "value", "values") + ", expected 1 or " + std::to_string(cells) +
                          " (one for each cell)"};
    for (std::size_t k = 0; k < list.size(); ++k)
        if (auto defect = passes(list.size() == 1 ? at : at + "/" + std::to_string(k), list[k])) return defect;
    return std::nullopt;
}

std::optional<Defect> check(const WindGrid& grid) {
    const std::string at = "wind/grid/";
    if (!std::isfinite(grid.x) || !std::isfinite(grid.z))
        return Defect{at + "origin", -1, "is not finite, expected finite numbers"};
    if (auto defect = above_zero(at + "cell", grid.cell)) return defect;
    if (auto defect = not_too_far(at + "cell", grid.cell)) return defect;
    if (auto defect = not_too_far(at + "origin", Vec3(grid.x, 0, grid.z))) return defect;
    for (const auto& [key, count] : {std::pair{"columns", grid.columns}, {"rows", grid.rows}})
        if (count < 1) return Defect{at + key, -1, "is " + std::to_string(count) + ", expected 1 or more"};
    const std::int64_t cells = std::int64_t(grid.columns) * grid.rows;
    if (cells > most_cells)
        return Defect{"wind/grid", -1,
                      "has " + std::to_string(cells) + " cells, expected at most " + std::to_string(most_cells)};
    if (!grid.velocity.empty())
        if (auto defect = check_cells(at + "velocity", grid.velocity, cells,
                                      [](const std::string& field, const Vec3& v) { return not_too_far(field, v); }))
            return defect;
    const auto octaves = [](const std::string& field, std::int32_t value) -> std::optional<Defect> {
        if (value >= 0 && value <= most_octaves) return std::nullopt;
        return Defect{field, -1,
                      "is " + std::to_string(value) + ", expected 0 to " + std::to_string(most_octaves) + " octaves"};
    };
    if (auto defect = check_cells(at + "octaves", grid.octaves, cells, octaves)) return defect;
    if (auto defect = check_cells(at + "persistence", grid.persistence, cells,
                                  [](const std::string& field, double value) { return at_least(field, value, 0); }))
        return defect;
    if (auto defect = check_cells(at + "phase", grid.phase, cells,
                                  [](const std::string& field, double value) { return finite(field, value); }))
        return defect;
    return above_zero(at + "frequency", grid.frequency);
}

std::optional<Defect> check(const WindSwirl& swirl) {
    const std::string at = "wind/swirl/";
    if (!std::isfinite(swirl.x) || !std::isfinite(swirl.z))
        return Defect{at + "center", -1, "is not finite, expected finite numbers"};
    const std::size_t keys = swirl.radius.empty() ? 1 : swirl.radius.size();
    if (swirl.angle.size() != keys)
        return Defect{at + "angle", -1,
                      "has " + counted(swirl.angle.size(), "key", "keys") + ", expected " + std::to_string(keys) +
                          (swirl.radius.empty() ? " (radius names no more)" : " (one for each radius)")};
    for (std::size_t k = 0; k < swirl.radius.size(); ++k) {
        const std::string field = at + "radius/" + std::to_string(k);
        if (auto defect = at_least(field, swirl.radius[k], 0)) return defect;
        if (k > 0 && !(swirl.radius[k] > swirl.radius[k - 1]))
            return Defect{field, -1, "is " + shortest_text(swirl.radius[k]) + ", expected more than the one before it"};
    }
    for (std::size_t k = 0; k < keys; ++k)
        if (!(std::abs(swirl.angle[k]) <= 180))
            return Defect{at + "angle" + (keys > 1 ? "/" + std::to_string(k) : ""), -1,
                          "is " + shortest_text(swirl.angle[k]) + ", expected -180 to 180 degrees"};
    if (auto defect = above_zero(at + "period", swirl.period)) return defect;
    return swirl.wavelength ? above_zero(at + "wavelength", *swirl.wavelength) : std::nullopt;
}

} // namespace

std::optional<Defect> check(const Wind& wind) {
    if (auto defect = not_too_far("wind/velocity", wind.velocity)) return defect;
    if (auto defect = above_zero("wind/reference_height", wind.reference_height)) return defect;
    if (auto defect = not_too_far("wind/reference_height", wind.reference_height)) return defect;
    if (auto defect = at_least("wind/profile", wind.profile, 0)) return defect;
    if (auto defect = at_least("wind/turbulence", wind.turbulence, 0)) return defect;
    if (auto defect = at_least("wind/gust_factor", wind.gust_factor, 1)) return defect;
    if (auto defect = above_zero("wind/gust_period", wind.gust_period)) return defect;
    if (auto defect = finite("wind/turbulence_ahead", wind.turbulence_ahead)) return defect;
    if (auto defect = finite("wind/gust_ahead", wind.gust_ahead)) return defect;
    if (wind.period)
        if (auto defect = above_zero("wind/period", *wind.period)) return defect;
    if (wind.grid)
        if (auto defect = check(*wind.grid)) return defect;
    if (wind.swirl)
        if (auto defect = check(*wind.swirl)) return defect;
    if (!wind.shelter) return std::nullopt;
    if (auto defect = above_zero("wind/shelter/cell", wind.shelter->cell)) return defect;
    if (wind.velocity.isZero(0)) return Defect{"wind/shelter", -1, "needs a direction, but /wind/velocity is zero"};
    return std::nullopt;
}

} // namespace bough
