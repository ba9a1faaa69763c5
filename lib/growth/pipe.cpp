#include "pipe.h"
#include <algorithm>

namespace bough {
namespace {

struct Load {
    double at;   // fraction of the bearing branch's arc length
    double area; // [m^2] over pi
};

// Raises the radii of one branch for its loads; returns the area over pi at its base.
double thicken(Splines& s, std::size_t b, std::vector<Load>& loads) {
    const auto first = std::size_t(s.first_point[b]), last = std::size_t(s.first_point[b + 1]) - 1;
    std::vector<double> arc{0};
    for (std::size_t k = first; k < last; ++k) arc.push_back(arc.back() + (s.point[k + 1] - s.point[k]).norm());
    std::sort(loads.begin(), loads.end(), [](const Load& x, const Load& y) { return x.at > y.at; });
    const double tip = s.radius[last] * s.radius[last];
    double borne = 0;
    std::size_t next = 0;
    for (std::size_t k = last + 1; k-- > first;) {
        const double at = arc.back() > 0 ? arc[k - first] / arc.back() : 0;
        // A load between two points is borne by the inner one on.
        while (next < loads.size() && loads[next].at >= at) borne += loads[next++].area;
        s.radius[k] = std::max(s.radius[k], std::sqrt(tip + borne));
    }
    return std::max(s.radius[first] * s.radius[first], tip + borne);
}

} // namespace

void thicken_by_pipe_model(Splines& s) {
    std::vector<std::vector<Load>> loads(s.branches());
    for (std::size_t b = s.branches(); b-- > 0;) {
        const double area = thicken(s, b, loads[b]);
        if (s.parent[b] >= 0) loads[std::size_t(s.parent[b])].push_back({s.parent_at[b], area});
        loads[b] = {};
    }
}

} // namespace bough
