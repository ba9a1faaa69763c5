// Rotation vectors against Eigen's angle-axis and quaternions, the rates' Jacobian against central differences.
#include "lib/base/math.h"
#include <catch2/catch.hpp>
#include <numbers>
#include <random>

using namespace bough;

namespace {

using Wide = long double;

template <class T> Matrix3<T> angle_axis(const Vector3<T>& theta) {
    const T a = theta.norm();
    if (a == 0) return Matrix3<T>::Identity();
    return Eigen::AngleAxis<T>(a, Vector3<T>(theta / a)).toRotationMatrix();
}

// Directions at random, lengths over every branch of the formulas and just beside their limits.
std::vector<Vec3> rotation_vectors() {
    std::mt19937 engine(7);
    std::normal_distribution<double> normal;
    std::vector<Vec3> all{Vec3::Zero()};
    for (double a : {1e-300, 1e-160, 1e-12, 1e-8, 9.9e-5, 1.01e-4, 1e-3, 9.99e-3, 1.001e-2, 0.05,
                     0.0999, 0.1001, 0.5,   1.0,  2.0,    3.0,     3.14, 3.2,     4.5,      6.0})
        for (int k = 0; k < 5; ++k) {
            const Vec3 v(normal(engine), normal(engine), normal(engine));
            all.push_back(a * v.normalized());
        }
    return all;
}

// J = integral over s in 0..1 of exp(-s theta), by Simpson in long double.
Mat3 jacobian_by_integration(const Vec3& theta) {
    const Vector3<Wide> t = theta.cast<Wide>();
    const int n = 400;
    Matrix3<Wide> sum = Matrix3<Wide>::Zero();
    for (int k = 0; k <= n; ++k)
        sum += Wide(k == 0 || k == n ? 1 : k % 2 ? 4 : 2) * angle_axis<Wide>(-t * (Wide(k) / n));
    return Matrix3<Wide>(sum / (3 * n)).cast<double>();
}

} // namespace

TEST_CASE("cross_matrix times a vector is the cross product") {
    const Vec3 a(1, -2, 3), b(0.5, 4, -1);
    CHECK((cross_matrix(a) * b - a.cross(b)).norm() == 0);
}

TEST_CASE("rotation_from_vector is the rotation about the vector") {
    for (const Vec3& theta : rotation_vectors()) {
        CAPTURE(theta.norm());
        const Mat3 expected = angle_axis<Wide>(theta.cast<Wide>()).cast<double>();
        CHECK((rotation_from_vector(theta) - expected).cwiseAbs().maxCoeff() < 1e-15);
        const Eigen::Vector3f single = theta.cast<float>();
        const Mat3 of_single = angle_axis<Wide>(single.cast<Wide>()).cast<double>();
        CHECK((rotation_from_vector<float>(single).cast<double>() - of_single).cwiseAbs().maxCoeff() < 5e-7);
    }
}

TEST_CASE("quaternion_from_vector is the same rotation, of unit length") {
    for (const Vec3& theta : rotation_vectors()) {
        CAPTURE(theta.norm());
        const Quat q = quaternion_from_vector(theta);
        const Mat3 expected = angle_axis<Wide>(theta.cast<Wide>()).cast<double>();
        CHECK(std::abs(q.norm() - 1) < 1e-15);
        CHECK((q.toRotationMatrix() - expected).cwiseAbs().maxCoeff() < 2e-15);
        const auto f = quaternion_from_vector<float>(theta.cast<float>());
        CHECK((f.toRotationMatrix().cast<double>() - expected).cwiseAbs().maxCoeff() < 1e-6);
    }
}

TEST_CASE("vector_from_quaternion undoes it up to half a turn, for either sign of the quaternion") {
    for (const Vec3& theta : rotation_vectors()) {
        CAPTURE(theta.norm());
        Quat q = quaternion_from_vector(theta);
        const Vec3 back = vector_from_quaternion(q);
        CHECK(back.norm() <= std::numbers::pi + 1e-15);
        if (theta.norm() < std::numbers::pi)
            CHECK((back - theta).norm() <= 4e-15 * theta.norm());
        else
            CHECK((rotation_from_vector(back) - rotation_from_vector(theta)).norm() < 4e-15);
        q.coeffs() *= -1;
        CHECK((vector_from_quaternion(q) - back).norm() == 0);
    }
}

TEST_CASE("body_rate_jacobian gives the body's rates: central differences of the rotation") {
    for (const Vec3& theta : rotation_vectors()) {
        CAPTURE(theta.norm());
        const Mat3 J = body_rate_jacobian(theta);
        for (int axis = 0; axis < 3; ++axis) {
            const Wide e = 1e-6L;
            Vector3<Wide> ahead = theta.cast<Wide>(), behind = ahead;
            ahead[axis] += e;
            behind[axis] -= e;
            const Matrix3<Wide> slope = (angle_axis(ahead) - angle_axis(behind)) / (2 * e);
            const Mat3 spin = Matrix3<Wide>(angle_axis<Wide>(theta.cast<Wide>()).transpose() * slope).cast<double>();
            const Vec3 omega(spin(2, 1), spin(0, 2), spin(1, 0));
            CHECK((J.col(axis) - omega).norm() < 1e-10);
        }
        CHECK((J - jacobian_by_integration(theta)).cwiseAbs().maxCoeff() < 2e-10 * std::pow(theta.norm(), 4) + 1e-15);
    }
}

TEST_CASE("body_rate_jacobian_inverse is its inverse, in double and float") {
    for (const Vec3& theta : rotation_vectors()) {
        const double a = theta.norm();
        CAPTURE(a);
        // J's smallest singular value falls to zero at a whole turn.
        const double condition = 1 / std::abs(a > 0 ? 2 * std::sin(a / 2) / a : 1);
        const Mat3 J = body_rate_jacobian(theta), T = body_rate_jacobian_inverse(theta);
        CHECK((J * T - Mat3::Identity()).cwiseAbs().maxCoeff() < 2e-15 * condition * condition);
        const Vector3<float> single = theta.cast<float>();
        const Mat3 J_single = body_rate_jacobian(single).cast<double>(),
                   T_single = body_rate_jacobian_inverse(single).cast<double>();
        CHECK((J_single - J).cwiseAbs().maxCoeff() < 2e-6);
        CHECK((T_single - T).cwiseAbs().maxCoeff() < 2e-6 * condition * condition);
    }
}

TEMPLATE_TEST_CASE("no map jumps where its series ends", "", float, double) {
    const TestType e = std::numeric_limits<TestType>::epsilon();
    for (TestType limit : {TestType(1e-8), TestType(1e-4), TestType(1e-2), TestType(0.1)}) {
        CAPTURE(limit);
        const Vector3<TestType> axis = Vector3<TestType>(1, -2, 2) / TestType(3);
        const Vector3<TestType> below = axis * (limit * (1 - 8 * e)), above = axis * (limit * (1 + 8 * e));
        const auto difference = [&](const auto& map) { return (map(above) - map(below)).cwiseAbs().maxCoeff(); };
        CHECK(difference([](const auto& t) { return rotation_from_vector(t); }) < 20 * e * limit + e);
        CHECK(difference([](const auto& t) { return body_rate_jacobian(t); }) < 20 * e * limit + e);
        CHECK(difference([](const auto& t) { return body_rate_jacobian_inverse(t); }) < 20 * e * limit + e);
        const auto q = [](const auto& t) { return quaternion_from_vector<TestType>(t).coeffs().eval(); };
        CHECK(difference(q) < 20 * e * limit + e);
    }
}

TEST_CASE("shortest_turn brings one direction to another, by the angle between them, opposite ones too") {
    std::mt19937 engine(3);
    std::normal_distribution<double> normal;
    const auto any = [&] { return Vec3(normal(engine), normal(engine), normal(engine)); };
    for (const double apart : {0.0, 1e-12, 1e-3, 1.0, 3.0, 3.14, -1e-3, -1e-5, -9e-7, -1e-8, -1e-13, -1e-15, -0.0})
        for (int k = 0; k < 20; ++k) { // below 0: from the opposite
            const Vec3 from = any(), a = from.normalized(), across = any().cross(a).normalized();
            const double sign = std::signbit(apart) ? -1 : 1;
            const Vec3 b = sign * std::cos(apart) * a + std::sin(apart) * across;
            const Quat turn = shortest_turn(from, 7 * b);
            CHECK((turn.toRotationMatrix() * a - b).norm() < 1e-13);
            CHECK(std::abs(turn.norm() - 1) < 1e-13);
            CHECK(turn.w() >= 0);
            CHECK(std::abs(turn.vec().dot(a)) < 1e-13); // the shortest: about what is across
        }
}

TEST_CASE("least_turn points z along the axis by the shortest way") {
    const Quat near(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
    const Vec3 axis(0.3, -2, 1);
    const Quat turned = least_turn(near, axis);
    CHECK((turned * Vec3::UnitZ() - axis.normalized()).norm() < 1e-15);
    const Eigen::AngleAxisd between(Eigen::Quaterniond(turned * near.conjugate()));
    const double least = std::acos((near * Vec3::UnitZ()).dot(axis.normalized()));
    CHECK(between.angle() == Approx(least).epsilon(1e-12));
}
