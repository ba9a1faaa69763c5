#include "pipe.h"
#include <algorithm>

namespace bough {
namespace {

struct Load {
    double at;   // fraction of the bearing branch's arc length
    double area; // [m^2] over pi
};

// Raises the radii of one branch for its loads; returns what it needs at its base.
double thicken(Splines& s, std::size_t b, std::vector<Load>& loads) {
    const auto first = std::size_t(s.first_point[b]), last = std::size_t(s.first_point[b + 1]) - 1;
    std::vector<double> arc{0};
    for (std::size_t k = first; k < last; ++k) arc.push_back(arc.back() + (s.point[k + 1] - s.point[k]).norm());
    std::sort(loads.begin(), loads.end(), [](const Load& x, const Load& y) { return x.at > y.at; });
    double needed = s.radius[last] * s.radius[last];
    std::size_t next = 0;
    for (std::size_t k = last + 1; k-- > first;) {
        // A load between two points is borne by both, so that it is borne where it grows.
        const double inner = k > first && arc.back() > 0 ? arc[k - 1 - first] / arc.back() : -1;
        while (next < loads.size() && loads[next].at > inner) needed += loads[next++].area;
        s.radius[k] = std::max(s.radius[k], std::sqrt(needed));
    }
    return needed;
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
