// eager.h: sums and products of 3-vectors and 3x3 matrices, worked out at once. Eigen's own operators make a type for each expression, and a compiler
// of bough would spend half of its time on declaring those. These operators are found in namespace bough, and are better matches than Eigen's
// members. Eigen provides what is not here. Each operator gives Eigen's numbers. Two expressions differ in rounding: s * (A * B) is worked out as it
// is written, where Eigen works out (s * A) * B, and (A * B).trace() is that of a finished product.
#pragma once
#include <Eigen/Core>
#include <concepts>
#include <type_traits>

namespace bough {

template <class T> using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T> using Matrix3 = Eigen::Matrix<T, 3, 3>;

#ifdef __cpp_concepts // before C++20 Eigen's operators serve
// A scalar as Eigen takes one: of the vector's own type, or a whole number.
template <class S, class T>
concept ScalarOf = std::same_as<S, T> || std::same_as<S, int>;

#define BOUGH_EAGER template <std::floating_point T> [[gnu::always_inline]] inline
#define BOUGH_EAGER_SCALED template <std::floating_point T, ScalarOf<T> S> [[gnu::always_inline]] inline
BOUGH_EAGER Vector3<T> operator+(const Vector3<T>& a, const Vector3<T>& b) {
    return {a.x() + b.x(), a.y() + b.y(), a.z() + b.z()};
}
BOUGH_EAGER Vector3<T> operator-(const Vector3<T>& a, const Vector3<T>& b) {
    return {a.x() - b.x(), a.y() - b.y(), a.z() - b.z()};
}
BOUGH_EAGER Vector3<T> operator-(const Vector3<T>& a) {
    return {-a.x(), -a.y(), -a.z()};
}
BOUGH_EAGER_SCALED Vector3<T> operator*(const Vector3<T>& a, S s) {
    return {a.x() * T(s), a.y() * T(s), a.z() * T(s)};
}
BOUGH_EAGER_SCALED Vector3<T> operator*(S s, const Vector3<T>& a) {
    return a * T(s);
}
BOUGH_EAGER_SCALED Vector3<T> operator/(const Vector3<T>& a, S s) {
    return {a.x() / T(s), a.y() / T(s), a.z() / T(s)};
}

// Makes a matrix of the numbers that `of` makes of two matrices' numbers, or of one's.
template <class T, class Of>
[[gnu::always_inline]] inline Matrix3<T> number_by_number(const Matrix3<T>& a, const Matrix3<T>& b, Of of) {
    Matrix3<T> made;
    for (int k = 0; k < 9; ++k) made.data()[k] = of(a.data()[k], b.data()[k]);
    return made;
}
BOUGH_EAGER Matrix3<T> operator+(const Matrix3<T>& a, const Matrix3<T>& b) {
    return number_by_number(a, b, [](T x, T y) { return x + y; });
}
BOUGH_EAGER Matrix3<T> operator-(const Matrix3<T>& a, const Matrix3<T>& b) {
    return number_by_number(a, b, [](T x, T y) { return x - y; });
}
BOUGH_EAGER Matrix3<T> operator-(const Matrix3<T>& a) {
    return number_by_number(a, a, [](T x, T) { return -x; });
}
BOUGH_EAGER_SCALED Matrix3<T> operator*(const Matrix3<T>& a, S s) {
    return number_by_number(a, a, [s](T x, T) { return x * T(s); });
}
BOUGH_EAGER_SCALED Matrix3<T> operator*(S s, const Matrix3<T>& a) {
    return a * T(s);
}
BOUGH_EAGER_SCALED Matrix3<T> operator/(const Matrix3<T>& a, S s) {
    return number_by_number(a, a, [s](T x, T) { return x / T(s); });
}

// Products by Eigen.
BOUGH_EAGER Matrix3<T> operator*(const Matrix3<T>& a, const Matrix3<T>& b) {
    return Eigen::Product<Matrix3<T>, Matrix3<T>>(a, b);
}
BOUGH_EAGER Vector3<T> operator*(const Matrix3<T>& a, const Vector3<T>& b) {
    return Eigen::Product<Matrix3<T>, Vector3<T>>(a, b);
}

// Products with a transpose or the identity on one side.
template <class M, class T>
concept Is3x3 = std::same_as<std::remove_const_t<M>, Matrix3<T>>;
template <class T> using Transposed = Eigen::Transpose<const Matrix3<T>>;
#define BOUGH_EAGER_TRANSPOSED template <std::floating_point T, Is3x3<T> M> [[gnu::always_inline]] inline
BOUGH_EAGER_TRANSPOSED Vector3<T> operator*(const Eigen::Transpose<M>& a, const Vector3<T>& b) {
    return Eigen::Product<Transposed<T>, Vector3<T>>(Transposed<T>(a.nestedExpression()), b);
}
BOUGH_EAGER_TRANSPOSED Matrix3<T> operator*(const Eigen::Transpose<M>& a, const Matrix3<T>& b) {
    return Eigen::Product<Transposed<T>, Matrix3<T>>(Transposed<T>(a.nestedExpression()), b);
}
BOUGH_EAGER_TRANSPOSED Matrix3<T> operator*(const Matrix3<T>& a, const Eigen::Transpose<M>& b) {
    return Eigen::Product<Matrix3<T>, Transposed<T>>(a, Transposed<T>(b.nestedExpression()));
}
BOUGH_EAGER_TRANSPOSED Matrix3<T> operator+(const Matrix3<T>& a, const Eigen::Transpose<M>& b) {
    return a + Matrix3<T>(b);
}
BOUGH_EAGER_TRANSPOSED Matrix3<T> operator-(const Matrix3<T>& a, const Eigen::Transpose<M>& b) {
    return a - Matrix3<T>(b);
}
BOUGH_EAGER Matrix3<T> operator*(const Vector3<T>& a, const Eigen::Transpose<const Vector3<T>>& b) {
    return Eigen::Product<Vector3<T>, Eigen::Transpose<const Vector3<T>>>(a, b);
}
template <class T> using IdentityOf = Eigen::CwiseNullaryOp<Eigen::internal::scalar_identity_op<T>, Matrix3<T>>;
BOUGH_EAGER_SCALED Matrix3<T> operator*(S s, const IdentityOf<T>& one) {
    return Matrix3<T>(one) * s;
}
BOUGH_EAGER_SCALED Matrix3<T> operator*(const IdentityOf<T>& one, S s) {
    return Matrix3<T>(one) * s;
}
BOUGH_EAGER Matrix3<T> operator+(const IdentityOf<T>& one, const Matrix3<T>& a) {
    return Matrix3<T>(one) + a;
}
BOUGH_EAGER Matrix3<T> operator-(const IdentityOf<T>& one, const Matrix3<T>& a) {
    return Matrix3<T>(one) - a;
}
BOUGH_EAGER Matrix3<T> operator+(const Matrix3<T>& a, const IdentityOf<T>& one) {
    return a + Matrix3<T>(one);
}
BOUGH_EAGER Matrix3<T> operator-(const Matrix3<T>& a, const IdentityOf<T>& one) {
    return a - Matrix3<T>(one);
}
#undef BOUGH_EAGER
#undef BOUGH_EAGER_SCALED
#undef BOUGH_EAGER_TRANSPOSED
#endif

} // namespace bough
