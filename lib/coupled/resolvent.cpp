#include "resolvent.h"
#include "midpoint.h"
#include <type_traits>

namespace bough {
namespace {

template <class S> using Matrix = Eigen::Matrix<S, 3, 3>;
template <class S> using Vector = Eigen::Matrix<S, 3, 1>;

template <class T, class S> constexpr bool is_complex = !std::is_same_v<T, S>;

template <class S, class T> S field(std::complex<double> z, T) {
    if constexpr (is_complex<T, S>)
        return S(T(z.real()), T(z.imag()));
    else
        return T(z.real());
}

// r x v. (Eigen's own cross conjugates.)
template <class T, class V> V cross(const Vector3<T>& r, const V& v) {
    return V(r.y() * v.z() - r.z() * v.y(), r.z() * v.x() - r.x() * v.z(), r.x() * v.y() - r.y() * v.x());
}

// [r]* X, column by column.
template <class T, class S> Matrix<S> cross_left(const Vector3<T>& r, const Matrix<S>& X) {
    Matrix<S> m;
    for (int k = 0; k < 3; ++k) m.col(k) = cross(r, Vector<S>(X.col(k)));
    return m;
}

// X^-1 of a symmetric X = L D L^T, L with unit diagonal.
template <class S> Matrix<S> symmetric_inverse(const Matrix<S>& X) {
    const S one(1);
    const S d0 = one / X(0, 0);
    const S l10 = X(1, 0) * d0, l20 = X(2, 0) * d0;
    const S d1 = one / (X(1, 1) - l10 * X(1, 0));
    const S y21 = X(2, 1) - l20 * X(1, 0);
    const S l21 = y21 * d1;
    const S d2 = one / (X(2, 2) - l20 * X(2, 0) - l21 * y21);
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

template <class T, class S> struct Solve {
    const Plan<T>& plan;
    State<T>& state;
    std::vector<ResolventBody<S>>& body;
    S p, c, s1, s2, slope; // s1 = 1/s, s2 = 1/s^2
    T h;

    Solve(const Plan<T>& pl, State<T>& st, std::vector<ResolventBody<S>>& bodies, const Pole& pole)
        : plan(pl), state(st), body(bodies), p(field<S>(pole.p, T())), c(field<S>(pole.c, T())),
          s1(field<S>(pl.dt / pole.p, T())), s2(field<S>(pl.dt / pole.p * pl.dt / pole.p, T())),
          slope(field<S>(1.0 / pole.p - 0.5, T())), h(T(pl.dt)) {}

    void start(std::size_t i) {
        const CoupledBody<T>& b = state.coupled[i];
        ResolventBody<S>& q = body[i];
        const T m = plan.mass[i];
        q.A = b.J.template cast<S>() + s2 * b.H.template cast<S>();
        q.B = (m * cross_matrix(b.c)).template cast<S>();
        q.M = (m * Matrix3<T>::Identity()).template cast<S>();
        q.N = b.N.template cast<S>() + s1 * (b.H * b.omega_0).template cast<S>();
        q.F = b.F.template cast<S>();
        if (plan.wind) {
            const Matrix3<T> cD = cross_left(b.c, b.D);
            const Matrix3<T> cDc = cross_left(b.c, Matrix3<T>(cD.transpose()));
            q.A += s1 * cDc.template cast<S>();
            q.B += s1 * cD.template cast<S>();
            q.M += s1 * b.D.template cast<S>();
        }
        if (plan.forces) {
            q.N += slope * b.slope_N.template cast<S>();
            q.F += slope * b.slope_F.template cast<S>();
        }
    }

    void eliminate(std::size_t i) {
        const CoupledBody<T>& b = state.coupled[i];
        ResolventBody<S>& q = body[i];
        const Matrix3<T> stiffness = b.rates.transpose() * plan.K[i].asDiagonal() * b.rates;
        const Matrix<S> Z = (plan.beta[i] * s1 + s2) * stiffness.template cast<S>();
        q.E = symmetric_inverse(Matrix<S>(q.A + Z));
        q.u = b.torque.template cast<S>() - s1 * b.torque_rate.template cast<S>() - q.N;
        if (plan.parent[i] < 0) return;
        ResolventBody<S>& parent = body[std::size_t(plan.parent[i])];
        const Matrix<S> ZE = Z * q.E, EB = q.E * q.B;
        Matrix<S> A = ZE * q.A, M = q.M - q.B.transpose() * EB;
        const Matrix<S> B = ZE * q.B;
        symmetrise(A);
        symmetrise(M);
        const Vector<S> turn = q.E * q.u, N = q.N + q.A * turn, F = q.F + q.B.transpose() * turn;
        const Matrix<S> rM = cross_left(b.r, M), rB = cross_left(b.r, Matrix<S>(B.transpose()));
        parent.M += M;
        parent.B += B + rM;
        parent.A += A + rB + rB.transpose() + cross_left(b.r, Matrix<S>(rM.transpose()));
        parent.F += F;
        parent.N += N + cross(b.r, F);
    }

    void accelerate(std::size_t i, const Vector<S>& alpha_p, const Vector<S>& a_p) {
        const CoupledBody<T>& b = state.coupled[i];
        ResolventBody<S>& q = body[i];
        q.a = a_p - cross(b.r, alpha_p);
        const Vector<S> gamma = q.E * (q.u - q.A * alpha_p - q.B * q.a);
        q.alpha = alpha_p + gamma;
        const Vector<S> x = b.rates.template cast<S>() * gamma;
        const Vector<S> x_v = -x / p, x_u = (h * x_v - state.theta_dot[i].template cast<S>()) / p;
        state.theta_dot_change[i] += h * weighed(Vector<S>(c * x_v));
        state.theta_change[i] += h * weighed(Vector<S>(c * x_u));
    }

    static Vector3<T> weighed(const Vector<S>& z) {
        if constexpr (is_complex<T, S>)
            return T(2) * z.real();
        else
            return z;
    }

    // The moving ground's acceleration at the joint's place, and its angular one.
    void accelerate_root(std::size_t i) {
        Vector<S> alpha = Vector<S>::Zero(), a = Vector<S>::Zero();
        if (const GroundStep<T>* g = ground_step_of(plan, state, i)) {
            a = g->a.template cast<S>() + slope * g->slope_a.template cast<S>();
            alpha = g->alpha.template cast<S>() + slope * g->slope_alpha.template cast<S>();
        }
        accelerate(i, alpha, a);
    }

    void run() {
        const auto n = std::int64_t(plan.bodies);
#pragma omp parallel for schedule(static) if (n > 2000)
        for (std::int64_t i = 0; i < n; ++i) start(std::size_t(i));
        for (std::size_t i = plan.bodies; i-- > 0;) eliminate(i);
        for (std::size_t i = 0; i < plan.bodies; ++i)
            if (plan.parent[i] < 0)
                accelerate_root(i);
            else
                accelerate(i, body[std::size_t(plan.parent[i])].alpha, body[std::size_t(plan.parent[i])].a);
    }
};

} // namespace

template <class T> void resolvent(const Plan<T>& plan, State<T>& state, const Pole& pole) {
    if (scheme_of(plan.scheme).real)
        Solve<T, T>(plan, state, state.resolvent_real, pole).run();
    else
        Solve<T, std::complex<T>>(plan, state, state.resolvent, pole).run();
}

template void resolvent(const Plan<float>&, State<float>&, const Pole&);
template void resolvent(const Plan<double>&, State<double>&, const Pole&);

} // namespace bough
