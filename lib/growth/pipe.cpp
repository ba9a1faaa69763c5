#include "pipe.h"
#include "../model/polyline.h"
#include "bark.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

struct ChildAt {
    double at;    // fraction of the bearing branch's arc length
    double power; // [m^exponent] r^exponent
};

// Raises the radii of one branch for its loads; returns what it needs at its base.
double thicken(Splines& s, std::size_t b, double exponent, std::vector<ChildAt>& loads) {
    const auto first = std::size_t(s.first_point[b]), last = std::size_t(s.first_point[b + 1]) - 1;
    const std::vector<double> arc = arc_lengths(points_of(s, b));
    std::sort(loads.begin(), loads.end(), [](const ChildAt& x, const ChildAt& y) { return x.at > y.at; });
    double needed = std::pow(s.radius[last], exponent);
    std::size_t next = 0;
    for (std::size_t k = last + 1; k-- > first;) {
        // A load between two points is borne by both, so that it is borne where it grows.
        const double inner = k > first && arc.back() > 0 ? arc[k - 1 - first] / arc.back() : -1;
        while (next < loads.size() && loads[next].at > inner) needed += loads[next++].power;
        s.radius[k] = std::max(s.radius[k], exponent == 2 ? std::sqrt(needed) : std::pow(needed, 1 / exponent));
    }
    return needed;
}

} // namespace

void thicken_by_pipe_model(Splines& s, double exponent) {
    const std::vector<double> drawn = s.radius;
    std::vector<std::vector<ChildAt>> loads(s.branches());
    for (std::size_t b = s.branches(); b-- > 0;) {
        const double power = thicken(s, b, exponent, loads[b]);
        if (s.parent[b] >= 0) loads[std::size_t(s.parent[b])].push_back({s.parent_at[b], power});
        loads[b] = {};
    }
    seat_on_bark(s, drawn);
}

double exponent_for_trunk(const Splines& s, double least) {
    constexpr double most = 4;
    std::vector<std::size_t> root(s.branches());
    std::size_t trunk = 0;
    const auto base = [&s](std::size_t b) { return s.radius[std::size_t(s.first_point[b])]; };
    for (std::size_t b = 0; b < s.branches(); ++b) {
        root[b] = s.parent[b] < 0 ? b : root[std::size_t(s.parent[b])];
        if (s.parent[b] < 0 && base(b) > base(trunk)) trunk = b;
    }
    const auto too_thick = [&](double exponent) {
        double needed = 0; // over the base's own power, which keeps small numbers apart from zero
        for (std::size_t b = 0; b < s.branches(); ++b)
            if (root[b] == trunk)
                needed += std::pow(s.radius[std::size_t(s.first_point[b + 1]) - 1] / base(trunk), exponent);
        return needed > 1;
    };
    if (!(base(trunk) > 0) || least >= most || !too_thick(least)) return least;
    double low = least, high = most;
    while (high - low > 1e-3) {
        const double middle = (low + high) / 2;
        (too_thick(middle) ? low : high) = middle;
    }
    return high;
}

} // namespace bough
