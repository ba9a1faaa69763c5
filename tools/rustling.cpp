#include "rustling.h"
#include "lib/laws/wind_speeds.h"
#include "lib/model/drawn_pose.h"

namespace bough {

RustleMaker rustle_maker(const Setting& setting, const Tree& shown, double fps) {
    return [&setting, &shown, fps](const Skin& skin, bool together) -> std::unique_ptr<Rustle> {
        if (skin.clump_leaf.empty() || !setting.scene.wind) return nullptr;
        const std::vector<TreeRange>& ranges = setting.whole ? setting.whole->places.whole : setting.ranges;
        const DrawnPose drawn = drawn_pose(shown);
        std::vector<Vec3> places;
        std::vector<std::size_t> tree;
        std::size_t k = 0;
        for (const std::int32_t clump : clumps_of(skin)) {
            const auto i = std::size_t(clump);
            while (k + 1 < ranges.size() && i >= ranges[k + 1].first_body) ++k;
            places.push_back(drawn.at(i, shown.com[i]));
            tree.push_back(k);
        }
        RustleOptions options;
        options.fps = fps;
        options.period = setting.scene.wind->period;
        options.together = together;
        return std::make_unique<Rustle>(skin, wind_speeds(setting.scene, std::move(places), tree), options);
    };
}

} // namespace bough
