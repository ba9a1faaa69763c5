#include "wind_speeds.h"
#include "wind.h"
#include <algorithm>
#include <memory>

namespace bough {
namespace {

struct Speeds {
    Wind wind;
    WindTable<double> table;
    std::vector<Vec3> places;
    std::vector<std::size_t> clock;

    void at(double time, std::vector<double>& speed) {
        evaluate_wind(wind, time, table);
        speed.resize(places.size());
        for (std::size_t k = 0; k < places.size(); ++k) speed[k] = table.at(places[k], clock[k]).norm();
    }
};

} // namespace

std::function<void(double, std::vector<double>&)> wind_speeds(const Scene& scene, std::vector<Vec3> places,
                                                              const std::vector<std::size_t>& tree) {
    if (!scene.wind) return [n = places.size()](double, std::vector<double>& speed) { speed.assign(n, 0.0); };
    auto speeds = std::make_shared<Speeds>();
    speeds->wind = *scene.wind;
    const std::vector<double> clocks = wind_clocks(scene);
    double top = 0, reach = 0;
    for (const Vec3& p : places) {
        top = std::max(top, p.y());
        if (const auto& swirl = scene.wind->swirl)
            reach = std::max(reach, std::hypot(p.x() - swirl->x, p.z() - swirl->z));
    }
    speeds->table = make_wind_table<double>(*scene.wind, top, reach, clocks);
    for (const std::size_t k : tree) {
        const double start = k < scene.trees.size() ? scene.trees[k].start : 0;
        speeds->clock.push_back(std::size_t(std::find(clocks.begin(), clocks.end(), start) - clocks.begin()));
    }
    speeds->places = std::move(places);
    return [speeds](double time, std::vector<double>& speed) { speeds->at(time, speed); };
}

} // namespace bough
