// Cholesky's factor of 3 x 3 against the definition in long double, and its inverse by cofactors.
#include "lib/base/cholesky.h"
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <limits>
#include <random>

using namespace bough;

namespace {

template <class T> Matrix3<T> any_matrix(std::mt19937& engine) {
    std::normal_distribution<double> normal;
    Matrix3<T> m;
    for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = T(normal(engine));
    return m;
}

using WideMatrix = Matrix3<long double>;
template <class T> WideMatrix wide(const Matrix3<T>& m) {
    return m.template cast<long double>();
}
template <class T> Matrix3<T> narrow(const WideMatrix& m) {
    return m.template cast<T>();
}

template <class T> void factors_and_solves() {
    std::mt19937 engine(5);
    const T eps = std::numeric_limits<T>::epsilon();
    for (double scale : {1e-12, 1.0, 1e9})
        for (int k = 0; k < 200; ++k) {
            const Matrix3<T> M = any_matrix<T>(engine);
            const Matrix3<T> A = T(scale) * (M * M.transpose() + T(0.1) * Matrix3<T>::Identity());
            const Cholesky<T> root(A);
            REQUIRE(root.positive);
            REQUIRE(root.L(0, 1) == 0);
            REQUIRE(root.L(0, 2) == 0);
            REQUIRE(root.L(1, 2) == 0);
            const WideMatrix L = wide(root.L), L_inverse = L.inverse();
            const Matrix3<T> left = narrow<T>(L * L.transpose() - wide(A));
            REQUIRE(left.norm() <= 8 * eps * A.norm());

            const WideMatrix inverse = wide(A).inverse();
            const T condition = T((inverse.norm() * wide(A).norm()));
            const Matrix3<T> right = any_matrix<T>(engine);
            const Vector3<T> b = right.col(0), x = narrow<T>(inverse * wide(right)).col(0);
            REQUIRE((root.solve(b) - x).norm() <= 8 * eps * condition * x.norm());

            Matrix3<T> X = any_matrix<T>(engine), Y = X;
            const Matrix3<T> lower = narrow<T>(L_inverse * wide(X));
            const Matrix3<T> upper = narrow<T>(L_inverse.transpose() * wide(Y));
            solve_lower(root.L, X);
            solve_lower_transposed(root.L, Y);
            REQUIRE((X - lower).norm() <= 8 * eps * condition * lower.norm());
            REQUIRE((Y - upper).norm() <= 8 * eps * condition * upper.norm());
        }
}

} // namespace

TEST_CASE("Cholesky's factor gives the matrix back, and solves") {
    factors_and_solves<float>();
    factors_and_solves<double>();
}

TEST_CASE("a matrix that is not positive definite has no Cholesky factor") {
    Mat3 A = Mat3::Identity();
    for (int k = 0; k < 3; ++k) {
        Mat3 B = A;
        B(k, k) = 0;
        CHECK_FALSE(Cholesky<double>(B).positive);
        B(k, k) = -1;
        CHECK_FALSE(Cholesky<double>(B).positive);
    }
    A(1, 0) = A(0, 1) = 2; // eigenvalues 3 and -1
    CHECK_FALSE(Cholesky<double>(A).positive);
    A(1, 0) = A(0, 1) = 0.5;
    CHECK(Cholesky<double>(A).positive);
    A(1, 1) = std::numeric_limits<double>::quiet_NaN();
    CHECK(Cholesky<double>(A).positive);
    CHECK(std::isnan(Cholesky<double>(A).L(2, 2)));
}

// Rounding leaves such matrices where a float's tree has very unequal masses: the step must go on with finite numbers.
TEST_CASE("the factor of a matrix that is not positive definite stops where Eigen's does, and is finite") {
    std::mt19937 engine(6);
    int stopped[3] = {};
    for (int k = 0; k < 300; ++k) {
        const Mat3 M = any_matrix<double>(engine), A = M + M.transpose();
        const Cholesky<double> root(A);
        const Eigen::LLT<Mat3> other(A);
        REQUIRE(root.positive == (other.info() == Eigen::Success));
        REQUIRE(root.L.allFinite());
        REQUIRE((root.L - Mat3(other.matrixL())).norm() <= 1e-14 * root.L.norm());
        if (!root.positive) ++stopped[A(0, 0) <= 0 ? 0 : A(0, 0) * A(1, 1) <= A(1, 0) * A(1, 0) ? 1 : 2];
    }
    for (const int times : stopped) CHECK(times > 10);
}
