#include "curve_points.h"
#include <algorithm>

namespace bough {
namespace {

using Vec4 = Eigen::Matrix<double, 4, 1>;

Vec4 weighted(const std::vector<Vec3>& point, const std::vector<double>& weight, std::size_t i) {
    const double w = weight.empty() ? 1 : weight[i];
    Vec4 h;
    h << w * point[i], w;
    return h;
}

bool clamped(const std::vector<double>& knot, std::size_t degree) {
    const double tolerance = 1e-6 * (knot.back() - knot.front());
    return knot[degree] - knot.front() <= tolerance && knot.back() - knot[knot.size() - 1 - degree] <= tolerance;
}

// De Boor's algorithm at u within knot[span] .. knot[span + 1].
Vec3 de_boor(const std::vector<Vec3>& point, const std::vector<double>& weight, const std::vector<double>& knot,
             std::size_t degree, std::size_t span, double u, std::vector<Vec4>& d) {
    for (std::size_t j = 0; j <= degree; ++j) d[j] = weighted(point, weight, span - degree + j);
    for (std::size_t r = 1; r <= degree; ++r)
        for (std::size_t j = degree; j >= r; --j) {
            const double low = knot[span - degree + j], high = knot[span + 1 + j - r];
            const double t = high > low ? (u - low) / (high - low) : 0;
            d[j] = (1 - t) * d[j - 1] + t * d[j];
        }
    return d[degree].head<3>() / d[degree][3];
}

bool usable(const std::vector<Vec3>& point, const std::vector<double>& weight, int degree) {
    constexpr int highest = 32;
    const bool positive = std::all_of(weight.begin(), weight.end(), [](double w) { return w > 0; });
    return degree >= 1 && degree <= highest && point.size() > std::size_t(degree) && positive;
}

} // namespace

std::optional<std::vector<Vec3>> bspline_points(const std::vector<Vec3>& point, const std::vector<double>& weight,
                                                const std::vector<double>& knot, int degree) {
    if (!usable(point, weight, degree)) return {};
    if (degree == 1) return point;
    const std::size_t p = std::size_t(degree);
    if (knot.size() != point.size() + p + 1 || !std::is_sorted(knot.begin(), knot.end()) ||
        !(knot.back() > knot.front()) || !clamped(knot, p))
        return {};
    std::vector<Vec3> line{point.front()};
    std::vector<Vec4> scratch(p + 1);
    for (std::size_t span = p; span < point.size(); ++span) {
        if (!(knot[span + 1] > knot[span])) continue;
        for (int k = 1; k <= curve_steps; ++k) {
            const double u = knot[span] + (knot[span + 1] - knot[span]) * k / curve_steps;
            line.push_back(de_boor(point, weight, knot, p, span, u, scratch));
        }
    }
    line.back() = point.back();
    return line;
}

std::optional<std::vector<Vec3>> bezier_points(const std::vector<Vec3>& point, const std::vector<double>& weight,
                                               int degree) {
    if (!usable(point, weight, degree) || (point.size() - 1) % std::size_t(degree) != 0) return {};
    if (degree == 1) return point;
    // The same as a B-spline whose inner knots all stand degree times.
    const std::size_t pieces = (point.size() - 1) / std::size_t(degree);
    std::vector<double> knot(1, 0);
    for (std::size_t k = 0; k <= pieces; ++k) knot.insert(knot.end(), std::size_t(degree), double(k));
    knot.push_back(double(pieces));
    return bspline_points(point, weight, knot, degree);
}

} // namespace bough
