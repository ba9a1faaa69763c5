#include "wind.h"
#include <algorithm>
#include <cmath>

namespace bough {

template <class T>
WindTable<T> make_wind_table(const Wind& wind, double top, double reach, const std::vector<double>& clocks) {
    const std::size_t entries = wind.profile == 0 ? 1 : 65;
    WindTable<T> table;
    table.per_metre = T(double(entries - 1) / std::max(top, 1e-3));
    table.field = make_wind_field<T>(wind, reach, clocks);
    if (!table.field.on()) table.velocity.resize(entries);
    for (std::size_t k = 0; k < entries; ++k)
        table.profile.push_back(
            T(entries == 1 ? 1 : wind_profile(wind, std::max(top, 1e-3) * double(k) / double(entries - 1))));
    return table;
}

template <class T> void evaluate_wind(const Wind& wind, double t, WindTable<T>& table) {
    if (table.field.on()) return evaluate_field(wind, t, table.field);
    const Vector3<T> v = wind_velocity(wind, t).template cast<T>();
    for (std::size_t k = 0; k < table.velocity.size(); ++k) table.velocity[k] = table.profile[k] * v;
}

std::optional<Wind> wind_preset(const std::string& name) {
    struct Row {
        const char* name;
        double speed, turbulence, gust_factor, gust_period;
    };
    // Turbulence intensities over open country and gust factors of the Beaufort classes these speeds stand for.
    static constexpr Row rows[] = {{"calm", 1, 0.10, 1.2, 8},
                                   {"breeze", 4, 0.15, 1.4, 7},
                                   {"gusty", 8, 0.20, 1.7, 6},
                                   {"storm", 20, 0.22, 1.6, 5}};
    for (const Row& row : rows) {
        if (name != row.name) continue;
        Wind wind;
        wind.velocity = Vec3(row.speed, 0, 0);
        wind.turbulence = row.turbulence;
        wind.gust_factor = row.gust_factor;
        wind.gust_period = row.gust_period;
        return wind;
    }
    return std::nullopt;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template WindTable<T> make_wind_table(const Wind&, double, double, const std::vector<double>&);                    \
    template void evaluate_wind(const Wind&, double, WindTable<T>&);
#include "../base/instantiate.inc"

} // namespace bough
