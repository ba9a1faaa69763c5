#include "../base/counted.h"
#include "check_parts.h"

namespace bough {
namespace {

constexpr std::int64_t most_cells = std::int64_t(1) << 22; // what lanes look up (wide_pair.h)
constexpr std::int32_t most_octaves = 32;

// A wind that is good is checked without an allocation, for Simulation::set_wind: names are put together for a defect alone.
std::optional<Defect> of_entry(std::optional<Defect> defect, std::size_t k) {
    defect->field += "/" + std::to_string(k);
    return defect;
}

// A list of one value or of one a cell, each of which passes.
template <class A, class Check>
std::optional<Defect> check_cells(std::string_view at, const A& list, std::int64_t cells, Check&& passes) {
    if (list.size() != 1 && std::int64_t(list.size()) != cells)
        return Defect{std::string(at), -1,
                      "has " + counted(list.size(), "value", "values") + ", expected 1 or " + std::to_string(cells) +
                          " (one for each cell)"};
    for (std::size_t k = 0; k < list.size(); ++k)
        if (auto defect = passes(at, list[k])) return list.size() == 1 ? defect : of_entry(defect, k);
    return std::nullopt;
}

std::optional<Defect> check(const WindGrid& grid) {
    if (!std::isfinite(grid.x) || !std::isfinite(grid.z))
        return Defect{"wind/grid/origin", -1, "is not finite, expected finite numbers"};
    if (auto defect = above_zero("wind/grid/cell", grid.cell)) return defect;
    if (auto defect = not_too_far("wind/grid/cell", grid.cell)) return defect;
    if (auto defect = not_too_far("wind/grid/origin", Vec3(grid.x, 0, grid.z))) return defect;
    for (const auto& [key, count] : {std::pair{"columns", grid.columns}, {"rows", grid.rows}})
        if (count < 1)
            return Defect{std::string("wind/grid/") + key, -1, "is " + std::to_string(count) + ", expected 1 or more"};
    const std::int64_t cells = std::int64_t(grid.columns) * grid.rows;
    if (cells > most_cells)
        return Defect{"wind/grid", -1,
                      "has " + std::to_string(cells) + " cells, expected at most " + std::to_string(most_cells)};
    if (!grid.velocity.empty())
        if (auto defect = check_cells("wind/grid/velocity", grid.velocity, cells,
                                      [](std::string_view field, const Vec3& v) { return not_too_far(field, v); }))
            return defect;
    const auto octaves = [](std::string_view field, std::int32_t value) -> std::optional<Defect> {
        if (value >= 0 && value <= most_octaves) return std::nullopt;
        return Defect{std::string(field), -1,
                      "is " + std::to_string(value) + ", expected 0 to " + std::to_string(most_octaves) + " octaves"};
    };
    if (auto defect = check_cells("wind/grid/octaves", grid.octaves, cells, octaves)) return defect;
    if (auto defect = check_cells("wind/grid/persistence", grid.persistence, cells,
                                  [](std::string_view field, double value) { return at_least(field, value, 0); }))
        return defect;
    if (auto defect = check_cells("wind/grid/phase", grid.phase, cells,
                                  [](std::string_view field, double value) { return finite(field, value); }))
        return defect;
    return above_zero("wind/grid/frequency", grid.frequency);
}

std::optional<Defect> check(const WindSwirl& swirl) {
    if (!std::isfinite(swirl.x) || !std::isfinite(swirl.z))
        return Defect{"wind/swirl/center", -1, "is not finite, expected finite numbers"};
    const std::size_t keys = swirl.radius.empty() ? 1 : swirl.radius.size();
    if (swirl.angle.size() != keys)
        return Defect{"wind/swirl/angle", -1,
                      "has " + counted(swirl.angle.size(), "key", "keys") + ", expected " + std::to_string(keys) +
                          (swirl.radius.empty() ? " (radius names no more)" : " (one for each radius)")};
    for (std::size_t k = 0; k < swirl.radius.size(); ++k) {
        if (auto defect = at_least("wind/swirl/radius", swirl.radius[k], 0)) return of_entry(defect, k);
        if (k > 0 && !(swirl.radius[k] > swirl.radius[k - 1]))
            return Defect{"wind/swirl/radius/" + std::to_string(k), -1,
                          "is " + shortest_text(swirl.radius[k]) + ", expected more than the one before it"};
    }
    for (std::size_t k = 0; k < keys; ++k)
        if (!(std::abs(swirl.angle[k]) <= 180))
            return Defect{std::string("wind/swirl/angle") + (keys > 1 ? "/" + std::to_string(k) : ""), -1,
                          "is " + shortest_text(swirl.angle[k]) + ", expected -180 to 180 degrees"};
    if (auto defect = above_zero("wind/swirl/period", swirl.period)) return defect;
    return swirl.wavelength ? above_zero("wind/swirl/wavelength", *swirl.wavelength) : std::nullopt;
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
