#include "quintic.h"
#include <Eigen/LU>
#include <algorithm>

namespace bough {
namespace {

using Mat2 = Eigen::Matrix2d;
using Rows = Eigen::Matrix<double, 2, 3>; // of (v, a), a column a component

// Row k of the system: below y_(k-1) + own y_k + below'^T of the next y_(k+1) = right.
struct Row {
    Mat2 below, own;
    Rows right;
};

Row row_at(const std::vector<double>& time, const std::vector<Vec3>& x, std::size_t k) {
    const double p = 1 / (time[k] - time[k - 1]), n = 1 / (time[k + 1] - time[k]);
    const Vec3 before = p * p * p * (x[k] - x[k - 1]), after = n * n * n * (x[k + 1] - x[k]);
    Row row;
    row.below << 168 * p * p * p, 24 * p * p, -24 * p * p, -3 * p;
    const double mixed = 36 * (n * n - p * p);
    row.own << 192 * (p * p * p + n * n * n), mixed, mixed, 9 * (p + n);
    row.right.row(0) = 360 * (n * after + p * before).transpose();
    row.right.row(1) = 60 * (after - before).transpose();
    return row;
}

struct Piece {
    double h;
    Vec3 D, V0, V1, A0, A1; // change, and the derivatives at both ends in units of the piece's length
};

Piece piece_at(const QuinticSpline& c, std::size_t k) {
    const double h = c.time[k + 1] - c.time[k];
    return {h, c.x[k + 1] - c.x[k], h * c.v[k], h * c.v[k + 1], h * h * c.a[k], h * h * c.a[k + 1]};
}

} // namespace

QuinticSpline make_quintic(const std::vector<double>& time, const std::vector<Vec3>& x) {
    const std::size_t n = time.size();
    QuinticSpline spline{time, x, std::vector<Vec3>(n, Vec3::Zero()), std::vector<Vec3>(n, Vec3::Zero())};
    // Eliminated from the first inner key on: y_k = right_k - above_k y_(k+1). y is 0 at both ends.
    std::vector<Mat2> above(n, Mat2::Zero());
    std::vector<Rows> right(n, Rows::Zero());
    for (std::size_t k = 1; k + 1 < n; ++k) {
        const Row row = row_at(time, x, k);
        const Mat2 inverse = (row.own - row.below * above[k - 1]).inverse();
        right[k] = inverse * (row.right - row.below * right[k - 1]);
        if (k + 2 < n) above[k] = inverse * row_at(time, x, k + 1).below.transpose();
    }
    for (std::size_t k = n - 1; k-- > 1;) {
        Rows next;
        next << spline.v[k + 1].transpose(), spline.a[k + 1].transpose();
        const Rows y = right[k] - above[k] * next;
        spline.v[k] = y.row(0).transpose();
        spline.a[k] = y.row(1).transpose();
    }
    return spline;
}

CurvePoint curve_at(const QuinticSpline& c, double t) {
    if (!(t >= c.time.front())) return {c.x.front(), Vec3::Zero(), Vec3::Zero()};
    if (t >= c.time.back()) return {c.x.back(), Vec3::Zero(), Vec3::Zero()};
    const auto k = std::size_t(std::upper_bound(c.time.begin(), c.time.end(), t) - c.time.begin()) - 1;
    const Piece p = piece_at(c, k);
    const double s = (t - c.time[k]) / p.h;
    const Vec3 c3 = 10 * p.D - 6 * p.V0 - 4 * p.V1 - 1.5 * p.A0 + 0.5 * p.A1;
    const Vec3 c4 = -15 * p.D + 8 * p.V0 + 7 * p.V1 + 1.5 * p.A0 - p.A1;
    const Vec3 c5 = 6 * p.D - 3 * (p.V0 + p.V1) - 0.5 * (p.A0 - p.A1);
    return {c.x[k] + s * (p.V0 + s * (0.5 * p.A0 + s * (c3 + s * (c4 + s * c5)))),
            (p.V0 + s * (p.A0 + s * (3 * c3 + s * (4 * c4 + 5 * s * c5)))) / p.h,
            (p.A0 + s * (6 * c3 + s * (12 * c4 + 20 * s * c5))) / (p.h * p.h)};
}

double greatest(const QuinticSpline& c, int axis) {
    double most = c.x.front()[axis];
    for (std::size_t k = 0; k + 1 < c.time.size(); ++k) {
        const Piece p = piece_at(c, k);
        const Vec3 points[] = {c.x[k] + 0.2 * p.V0, c.x[k] + 0.4 * p.V0 + 0.05 * p.A0,
                               c.x[k + 1] - 0.4 * p.V1 + 0.05 * p.A1, c.x[k + 1] - 0.2 * p.V1, c.x[k + 1]};
        for (const Vec3& point : points) most = std::max(most, point[axis]);
    }
    return most;
}

} // namespace bough
