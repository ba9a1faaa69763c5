#include "../base/counted.h"
#include "check_parts.h"

namespace bough {

std::optional<Defect> check(const Walker& walker, const std::string& at, std::size_t trees) {
    if (auto defect = above_zero(at + "/mass", walker.mass)) return defect;
    if (auto defect = above_zero(at + "/radius", walker.radius)) return defect;
    if (auto defect = not_too_far(at + "/radius", walker.radius)) return defect;
    if (auto defect = at_least(at + "/push", walker.push, 0)) return defect;
    if (walker.stops.size() < 2)
        return Defect{at + "/stops", -1,
                      "has " + counted(walker.stops.size(), "stop", "stops") + ", expected at least 2"};
    for (std::size_t k = 0; k < walker.stops.size(); ++k) {
        const Walker::Stop& stop = walker.stops[k];
        const std::string stop_at = at + "/stops/" + std::to_string(k);
        if (auto defect = check(stop.on, stop_at + "/on", trees)) return defect;
        if (stop.on.by == Selector::By::level)
            return Defect{stop_at + "/on", -1, "names a level, expected one body: by body, branch or nearest"};
        if (auto defect = finite(stop_at + "/time", stop.time)) return defect;
        if (k > 0 && !(stop.time > walker.stops[k - 1].time))
            return Defect{stop_at + "/time", -1,
                          "is " + shortest_text(stop.time) + ", expected more than " +
                              shortest_text(walker.stops[k - 1].time) + " (times rise)"};
    }
    return std::nullopt;
}

} // namespace bough
