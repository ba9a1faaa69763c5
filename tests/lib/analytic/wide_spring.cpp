// The joint's kernel in registers of lanes, as wide as this file is compiled for: eigenvectors against Eigen's solver, the oscillator
// against its closed forms in long double, elementary functions against the standard library's; each lane by itself, whatever its neighbours.
#define BOUGH_TARGET tested
#include "lib/analytic/wide_spring.h"
#include "tests/support/make_tree.h"
#include "tests/support/oscillator_truth.h"
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

using namespace bough;
namespace wide = bough::fast;

namespace {

template <class T> using TwoWide = wide::Pair<wide::Wide<T>>;

// Lane `lane` of a pair, and setting it.
template <class T> constexpr int all_lanes = 2 * wide::width<T>;
template <class T> T get(const TwoWide<T>& x, int lane) {
    return lane < wide::width<T> ? x.a[lane] : x.b[lane - wide::width<T>];
}
template <class T> void set(TwoWide<T>& x, int lane, T value) {
    if (lane < wide::width<T>)
        x.a[lane] = value;
    else
        x.b[lane - wide::width<T>] = value;
}
template <class T> Vector3<T> get(const wide::V3<TwoWide<T>>& v, int lane) {
    return {get<T>(v.x, lane), get<T>(v.y, lane), get<T>(v.z, lane)};
}
template <class T> void set(wide::Symmetric<TwoWide<T>>& s, int lane, const Matrix3<T>& m) {
    set<T>(s.xx, lane, m(0, 0)), set<T>(s.xy, lane, m(0, 1)), set<T>(s.xz, lane, m(0, 2));
    set<T>(s.yy, lane, m(1, 1)), set<T>(s.yz, lane, m(1, 2)), set<T>(s.zz, lane, m(2, 2));
}

template <class T> using Register = wide::Wide<T>;
template <class T> wide::WidePropagator<Register<T>> propagated(const Register<T>& b, const Register<T>& lambda, T h) {
    const Register<T> both[2][2] = {{b, wide::all(T(1))}, {lambda, wide::all(T(1))}};
    wide::WidePropagator<Register<T>> p[2];
    wide::propagate(both[0], both[1], h, p);
    return p[0];
}
template <class T> T exponential(T x) {
    const Register<T> given[1] = {wide::all(x)};
    Register<T> e[1];
    wide::exponentials(given, e);
    return e[0][0];
}

// At random, with equal and nearly equal values, of no, negative and widely spread values.
template <class T> std::vector<Matrix3<T>> matrices() {
    std::vector<Matrix3<T>> all;
    make_tree::Dice dice{std::mt19937(3)};
    for (const Vec3& values : {Vec3(1, 2, 3), Vec3(1, 1, 1), Vec3(2, 2, 5), Vec3(1e-3, 1, 1e3), Vec3(-4, 0.5, 9),
                               Vec3(0, 0, 0), Vec3(0, 0, 7), Vec3(1, 1 + 1e-12, 1 + 2e-12), Vec3(1e-12, 1, 1e12),
                               Vec3(1e9, 1e9, 3), Vec3(-1, 1, 1), Vec3(3e10, 1e11, 7e4)})
        for (int k = 0; k < 40; ++k) {
            const Quat q(dice(-1, 1), dice(-1, 1), dice(-1, 1), dice(-1, 1));
            const Mat3 R = k == 0 ? Mat3(Mat3::Identity()) : q.normalized().toRotationMatrix();
            const Mat3 wide = R * values.asDiagonal() * R.transpose();
            all.push_back(Mat3((wide + wide.transpose()) / 2).cast<T>());
        }
    return all;
}

} // namespace

TEMPLATE_TEST_CASE("lanes find the eigenvectors that Eigen's solver finds", "", float, double) {
    using T = TestType;
    constexpr T e = std::numeric_limits<T>::epsilon();
    const std::vector<Matrix3<T>> all = matrices<T>();
    for (std::size_t first = 0; first < all.size(); first += all_lanes<T>) {
        wide::Symmetric<TwoWide<T>> A{};
        for (int l = 0; l < all_lanes<T>; ++l) set<T>(A, l, all[(first + std::size_t(l)) % all.size()]);
        const wide::M3<TwoWide<T>> V = wide::symmetric_eigen(A);
        for (int l = 0; l < all_lanes<T>; ++l) {
            const Matrix3<T>& given = all[(first + std::size_t(l)) % all.size()];
            Matrix3<T> X;
            X << get<T>(V.x, l), get<T>(V.y, l), get<T>(V.z, l);
            Vector3<T> found(get<T>(A.xx, l), get<T>(A.yy, l), get<T>(A.zz, l));
            const T size = given.cwiseAbs().maxCoeff();
            CAPTURE(first, l, given);
            CHECK((X.transpose() * X - Matrix3<T>::Identity()).cwiseAbs().maxCoeff() < 20 * e);
            CHECK((given * X - X * found.asDiagonal()).cwiseAbs().maxCoeff() <= 20 * e * size);
            const Eigen::SelfAdjointEigenSolver<Matrix3<T>> expected(given, Eigen::EigenvaluesOnly);
            std::sort(found.data(), found.data() + 3);
            CHECK((found - expected.eigenvalues()).cwiseAbs().maxCoeff() <= 20 * e * size);
        }
    }
}

TEST_CASE("small eigenvalues of a scaled matrix keep their relative accuracy in lanes") {
    const Vec3 D(1e-8, 1, 1e8);
    Mat3 A;
    A << 2, 0.3, -0.2, 0.3, 1, 0.1, -0.2, 0.1, 3;
    wide::Symmetric<TwoWide<double>> lanes{};
    for (int l = 0; l < all_lanes<double>; ++l) set<double>(lanes, l, Mat3(D.asDiagonal() * A * D.asDiagonal()));
    wide::symmetric_eigen(lanes);
    Vec3 found(get<double>(lanes.xx, 1), get<double>(lanes.yy, 1), get<double>(lanes.zz, 1));
    std::sort(found.data(), found.data() + 3);
    // To 1e-16, the leading one, then Schur's complements, then the determinant's rest.
    const double big = A(2, 2), middle = A(1, 1) - A(1, 2) * A(1, 2) / big, small = A.determinant() / (big * middle);
    CHECK(found[2] == Approx(1e16 * big).epsilon(1e-14));
    CHECK(found[1] == Approx(middle).epsilon(1e-14));
    CHECK(found[0] == Approx(1e-16 * small).epsilon(1e-14));
}

// A lane's result is its own: the same bits whatever stands beside it.
TEMPLATE_TEST_CASE("a lane does not depend on its neighbours", "", float, double) {
    using T = TestType;
    const std::vector<Matrix3<T>> all = matrices<T>();
    for (std::size_t k = 0; k + all_lanes<T> < all.size(); k += 7) {
        wide::Symmetric<TwoWide<T>> together{}, alone{};
        for (int l = 0; l < all_lanes<T>; ++l) {
            set<T>(together, l, all[k + std::size_t(l)]);
            set<T>(alone, l, l == 0 ? all[k] : Matrix3<T>(Matrix3<T>::Identity()));
        }
        const auto V = wide::symmetric_eigen(together), W = wide::symmetric_eigen(alone);
        CHECK(get<T>(V.x, 0) == get<T>(W.x, 0));
        CHECK(get<T>(V.y, 0) == get<T>(W.y, 0));
        CHECK(get<T>(together.xx, 0) == get<T>(alone.xx, 0));
    }
    const std::vector<oscillator_truth::Case> cases = oscillator_truth::cases();
    for (std::size_t k = 0; k + 4 < cases.size(); ++k) {
        wide::Wide<T> b{}, lambda = wide::all(T(1));
        for (int l = 0; l < wide::width<T>; ++l) {
            b[l] = T(cases[k + std::size_t(l) % 4].b);
            lambda[l] = T(cases[k + std::size_t(l) % 4].lambda);
        }
        const auto together = propagated<T>(b, lambda, T(1));
        const auto alone = propagated<T>(wide::all(b[0]), wide::all(lambda[0]), T(1));
        CAPTURE(cases[k].b, cases[k].lambda);
        CHECK(together.B[0] == alone.B[0]);
        CHECK(together.C[0] == alone.C[0]);
        CHECK(together.E[0] == alone.E[0]);
    }
}

TEMPLATE_TEST_CASE("lanes step the oscillator by its closed form in every case of damping", "", float, double) {
    using T = TestType;
    using oscillator_truth::Real;
    // Float: the phase of sqrt(lambda) h = 100 is known to 100 roundings.
    const Real bound = sizeof(T) == 4 ? 2e-5L : 1e-12L;
    for (const double h : {1.0, 1.0 / 30, 1e-3})
        for (const oscillator_truth::Case& c : oscillator_truth::cases()) {
            const T b = T(c.b / h), lambda = T(c.lambda / (h * h));
            CAPTURE(h, c.b, c.lambda);
            const wide::WidePropagator<wide::Wide<T>> p = propagated<T>(wide::all(b), wide::all(lambda), T(h));
            const Real t = Real(T(h)), B = oscillator_truth::impulse_response(b, lambda, t),
                       C = oscillator_truth::rate_response(b, lambda, t),
                       E = oscillator_truth::step_response(b, lambda, t);
            const Real ring = lambda > 0 ? 1 / std::sqrt(Real(lambda)) : Real(0);
            CHECK(std::abs(Real(p.B[0]) - B) <=
                  bound * std::max(std::abs(B), std::min(ring, t) * std::exp(-Real(b) * t / 2)) +
                      2 * Real(std::numeric_limits<T>::min()));
            CHECK(std::abs(Real(p.C[0]) - C) <= bound * std::max(std::abs(C), Real(1)));
            CHECK(std::abs(Real(p.E[0]) - E) <= bound * std::abs(E));
        }
}

// What bounded_lambda lets through: no digit of the phase is left, but nothing grows.
TEMPLATE_TEST_CASE("the stiffest oscillators stay bounded in lanes", "", float, double) {
    using T = TestType;
    for (double power = 4; power <= (sizeof(T) == 4 ? 16 : 150); power += 0.37)
        for (const double zeta : {0.0, 1e-9, 1e-3, 0.7, 1.0, 30.0}) {
            const double lambda = std::pow(10, power), h = 1.0 / 30, rate = std::sqrt(lambda);
            if (2 * zeta * rate > (sizeof(T) == 4 ? 1e16 : 1e150)) continue;
            const auto p = propagated<T>(wide::all(T(2 * zeta * rate)), wide::all(T(lambda)), T(h));
            CAPTURE(power, zeta);
            CHECK(std::abs(p.B[0]) * rate <= 1.001);
            CHECK(std::abs(p.C[0]) <= 1.001);
            CHECK(p.E[0] * lambda >= -1e-3);
            CHECK(p.E[0] * lambda <= 2.001);
        }
}

TEMPLATE_TEST_CASE("lanes' elementary functions are the standard library's to a few roundings", "", float, double) {
    using T = TestType;
    constexpr double e = std::numeric_limits<T>::epsilon();
    for (double x = sizeof(T) == 4 ? -86 : -700; x < (sizeof(T) == 4 ? 88 : 708); x += 0.0137) {
        const double given = T(x);
        CAPTURE(given);
        REQUIRE(double(exponential(T(x))) == Approx(std::exp(given)).epsilon(4 * e).margin(0));
    }
    CHECK(exponential(T(-1e6)) < 2 * std::numeric_limits<T>::min());
    CHECK(std::isinf(exponential(T(1e6))));
    for (double power = sizeof(T) == 4 ? -36 : -300; power < (sizeof(T) == 4 ? 37 : 300); power += 0.0173) {
        const double given = T(std::pow(10, power));
        REQUIRE(double(wide::inverse_root(wide::all(T(given)))[0]) ==
                Approx(1 / std::sqrt(given)).epsilon(3 * e).margin(0));
    }
}

TEMPLATE_TEST_CASE("a turn's maps in lanes are math.h's up to half a turn and beyond", "", float, double) {
    using T = TestType;
    constexpr double e = std::numeric_limits<T>::epsilon();
    make_tree::Dice dice{std::mt19937(8)};
    for (const double angle : {0.0, 1e-9, 1e-3, 0.3, 0.999, 1.001, 2.0, 3.1, 3.14159, 3.3}) {
        const Vec3 axis(dice(-1, 1), dice(-1, 1), dice(-1, 1));
        const Vector3<T> theta = (angle * axis.normalized()).cast<T>();
        const wide::V3<wide::Wide<T>> t{wide::all(theta[0]), wide::all(theta[1]), wide::all(theta[2])};
        const auto q = wide::dot(t, t);
        const auto turn = wide::turn_of(q);
        const auto matrix = [](const wide::M3<wide::Wide<T>>& m) {
            Mat3 out;
            out << double(m.x.x[0]), double(m.y.x[0]), double(m.z.x[0]), double(m.x.y[0]), double(m.y.y[0]),
                double(m.z.y[0]), double(m.x.z[0]), double(m.y.z[0]), double(m.z.z[0]);
            return out;
        };
        const Vec3 exact = theta.template cast<double>();
        CAPTURE(angle);
        const Mat3 R = rotation_from_vector(exact), J = body_rate_jacobian(exact);
        CHECK((matrix(wide::turn_form(t, q, turn.s, turn.c1)) - R).norm() < 20 * e);
        CHECK((matrix(wide::turn_form(t, q, decltype(q)(-turn.c1), turn.c2)) - J).norm() < 20 * e);
        CHECK((matrix(wide::turn_form(t, q, wide::all(T(0.5)), wide::t2_of(q))) * J - Mat3::Identity()).norm() <
              60 * e);
    }
}
