#include "trajectory_difference.h"
#include <algorithm>

namespace bough {
namespace {

struct SumOfSquares {
    double squares = 0, most = 0;
    std::size_t count = 0;

    void add(double squared) {
        squares += squared;
        most = std::max(most, squared);
        ++count;
    }
    Distance result() const {
        if (count == 0) return {};
        return {std::sqrt(squares / double(count)), std::sqrt(most)};
    }
};

template <class F> void each(std::size_t points, const std::vector<std::size_t>* of, const F& f) {
    if (of)
        for (const std::size_t k : *of) f(k);
    else
        for (std::size_t k = 0; k < points; ++k) f(k);
}

} // namespace

Distance distance(const Points& a, std::int64_t stride_a, const Points& b, std::int64_t stride_b,
                  const std::vector<std::size_t>* of) {
    const std::int64_t stride = std::max(stride_a, stride_b);
    SumOfSquares sum;
    for (std::int64_t f = stride;; f += stride) {
        const auto i = std::size_t(f / stride_a), j = std::size_t(f / stride_b);
        if (i >= a.size() || j >= b.size()) break;
        each(a[i].size(), of, [&](std::size_t k) { sum.add((a[i][k] - b[j][k]).squaredNorm()); });
    }
    return sum.result();
}

Distance distance(const Trajectory& a, const Trajectory& b) {
    if (!a.finite || !b.finite) return {};
    return distance(a.tip, a.stride, b.tip, b.stride);
}

Distance deflection(const Points& points, const std::vector<std::size_t>* of) {
    SumOfSquares sum;
    for (std::size_t f = 1; f < points.size(); ++f)
        each(points[f].size(), of, [&](std::size_t k) { sum.add((points[f][k] - points[0][k]).squaredNorm()); });
    return sum.result();
}

double angle_distance(const Trajectory& run, const Trajectory& truth) {
    if (!run.finite) return NAN;
    return distance(run.theta, run.stride, truth.theta, truth.stride).rms;
}

WoodLevels wood_levels(const Tree& tree) {
    const std::vector<std::size_t> wood = wood_bodies(tree);
    WoodLevels result;
    for (std::size_t k = 0; k < wood.size(); ++k) {
        const auto level = std::size_t(std::max(0, tree.level[wood[k]]));
        if (level >= result.level.size()) result.level.resize(level + 1);
        result.level[level].push_back(k);
        if (level <= 1) result.to_one.push_back(k);
    }
    return result;
}

} // namespace bough
