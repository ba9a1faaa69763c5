// wind_speeds.h: how fast the wind is at places that stay where they are, time after time. Drawn leaves rustle by it (growth/rustle.h). The wind is
// undisturbed: without shelter, and not relative to what moves.
#pragma once
#include "../model/scene.h"
#include <functional>
#include <vector>

namespace bough {

// places [m] belong to the scene's tree of the same number in `tree`, which says how far ahead in the wind they are (an entry beyond the scene's
// trees, or no tree at all: not ahead). The returned function fills in speeds [m/s] at a time [s]; they are 0 where the scene has no wind. O(places).
// Throws as make_wind_table.
std::function<void(double time, std::vector<double>& speed)> wind_speeds(const Scene&, std::vector<Vec3> places,
                                                                         const std::vector<std::size_t>& tree);

} // namespace bough
