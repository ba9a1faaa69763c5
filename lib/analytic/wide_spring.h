// wide_spring.h: one joint's own step (spring.h, drag.h) for registers of lanes, apart from all traversal, in the axes of its body.
//
// It is written a second time because the plain step parts the work into stages over all joints. Here one joint goes through in registers, and the
// order of sums is another. X is a register or a pair of them (wide_pair.h). What lanes do depends only on what stands in them, never on their
// neighbours: a branch here leaves out what no lane asks for, and where one does, the others keep theirs by a choice. So registers of all widths come
// to the same result, except for products that compilers fuse in one way or another with what is added to them.
// The cost is about 1100 operations a register with wind and gravity, most of them eigenvectors and oscillators.
#pragma once
#include "wide_cholesky.h"
#include "wide_eigen.h"
#include "wide_oscillator.h"
#include "wide_turn.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

template <class X> struct JointLoad { // in the axes of its body
    Symmetric<X> J;                   // [kg m^2] composite's inertia about the joint
    V3<X> h, g;                       // [kg m], [m/s^2] first moment, gravity
    V3<X> tau, drag_tau;              // [N m] of forces, and of the air on the body's own velocity
    X drag_row, wind_row, turn_row;   // drag.h
    V3<X> theta, rate;                // rate: scaled_rate
    V3<X> K;
    X beta, bend, twist, gravity_row, inverse_weight;
};

// T^T K T for diagonal K.
template <class X> BOUGH_FORCE Symmetric<X> sandwiched(const M3<X>& T, const V3<X>& K) {
    const auto times = [&](const V3<X>& v) { return V3<X>{K.x * v.x, K.y * v.y, K.z * v.z}; };
    const V3<X> x = times(T.x), y = times(T.y), z = times(T.z);
    return {dot(T.x, x), dot(T.x, y), dot(T.x, z), dot(T.y, y), dot(T.y, z), dot(T.z, z)};
}

// S of joint.h.
template <class X> BOUGH_FORCE Symmetric<X> joint_inertia(const JointLoad<X>& in) {
    const X bb = in.bend * in.bend, bt = in.bend * in.twist;
    Symmetric<X> S{bb * in.J.xx, bb * in.J.xy, bt * in.J.xz, bb * in.J.yy, bt * in.J.yz, in.twist * in.twist * in.J.zz};
    const X rounding = 4 * std::numeric_limits<RealOf<X>>::epsilon() * (S.xx + S.yy + S.zz);
    S.xx = S.xx + rounding, S.yy = S.yy + rounding, S.zz = S.zz + rounding;
    return S;
}

// K + G, and the part of G that is a multiple of 1. rates: T.
template <bool gravity, class X>
BOUGH_FORCE Symmetric<X> joint_stiffness(const JointLoad<X>& in, const M3<X>& rates, X& weight) {
    using T = RealOf<X>;
    Symmetric<X> KG = sandwiched(rates, in.K);
    if constexpr (gravity) {
        const X x = in.h.x * in.g.x, y = in.h.y * in.g.y, z = in.h.z * in.g.z;
        weight = in.gravity_row + (x + y + z);
        KG.xx = KG.xx + (weight - x), KG.yy = KG.yy + (weight - y), KG.zz = KG.zz + (weight - z);
        KG.xy = KG.xy - T(0.5) * (in.h.x * in.g.y + in.h.y * in.g.x);
        KG.xz = KG.xz - T(0.5) * (in.h.x * in.g.z + in.h.z * in.g.x);
        KG.yz = KG.yz - T(0.5) * (in.h.y * in.g.z + in.h.z * in.g.y);
    }
    return KG;
}

// A joint's modes: U^T S U = 1, U^T (K + G) U = diag lambda, V = L^T U.
template <class X> struct JointModes {
    M3<X> V, U;
    X lambda[3]; // [1/s^2]
    X size2[3];  // |u|^2
    X row[3];    // [1/(kg m^2)] what a multiple of 1 adds to each: sums of |U^T U| with wind, |u|^2 without
};
template <bool wind, class X> BOUGH_FORCE JointModes<X> joint_modes(const Cholesky<X>& L, const Symmetric<X>& KG) {
    using T = RealOf<X>;
    JointModes<X> out;
    Symmetric<X> A = reduced(L, KG);
    const X biggest = larger(larger(magnitude(A.xx), magnitude(A.yy)), magnitude(A.zz));
    const bool huge = any_above(biggest, each<X>(sizeof(T) == 4 ? T(1e15) : T(1e150)));
    Scale<X> unit;
    if (huge) { // scaled, exactly, so that no square overflows
        unit = scale_of(biggest);
        A = unit.inverse * A;
    }
    out.V = symmetric_eigen(A);
    if (huge) A.xx = unit.power * A.xx, A.yy = unit.power * A.yy, A.zz = unit.power * A.zz;
    const M3<X>& U = out.U = {back(L, out.V.x), back(L, out.V.y), back(L, out.V.z)};
    out.lambda[0] = A.xx, out.lambda[1] = A.yy, out.lambda[2] = A.zz;
    out.size2[0] = dot(U.x, U.x), out.size2[1] = dot(U.y, U.y), out.size2[2] = dot(U.z, U.z);
    for (int k = 0; k < 3; ++k) out.row[k] = out.size2[k];
    if constexpr (wind) {
        const X xy = magnitude(dot(U.x, U.y)), xz = magnitude(dot(U.x, U.z)), yz = magnitude(dot(U.y, U.z));
        out.row[0] = out.row[0] + xy + xz, out.row[1] = out.row[1] + xy + yz, out.row[2] = out.row[2] + xz + yz;
    }
    return out;
}

// One mode's oscillator, (5)-(6) with the air's bounds (drag.h): q'' + b q' + l q = ratio (r + d v).
template <class X> struct JointOscillator {
    X B, C, E;
    X b, l, d, ratio;     // b and l as they are taken, bounded
    X with_air;           // [1/s^2] l before
    bool bounded = false; // ratio is not 1 everywhere
};
// largest: largest_lambda (oscillator.h).
template <bool wind, bool gravity, class X>
BOUGH_FORCE JointOscillator<X> joint_oscillator(const JointLoad<X>& in, const JointModes<X>& modes, const X& weight,
                                                int k, RealOf<X> h, RealOf<X> largest) {
    JointOscillator<X> o;
    const V3<X>& u = k == 0 ? modes.U.x : k == 1 ? modes.U.y : modes.U.z;
    X l = modes.lambda[k], b;
    if constexpr (gravity) // U^T K U = lambda - U^T G U
        b = in.beta * larger(l - (weight * modes.size2[k] - dot(in.h, u) * dot(in.g, u)), X{});
    else
        b = in.beta * l;
    o.d = X{};
    if constexpr (wind) {
        o.d = modes.row[k] * in.inverse_weight * in.wind_row;
        b = b + o.d;
        l = l + modes.row[k] * in.turn_row;
    }
    o.with_air = l;
    o.ratio = each<X>(1);
    if (any_above(l, each<X>(largest))) {
        o.bounded = true;
        const X most = each<X>(largest);
        o.ratio = choose_above(l, most, largest / l, o.ratio);
        b = o.ratio * b;
        l = choose_above(l, most, most, l);
    }
    o.b = b;
    o.l = l;
    constexpr int parts = Registers<X>::count;
    using W = std::remove_cvref_t<decltype(Registers<X>::part(weight, 0))>;
    W damping[parts], stiffness[parts];
    for (int j = 0; j < parts; ++j) {
        damping[j] = Registers<X>::part(b, j);
        stiffness[j] = Registers<X>::part(l, j);
    }
    WidePropagator<W> p[parts];
    propagate(damping, stiffness, h, p);
    for (int j = 0; j < parts; ++j) {
        Registers<X>::part(o.B, j) = p[j].B;
        Registers<X>::part(o.C, j) = p[j].C;
        Registers<X>::part(o.E, j) = p[j].E;
    }
    return o;
}

// What happened to a joint's lambda.
template <class X> struct JointLambdas {
    X lambda[3], with_air[3]; // [1/s^2]
    bool bounded = false;     // some was
};

template <class X> struct JointStep {
    V3<X> phi, theta;  // [rad] turn in the step, theta after it, however long
    V3<X> rate, omega; // as JointLoad::rate, and [rad/s] the joint's rate in the axes of its body
    V3<X> rate_before; // with the drag
};

template <bool wind, bool gravity, bool forces, class X>
BOUGH_FORCE JointStep<X> step_joint(const JointLoad<X>& in, RealOf<X> h, RealOf<X> largest, JointLambdas<X>& lambdas) {
    using T = RealOf<X>;
    JointStep<X> out;
    const Symmetric<X> S = joint_inertia(in);
    const Cholesky<X> L = cholesky(S);

    V3<X> w = in.rate;
    if constexpr (wind) { // drag.h
        const X d = h * in.inverse_weight * in.drag_row;
        Symmetric<X> N = S;
        N.xx = N.xx + d, N.yy = N.yy + d, N.zz = N.zz + d;
        const V3<X> change = h * solved_by(N, in.drag_tau);
        w.x = w.x + S.xx * L.i0 * change.x + L.l10 * change.y + L.l20 * change.z;
        w.y = w.y + (S.yy - L.l10 * L.l10) * L.i1 * change.y + L.l21 * change.z;
        w.z = w.z + (S.zz - L.l20 * L.l20 - L.l21 * L.l21) * L.i2 * change.z;
    }
    out.rate_before = w;

    const X q = dot(in.theta, in.theta);
    const M3<X> rates = turn_form(in.theta, q, each<X>(T(0.5)), t2_of(q));
    X weight{};
    const Symmetric<X> KG = joint_stiffness<gravity>(in, rates, weight);
    const V3<X> spring{in.K.x * in.theta.x, in.K.y * in.theta.y, in.K.z * in.theta.z};
    V3<X> residual = -transposed_times(rates, spring);
    if constexpr (forces) residual = residual + in.tau;
    if constexpr (gravity) residual = residual + cross(in.h, in.g);

    const JointModes<X> modes = joint_modes<wind>(L, KG);
    const X r[3] = {dot(modes.U.x, residual), dot(modes.U.y, residual), dot(modes.U.z, residual)};
    const X v[3] = {dot(modes.V.x, w), dot(modes.V.y, w), dot(modes.V.z, w)};
    X dq[3], v_new[3];
    for (int k = 0; k < 3; ++k) {
        const JointOscillator<X> o = joint_oscillator<wind, gravity>(in, modes, weight, k, h, largest);
        lambdas.lambda[k] = modes.lambda[k];
        lambdas.with_air[k] = o.with_air;
        X force = r[k];
        if constexpr (wind) force = force + o.d * v[k];
        if (o.bounded) {
            lambdas.bounded = true;
            force = o.ratio * force;
        }
        dq[k] = o.E * force + o.B * v[k];
        v_new[k] = o.B * force + o.C * v[k];
    }
    const V3<X> rates_after{v_new[0], v_new[1], v_new[2]};
    out.phi = modes.U * V3<X>{dq[0], dq[1], dq[2]};
    out.theta = in.theta + rates * out.phi;
    out.rate = modes.V * rates_after;
    out.omega = modes.U * rates_after;
    return out;
}

} // namespace BOUGH_TARGET
} // namespace bough::fast
