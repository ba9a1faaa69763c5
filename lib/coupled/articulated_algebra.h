// articulated_algebra.h: the small dense algebra of articulated-body passes over a field S, real or complex (resolvent.h).
#pragma once
#include "coupled_body.h"
#include <complex>
#include <type_traits>

namespace bough {

template <class S> using Matrix = Eigen::Matrix<S, 3, 3>;
template <class S> using Vector = Eigen::Matrix<S, 3, 1>;

template <class T, class S> constexpr bool is_complex = !std::is_same_v<T, S>;

template <class S, class T> S field(std::complex<double> z, T) {
    if constexpr (is_complex<T, S>)
        return S(T(z.real()), T(z.imag()));
    else
        return T(z.real());
}

// Returns r x v. (Eigen's own cross conjugates.)
template <class T, class V> V cross(const Vector3<T>& r, const V& v) {
    return V(r.y() * v.z() - r.z() * v.y(), r.z() * v.x() - r.x() * v.z(), r.x() * v.y() - r.y() * v.x());
}

// Returns [r]* X, column by column.
template <class T, class S> Matrix<S> cross_left(const Vector3<T>& r, const Matrix<S>& X) {
    Matrix<S> m;
    for (int k = 0; k < 3; ++k) m.col(k) = cross(r, Vector<S>(X.col(k)));
    return m;
}

// Returns x / y by the textbook. The standard library's quotient of complex numbers scales them first, and rounds otherwise from one compiler to
// another.
template <class S> S quotient(const S& x, const S& y) {
    if constexpr (Eigen::NumTraits<S>::IsComplex) {
        const auto square = y.real() * y.real() + y.imag() * y.imag();
        return S((x.real() * y.real() + x.imag() * y.imag()) / square,
                 (x.imag() * y.real() - x.real() * y.imag()) / square);
    } else {
        return x / y;
    }
}
template <class S> Vector<S> quotient(const Vector<S>& x, const S& y) {
    return {quotient(x.x(), y), quotient(x.y(), y), quotient(x.z(), y)};
}

// Returns X^-1 of a symmetric X = L D L^T, L with unit diagonal.
template <class S> Matrix<S> symmetric_inverse(const Matrix<S>& X) {
    const S one(1);
    const S d0 = quotient(one, X(0, 0));
    const S l10 = X(1, 0) * d0, l20 = X(2, 0) * d0;
    const S d1 = quotient(one, S(X(1, 1) - l10 * X(1, 0)));
    const S y21 = X(2, 1) - l20 * X(1, 0);
    const S l21 = y21 * d1;
    const S d2 = quotient(one, S(X(2, 2) - l20 * X(2, 0) - l21 * y21));
    const S m20 = l10 * l21 - l20; // L^-1 has -l10, -l21 and this below its diagonal
    const S e21 = -l21 * d2, e20 = m20 * d2;
    Matrix<S> E;
    E(2, 2) = d2;
    E(2, 1) = E(1, 2) = e21;
    E(2, 0) = E(0, 2) = e20;
    E(1, 1) = d1 - l21 * e21;
    E(1, 0) = E(0, 1) = -l10 * d1 - l21 * e20;
    E(0, 0) = d0 + l10 * l10 * d1 + m20 * e20;
    return E;
}

template <class S> void symmetrise(Matrix<S>& X) {
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < r; ++c) X(r, c) = X(c, r) = (X(r, c) + X(c, r)) / typename Eigen::NumTraits<S>::Real(2);
}

// Returns R X with R real, X symmetric or not: half the cost of a complex product.
template <class T, class S> Matrix<S> real_times(const Matrix3<T>& R, const Matrix<S>& X) {
    if constexpr (is_complex<T, S>) {
        const Matrix3<T> re = X.real(), im = X.imag();
        Matrix<S> m;
        m.real() = R * re;
        m.imag() = R * im;
        return m;
    } else {
        return R * X;
    }
}

// Adds to `parent` what an eliminated joint hands on to the body it hangs on. Its impedance is Z = z K, K real; r goes from that body's joint to this
// one.
template <class T, class S>
void hand_on(const ResolventBody<S>& q, const S& z, const Matrix3<T>& K, const Vector3<T>& r,
             ResolventBody<S>& parent) {
    const Matrix<S> EB = q.E * q.B;
    Matrix<S> A = z * real_times<T, S>(K, q.E * q.A), M = q.M - q.B.transpose() * EB;
    const Matrix<S> B = z * real_times<T, S>(K, EB);
    symmetrise(A);
    symmetrise(M);
    const Vector<S> turn = q.E * q.u, N = q.N + q.A * turn, F = q.F + q.B.transpose() * turn;
    const Matrix<S> rM = cross_left(r, M), rB = cross_left(r, Matrix<S>(B.transpose()));
    parent.M += M;
    parent.B += B + rM;
    parent.A += A + rB + rB.transpose() + cross_left(r, Matrix<S>(rM.transpose()));
    parent.F += F;
    parent.N += N + cross(r, F);
}

// Accelerates a body whose parent's joint, r from its own, is accelerated by alpha_p and a_p. Returns what its joint adds to alpha_p.
template <class T, class S>
Vector<S> accelerate_joint(ResolventBody<S>& q, const Vector3<T>& r, const Vector<S>& alpha_p, const Vector<S>& a_p) {
    q.a = a_p - cross(r, alpha_p);
    const Vector<S> gamma = q.E * (q.u - q.A * alpha_p - q.B * q.a);
    q.alpha = alpha_p + gamma;
    return gamma;
}

} // namespace bough
