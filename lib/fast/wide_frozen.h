// wide_frozen.h: a joint's step with frozen coefficients (stages/frozen.h), and their refreshment, for registers of lanes.
#pragma once
#include "wide_spring.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

// What a joint keeps: q_new = q + E r + carry v, v_new = B r + C v, in modes U.
template <class X> struct FrozenJoint {
    M3<X> U;
    V3<X> E, B, carry, C;
    X sensitivity; // [1/(kg m^2)] most of row over 1 + |lambda| h^2 + b h (frozen.h)
};

template <class X> BOUGH_FORCE V3<X> times_each(const V3<X>& a, const V3<X>& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

template <bool wind, bool gravity, class X>
BOUGH_FORCE FrozenJoint<X> frozen_joint(const JointLoad<X>& in, const JointModes<X>& modes, const X& weight,
                                        RealOf<X> h, RealOf<X> largest, JointLambdas<X>& lambdas) {
    FrozenJoint<X> out;
    out.U = modes.U;
    X E[3], B[3], carry[3], C[3];
    out.sensitivity = X{};
    for (int k = 0; k < 3; ++k) {
        const JointOscillator<X> o = joint_oscillator<wind, gravity>(in, modes, weight, k, h, largest);
        E[k] = o.ratio * o.E;
        B[k] = o.ratio * o.B;
        carry[k] = o.B + E[k] * o.d;
        C[k] = o.C + B[k] * o.d;
        const X one = modes.row[k] / (1 + magnitude(o.l) * (h * h) + magnitude(o.b) * h);
        out.sensitivity = larger(out.sensitivity, one);
        lambdas.lambda[k] = modes.lambda[k];
        lambdas.with_air[k] = o.with_air;
    }
    out.E = {E[0], E[1], E[2]};
    out.B = {B[0], B[1], B[2]};
    out.carry = {carry[0], carry[1], carry[2]};
    out.C = {C[0], C[1], C[2]};
    return out;
}

// The modes' rates v in modes U as w = L^T U v: U U^T = M M^T with M upper triangular, which is L^-T, so that w = M^-1 (U v). |w| = |v|: what
// rounding has changed of it is given back.
template <class X> BOUGH_FORCE V3<X> scaled_rate_of(const M3<X>& U, const V3<X>& v) {
    using T = RealOf<X>;
    const auto along = [&](const X V3<X>::*a, const X V3<X>::*b) {
        return U.x.*a * U.x.*b + U.y.*a * U.y.*b + U.z.*a * U.z.*b;
    };
    const X least = each<X>(std::numeric_limits<T>::min());
    const X i2 = 1 / root(larger(along(&V3<X>::z, &V3<X>::z), least));
    const X m12 = along(&V3<X>::y, &V3<X>::z) * i2, m02 = along(&V3<X>::x, &V3<X>::z) * i2;
    const X i1 = 1 / root(larger(along(&V3<X>::y, &V3<X>::y) - m12 * m12, least));
    const X m01 = (along(&V3<X>::x, &V3<X>::y) - m02 * m12) * i1;
    const X i0 = 1 / root(larger(along(&V3<X>::x, &V3<X>::x) - m01 * m01 - m02 * m02, least));
    const V3<X> u = U * v;
    V3<X> w;
    w.z = u.z * i2;
    w.y = (u.y - m12 * w.z) * i1;
    w.x = (u.x - m01 * w.y - m02 * w.z) * i0;
    const X is = dot(w, w), ought = dot(v, v);
    return choose_above(is, each<X>(0), root(X(ought / larger(is, least))), each<X>(1)) * w;
}

// in.rate: the modes' rates.
template <bool wind, bool gravity, bool forces, class X>
BOUGH_FORCE JointStep<X> step_frozen(const JointLoad<X>& in, const FrozenJoint<X>& f, RealOf<X> h) {
    JointStep<X> out;
    const M3<X>& U = f.U;
    V3<X> v = in.rate;
    if constexpr (wind) { // drag.h in the modes: N = U^-T (1 + h d U^T U) U^-1
        const X d = h * in.inverse_weight * in.drag_row;
        const Symmetric<X> N{1 + d * dot(U.x, U.x), d * dot(U.x, U.y), d * dot(U.x, U.z),
                             1 + d * dot(U.y, U.y), d * dot(U.y, U.z), 1 + d * dot(U.z, U.z)};
        v = v + h * solved_by(N, transposed_times(U, in.drag_tau));
    }
    out.rate_before = v;
    const X t2 = t2_of(dot(in.theta, in.theta));
    V3<X> residual = -transposed_rate_of(in.theta, t2, times_each(in.K, in.theta));
    if constexpr (forces) residual = residual + in.tau;
    if constexpr (gravity) residual = residual + cross(in.h, in.g);
    const V3<X> r = transposed_times(U, residual);
    out.phi = U * (times_each(f.E, r) + times_each(f.carry, v));
    out.rate = times_each(f.B, r) + times_each(f.C, v);
    out.theta = in.theta + rate_of(in.theta, t2, out.phi);
    out.omega = U * out.rate;
    return out;
}

} // namespace BOUGH_TARGET
} // namespace bough::fast
