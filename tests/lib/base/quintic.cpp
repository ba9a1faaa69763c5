// The curve through keys: its keys, its smoothness, its closed form for two keys, and that no other has less jerk.
#include "lib/base/quintic.h"
#include "tests/support/make_tree.h"
#include <Eigen/LU>
#include <catch2/catch.hpp>

using namespace bough;

namespace {

const std::vector<double> times{-0.5, 0.1, 0.15, 1.4, 2, 5};

std::vector<Vec3> places(unsigned seed, std::size_t n) {
    make_tree::Dice dice{std::mt19937(seed)};
    std::vector<Vec3> x;
    for (std::size_t i = 0; i < n; ++i) {
        const double a = dice(-2, 2), b = dice(-2, 2), c = dice(-2, 2);
        x.emplace_back(a, b, c);
    }
    return x;
}

// The six coefficients of a polynomial through value, velocity, acceleration at both ends, by a dense solve.
Eigen::Matrix<double, 6, 3> hermite(double h, const CurvePoint& p, const CurvePoint& q) {
    Eigen::Matrix<double, 6, 6> M = Eigen::Matrix<double, 6, 6>::Zero();
    for (int j = 0; j < 6; ++j) {
        M(0, j) = j == 0;
        M(1, j) = j == 1;
        M(2, j) = 2 * (j == 2);
        M(3, j) = std::pow(h, j);
        M(4, j) = j < 1 ? 0 : j * std::pow(h, j - 1);
        M(5, j) = j < 2 ? 0 : j * (j - 1) * std::pow(h, j - 2);
    }
    Eigen::Matrix<double, 6, 3> right;
    right << p.x.transpose(), p.v.transpose(), p.a.transpose(), q.x.transpose(), q.v.transpose(), q.a.transpose();
    return M.fullPivLu().solve(right);
}

CurvePoint key(const QuinticSpline& c, std::size_t k) {
    return {c.x[k], c.v[k], c.a[k]};
}

// Integral of the squared third derivative, from the pieces' own polynomials.
double jerk(const QuinticSpline& c) {
    double sum = 0;
    for (std::size_t k = 0; k + 1 < c.time.size(); ++k) {
        const double h = c.time[k + 1] - c.time[k];
        const auto p = hermite(h, key(c, k), key(c, k + 1));
        const double m[3][3] = {{h, h * h / 2, h * h * h / 3},
                                {h * h / 2, h * h * h / 3, std::pow(h, 4) / 4},
                                {h * h * h / 3, std::pow(h, 4) / 4, std::pow(h, 5) / 5}};
        const double scale[3] = {6, 24, 60};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) sum += scale[i] * scale[j] * m[i][j] * p.row(3 + i).dot(p.row(3 + j));
    }
    return sum;
}

} // namespace

TEST_CASE("the curve passes through its keys exactly and rests outside them") {
    const std::vector<Vec3> x = places(1, times.size());
    const QuinticSpline c = make_quintic(times, x);
    for (std::size_t k = 0; k < times.size(); ++k) CHECK(curve_at(c, times[k]).x == x[k]);
    for (const double t : {-7.0, times.front(), times.back(), 99.0}) {
        const CurvePoint p = curve_at(c, t);
        CHECK(p.x == (t < 0 ? x.front() : x.back()));
        CHECK(p.v.norm() < 1e-14);
        CHECK(p.a.norm() < 1e-13);
    }
}

TEST_CASE("velocity and acceleration are the derivatives, and continuous at keys and ends") {
    const QuinticSpline c = make_quintic(times, places(2, times.size()));
    const auto near = [&](double t) {
        const double h = 1e-6;
        const CurvePoint p = curve_at(c, t), up = curve_at(c, t + h), down = curve_at(c, t - h);
        const double size = 1 + p.a.norm();
        CHECK(((up.x - down.x) / (2 * h) - p.v).norm() < 1e-5 * size);
        CHECK(((up.v - down.v) / (2 * h) - p.a).norm() < 1e-3 * size);
        CHECK((up.a - down.a).norm() < 0.1 * size);
    };
    for (const double t : times) near(t);
    for (double t = -0.77; t < 5.5; t += 0.0631) near(t);
}

TEST_CASE("the third and fourth derivatives are continuous at the keys between") {
    const QuinticSpline c = make_quintic(times, places(3, times.size()));
    for (std::size_t k = 1; k + 1 < times.size(); ++k) {
        const double h = times[k] - times[k - 1];
        const auto left = hermite(h, key(c, k - 1), key(c, k));
        const auto right = hermite(times[k + 1] - times[k], key(c, k), key(c, k + 1));
        const Vec3 third = (6 * left.row(3) + 24 * h * left.row(4) + 60 * h * h * left.row(5)).transpose();
        const Vec3 fourth = (24 * left.row(4) + 120 * h * left.row(5)).transpose();
        CHECK((third - 6 * right.row(3).transpose()).norm() < 1e-9 * (third.norm() + 1e5));
        CHECK((fourth - 24 * right.row(4).transpose()).norm() < 1e-8 * (fourth.norm() + 1e5));
    }
}

TEST_CASE("two keys give the minimum-jerk polynomial") {
    const Vec3 from(1, 2, 3), D(-1, 4, 0.5);
    const double start = 0.3, T = 1.7;
    const QuinticSpline c = make_quintic({start, start + T}, {from, from + D});
    for (double s = 0; s <= 1; s += 0.05) {
        const CurvePoint p = curve_at(c, start + s * T);
        const double x = s * s * s * (10 - 15 * s + 6 * s * s), v = 30 * s * s * (1 - s) * (1 - s);
        const double a = 60 * s * (1 - s) * (1 - 2 * s);
        CHECK((p.x - from - x * D).norm() < 1e-14);
        CHECK((p.v - v / T * D).norm() < 1e-13);
        CHECK((p.a - a / (T * T) * D).norm() < 1e-12);
    }
}

TEST_CASE("no other velocities and accelerations at the keys have less jerk") {
    const QuinticSpline c = make_quintic(times, places(4, times.size()));
    const double least = jerk(c);
    make_tree::Dice dice{std::mt19937(5)};
    for (int trial = 0; trial < 50; ++trial) {
        QuinticSpline other = c;
        for (std::size_t k = 1; k + 1 < times.size(); ++k)
            for (int i = 0; i < 3; ++i) {
                other.v[k][i] += dice(-1e-2, 1e-2);
                other.a[k][i] += dice(-1e-1, 1e-1);
            }
        CHECK(jerk(other) > least);
    }
}

TEST_CASE("the greatest value is a bound, and near") {
    for (unsigned seed = 0; seed < 10; ++seed) {
        const QuinticSpline c = make_quintic(times, places(seed, times.size()));
        double most = -INFINITY, least = INFINITY;
        for (double t = -1; t < 6; t += 1e-3) {
            most = std::max(most, curve_at(c, t).x.y());
            least = std::min(least, curve_at(c, t).x.y());
        }
        CHECK(greatest(c, 1) >= most);
        CHECK(greatest(c, 1) <= most + 2 * (most - least));
    }
}

TEST_CASE("many keys, evenly and unevenly spaced, of a known motion") {
    // Between and around keys dense in a smooth motion that starts and ends at rest, the curve is that motion.
    std::vector<double> time;
    std::vector<Vec3> x;
    const auto truth = [](double t) { return std::pow(std::sin(t), 4); };
    for (int k = 0; k <= 2000; ++k) {
        const double s = double(k) / 2000;
        time.push_back(3.14159265358979323846 * (s + 0.1 * std::sin(6.283185307179586 * s)));
        x.emplace_back(truth(time.back()), 0, 0);
    }
    const QuinticSpline c = make_quintic(time, x);
    for (double t = 0.01; t < 3.13; t += 0.0137) {
        const double a = 12 * std::pow(std::sin(t) * std::cos(t), 2) - 4 * std::pow(std::sin(t), 4);
        CHECK(curve_at(c, t).a.x() == Approx(a).margin(1e-5));
    }
}
