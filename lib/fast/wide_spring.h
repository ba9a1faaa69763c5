// wide_spring.h: one joint's own step (stages/spring.h, drag.h) for registers of lanes, apart from all traversal: the oscillator's
// closed form (oscillator.h), eigenvectors by Jacobi rotations, and the joint in the axes of its body.
//
// X is a register or a pair of them (wide_pair.h). What lanes do depends on what stands in them alone, never on their neighbours: a branch
// here leaves out what no lane asks for, and where one does, the others keep theirs by a choice. So registers of all widths come to the same.
// Cost about 1100 operations a register with wind and gravity, of which 150 are a sweep of three Jacobi rotations; mostly two
// sweeps in float, three in double. Each operation of a rotation waits for the one before: hence pairs, and there the machine's
// square roots, which are there sooner than an iteration's result.
#pragma once
#include "wide_pair.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

// ---- a joint's turn: exp(theta) = 1 + s theta* + c1 theta*^2, J = 1 - c1 theta* + c2 theta*^2, T = J^-1 = 1 + theta*/2 + t2 theta*^2
// (math.h; J, T of the body's rates). With q = |theta|^2 all are power series: few terms up to one radian, more up to 3.5.

template <class T> struct TurnSeries {
    static constexpr int few = sizeof(T) == 4 ? 5 : 9, many = sizeof(T) == 4 ? 9 : 15, few_t2 = sizeof(T) == 4 ? 6 : 11;
    static constexpr auto c1 = coefficients<T, many>([](int k) { return (k % 2 ? -1 : 1) / factorial(2 * k + 2); });
    static constexpr auto c2 = coefficients<T, many>([](int k) { return (k % 2 ? -1 : 1) / factorial(2 * k + 3); });
    // (s - 2 c1) / q = -2 t2 c1
    static constexpr auto dc1 =
        coefficients<T, many>([](int k) { return (k % 2 ? 2 : -2) * (k + 1) / factorial(2 * k + 4); });
    static constexpr auto t2 = coefficients<T, few_t2>([](int k) { // |B_2n| / (2n)!, Bernoulli's numbers, n = k + 1
        constexpr double c[] = {1. / 12,
                                1. / 720,
                                1. / 30240,
                                1. / 1209600,
                                1. / 47900160,
                                691. / 1307674368000,
                                1. / 74724249600,
                                3617. / 10670622842880000,
                                43867. / 5109094217170944000,
                                174611. / 802857662698291200000.,
                                77683. / 14101100039391805440000.};
        return c[k];
    });
};

template <class X> struct Turn { X s, c1, c2; };
template <class X> BOUGH_FORCE Turn<X> turn_of(const X& q) {
    using S = TurnSeries<RealOf<X>>;
    X c1 = series<S::few>(S::c1, q), c2 = series<S::few>(S::c2, q);
    const X one = each<X>(1);
    if (any_above(q, one)) {
        c1 = choose_above(q, one, series<S::many>(S::c1, q), c1);
        c2 = choose_above(q, one, series<S::many>(S::c2, q), c2);
    }
    return {1 - q * c2, c1, c2};
}
template <class X> BOUGH_FORCE X t2_of(const X& q) {
    using S = TurnSeries<RealOf<X>>;
    const X t2 = series<S::few_t2>(S::t2, q), one = each<X>(1);
    if (!any_above(q, one)) return t2;
    return choose_above(q, one, series<S::many>(S::dc1, q) / (-2 * series<S::many>(S::c1, q)), t2);
}

// ---- oscillator.h

template <class W> struct WidePropagator { W B, C, E; };

// Of n oscillators side by side: each waits for its own roots and series, which is long, and meanwhile the others go on.
// In units of the step: y = b h / 2, x = lambda h^2, z = x - y^2. Up to z = -(pi/4)^2 sine and cosine of sqrt z are their power series in z,
// on both sides of critical damping; below, both roots' exponentials. Where |x| < 0.2 there, E is its own series in x and y.
template <class W, int n>
BOUGH_FORCE void propagate(const W (&b)[n], const W (&lambda)[n], RealOf<W> h, WidePropagator<W> (&p)[n]) {
    using T = RealOf<W>;
    using B = Bits<T>;
    constexpr int terms = sizeof(T) == 4 ? 6 : 10;            // of the cosine; of the sine one less
    constexpr T edge = T(0.6168502750680849);                 // (pi/4)^2
    constexpr T most = sizeof(T) == 4 ? T(1 << 21) : T(1e15); // where no digit of the phase is left
    W y[n], x[n], z[n], m[n], inverse_m[n], rounded[n], r[n], square[n], P[n], Q[n];
    for (int i = 0; i < n; ++i) {
        y[i] = (h / 2) * b[i];
        x[i] = (h * h) * lambda[i];
        z[i] = x[i] - y[i] * y[i];
        m[i] = root(magnitude(z[i]));
    }
    // sqrt z = k pi/2 + r
    for (int i = 0; i < n; ++i) {
        inverse_m[i] = 1 / m[i];
        const W angle = z[i] > 0 ? smaller(m[i], all(most)) : W{};
        rounded[i] = angle * T(0.6366197723675814) + B::rounder;
        const W k = rounded[i] - B::rounder;
        r[i] = ((angle - k * T(1.5703125)) - k * T(4.837512969970703125e-4)) - k * T(7.54978995489188216e-8);
        square[i] = k == 0 ? z[i] : r[i] * r[i];
    }
    static constexpr auto sines =
        coefficients<T, terms - 1>([](int k) { return (k % 2 ? -1 : 1) / factorial(2 * k + 1); });
    static constexpr auto cosines = coefficients<T, terms>([](int k) { return (k % 2 ? -1 : 1) / factorial(2 * k); });
    series<terms - 1>(sines, square, P);
    series<terms>(cosines, square, Q);
    W S[n], c[n], slow[n], sum[n], inverse_sum[n], decay[n]; // slow: what decays the slowest
    bool any_far = false;
    for (int i = 0; i < n; ++i) {
        const W rP = r[i] * P[i];
        const auto quadrant = typename B::Wide(rounded[i]);
        const auto odd = (quadrant & 1) != 0;
        const W sine = odd ? Q[i] : rP, cosine = odd ? rP : Q[i];
        S[i] = rounded[i] == B::rounder ? P[i] : ((quadrant & 2) != 0 ? -sine : sine) * inverse_m[i];
        c[i] = ((quadrant + 1) & 2) != 0 ? -cosine : cosine;
        slow[i] = -y[i];
        any_far |= any_above(all(-edge), z[i]);
    }
    if (any_far) {
        W twice[n], fast[n];
        for (int i = 0; i < n; ++i) twice[i] = -2 * m[i];
        exponentials(twice, fast);
        for (int i = 0; i < n; ++i) {
            sum[i] = y[i] + m[i];
            inverse_sum[i] = 1 / sum[i];
            const auto far = z[i] < -edge;
            S[i] = far ? T(0.5) * inverse_m[i] * (1 - fast[i]) : S[i];
            slow[i] = far ? -x[i] * inverse_sum[i] : slow[i];
            c[i] = far ? fast[i] : c[i];
        }
    }
    exponentials(slow, decay);
    W inverse_x[n];
    for (int i = 0; i < n; ++i) {
        inverse_x[i] = 1 / x[i];
        p[i].B = decay[i] * S[i];
        p[i].C = decay[i] * c[i] + slow[i] * p[i].B;
        p[i].E = (1 - (p[i].C + 2 * y[i] * p[i].B)) * inverse_x[i];
    }
    if (any_far) {
        static constexpr auto growth = coefficients<T, 14>([](int k) { return 1 / factorial(k + 1); });
        W near_zero[n];
        series<sizeof(T) == 4 ? 8 : 14>(growth, slow, near_zero);
        for (int i = 0; i < n; ++i) {
            const W grown = magnitude(slow[i]) < T(0.35) ? near_zero[i] : (1 - decay[i]) * sum[i] * inverse_x[i];
            p[i].E = z[i] < -edge ? (grown - p[i].B) * inverse_sum[i] : p[i].E;
        }
    }
    for (int i = 0; i < n; ++i) {
        const W small = z[i] < -edge ? all(T(1)) : magnitude(x[i]);
        if (!any_above(all(T(0.2)), small)) continue;
        W a0, a1{}, a2 = all(T(0.5)), total = a2;
        const W y2 = 2 * y[i];
        for (int k = 1; k < (sizeof(T) == 4 ? 14 : 24); ++k) {
            a0 = a1;
            a1 = a2;
            a2 = (y2 * a1) * (-1 / T(k + 2)) + (x[i] * a0) * (-1 / T((k + 1) * (k + 2)));
            total = total + a2;
        }
        p[i].E = small < T(0.2) ? total : p[i].E;
    }
    for (int i = 0; i < n; ++i) {
        p[i].B = h * p[i].B;
        p[i].E = (h * h) * p[i].E;
    }
}

// ---- eigenvectors

// One Jacobi rotation of the axes p and q, r the third: off the diagonal pq becomes 0. tan phi = 2 a_pq / (d + sqrt(d^2 + 4 a_pq^2)),
// d = |a_qq - a_pp|. Lanes in which there is nothing to turn keep what they have.
template <class X> struct Rotation { X c, s; };
template <class X> constexpr RealOf<X> negligible2() { // square of an element off the diagonal, over the diagonal ones
    constexpr RealOf<X> e = std::numeric_limits<RealOf<X>>::epsilon() / 2;
    return e * e;
}
template <class X> BOUGH_FORCE Rotation<X> rotate(X& pp, X& qq, X& pq, X& rp, X& rq) {
    const X o = pq + pq, d = qq - pp;
    const X present = pq * pq, least = negligible2<X>() * magnitude(pp * qq);
    const X hypotenuse = root(X(d * d + o * o)), along = magnitude(d) + hypotenuse;
    const X scale = 1 / root(X(2 * hypotenuse * along)); // along^2 + o^2
    Rotation<X> turn{choose_above(present, least, along * scale, each<X>(1)),
                     choose_above(present, least, with_sign_of(o, d) * scale, X{})};
    const X e = turn.s * (turn.s * d - turn.c * o);
    pp = pp + e;
    qq = qq - e;
    pq = choose_above(present, least, X{}, pq);
    const X old = rp;
    rp = turn.c * old - turn.s * rq;
    rq = turn.s * old + turn.c * rq;
    return turn;
}
template <class X> BOUGH_FORCE void rotate_columns(const Rotation<X>& turn, V3<X>& p, V3<X>& q) {
    const V3<X> old = p;
    p = turn.c * old - turn.s * q;
    q = turn.s * old + turn.c * q;
}

// Of A, which becomes diagonal: the columns of what is returned. As symmetric_eigen (spring.h), but that a lane is left alone once
// its elements off the diagonal are below half a rounding error. Elements whose squares are no normal numbers are not looked at.
template <class X> BOUGH_FORCE M3<X> symmetric_eigen(Symmetric<X>& A) {
    // The first sweep, of which the axes are still what they were.
    const Rotation<X> a = rotate(A.xx, A.yy, A.xy, A.xz, A.yz), b = rotate(A.xx, A.zz, A.xz, A.xy, A.yz),
                      c = rotate(A.yy, A.zz, A.yz, A.xy, A.xz);
    const V3<X> z{b.s * a.c, -b.s * a.s, b.c};
    M3<X> V{{b.c * a.c, -b.c * a.s, -b.s},
            {c.c * a.s - c.s * z.x, c.c * a.c - c.s * z.y, -c.s * z.z},
            {c.s * a.s + c.c * z.x, c.s * a.c + c.c * z.y, c.c * z.z}};
    for (int sweep = 1; sweep < 6; ++sweep) { // yz is 0 after each
        constexpr auto share = negligible2<X>();
        if (!(any_above(A.xy * A.xy, share * magnitude(A.xx * A.yy)) ||
              any_above(A.xz * A.xz, share * magnitude(A.xx * A.zz))))
            break;
        rotate_columns(rotate(A.xx, A.yy, A.xy, A.xz, A.yz), V.x, V.y);
        rotate_columns(rotate(A.xx, A.zz, A.xz, A.xy, A.yz), V.x, V.z);
        rotate_columns(rotate(A.yy, A.zz, A.yz, A.xy, A.xz), V.y, V.z);
    }
    return V;
}

// ---- the joint

template <class X> struct JointLoad { // in the axes of its body
    Symmetric<X> J;                   // [kg m^2] composite's inertia about the joint
    V3<X> h, g;                       // [kg m], [m/s^2] first moment, gravity
    V3<X> tau, drag_tau;              // [N m] of forces, and of the air on the body's own velocity
    X drag_row, wind_row, turn_row;   // drag.h
    V3<X> theta, rate;                // rate: scaled_rate
    V3<X> K;
    X beta, bend, twist, gravity_row, inverse_weight;
};
template <class X> struct JointStep {
    V3<X> phi, theta;         // [rad] turn in the step, theta after it, however long
    V3<X> rate, omega;        // scaled_rate, and [rad/s] the joint's rate in the axes of its body
    V3<X> rate_before;        // with the drag
    bool bounded = false;     // some lambda was
    X lambda[3], with_air[3]; // [1/s^2]
};

template <class X> struct Cholesky { // S = L L^T: of L^-1, and L
    X i0, i1, i2, n10, n20, n21;
    X l10, l20, l21;
};
template <class X> BOUGH_FORCE Cholesky<X> cholesky(const Symmetric<X>& S) {
    Cholesky<X> c;
    c.i0 = inverse_root(S.xx);
    c.l10 = S.xy * c.i0;
    c.l20 = S.xz * c.i0;
    c.i1 = inverse_root(S.yy - c.l10 * c.l10);
    c.l21 = (S.yz - c.l20 * c.l10) * c.i1;
    c.i2 = inverse_root(S.zz - c.l20 * c.l20 - c.l21 * c.l21);
    c.n10 = -c.l10 * c.i0 * c.i1;
    c.n21 = -c.l21 * c.i1 * c.i2;
    c.n20 = -(c.l20 * c.i0 + c.l21 * c.n10) * c.i2;
    return c;
}
// L^-1 A L^-T.
template <class X> BOUGH_FORCE Symmetric<X> reduced(const Cholesky<X>& c, const Symmetric<X>& A) {
    const X r00 = c.i0 * A.xx;
    const X r10 = c.n10 * A.xx + c.i1 * A.xy, r11 = c.n10 * A.xy + c.i1 * A.yy;
    const X r20 = c.n20 * A.xx + c.n21 * A.xy + c.i2 * A.xz, r21 = c.n20 * A.xy + c.n21 * A.yy + c.i2 * A.yz,
            r22 = c.n20 * A.xz + c.n21 * A.yz + c.i2 * A.zz;
    return {r00 * c.i0,
            r10 * c.i0,
            r20 * c.i0,
            r10 * c.n10 + r11 * c.i1,
            r20 * c.n10 + r21 * c.i1,
            r20 * c.n20 + r21 * c.n21 + r22 * c.i2};
}
// L^-T v.
template <class X> BOUGH_FORCE V3<X> back(const Cholesky<X>& c, const V3<X>& v) {
    return {c.i0 * v.x + c.n10 * v.y + c.n20 * v.z, c.i1 * v.y + c.n21 * v.z, c.i2 * v.z};
}
// N^-1 v, N positive, by N = L D L^T.
template <class X> BOUGH_FORCE V3<X> solved_by(const Symmetric<X>& N, const V3<X>& v) {
    const X q0 = 1 / N.xx, l1 = N.xy * q0, l2 = N.xz * q0;
    const X q1 = 1 / (N.yy - l1 * N.xy), m = N.yz - l2 * N.xy, l3 = m * q1;
    const X q2 = 1 / (N.zz - l2 * N.xz - l3 * m);
    const X b1 = v.y - l1 * v.x, b2 = v.z - l2 * v.x - l3 * b1;
    const X z = b2 * q2, y = b1 * q1 - l3 * z;
    return {v.x * q0 - l1 * y - l2 * z, y, z};
}

// T^T K T for diagonal K.
template <class X> BOUGH_FORCE Symmetric<X> sandwiched(const M3<X>& T, const V3<X>& K) {
    const auto times = [&](const V3<X>& v) { return V3<X>{K.x * v.x, K.y * v.y, K.z * v.z}; };
    const V3<X> x = times(T.x), y = times(T.y), z = times(T.z);
    return {dot(T.x, x), dot(T.x, y), dot(T.x, z), dot(T.y, y), dot(T.y, z), dot(T.z, z)};
}

// 1 + a theta* + b theta*^2.
template <class X> BOUGH_FORCE M3<X> turn_form(const V3<X>& t, const X& q, const X& a, const X& b) {
    const X d = 1 - b * q;
    const V3<X> s = a * t, bt = b * t;
    const X xy = bt.x * t.y, xz = bt.x * t.z, yz = bt.y * t.z;
    return {{d + bt.x * t.x, xy + s.z, xz - s.y},
            {xy - s.z, d + bt.y * t.y, yz + s.x},
            {xz + s.y, yz - s.x, d + bt.z * t.z}};
}

// T v, v the body's rate.
template <class X> BOUGH_FORCE V3<X> rate_of(const V3<X>& theta, const X& q, const V3<X>& v) {
    const V3<X> across = cross(theta, v);
    return v + RealOf<X>(0.5) * across + t2_of(q) * cross(theta, across);
}

// largest: largest_lambda (oscillator.h).
template <bool wind, bool gravity, bool forces, class X>
BOUGH_FORCE JointStep<X> step_joint(const JointLoad<X>& in, RealOf<X> h, RealOf<X> largest) {
    using T = RealOf<X>;
    JointStep<X> out;
    // S of joint.h
    const X bb = in.bend * in.bend, bt = in.bend * in.twist;
    Symmetric<X> S{bb * in.J.xx, bb * in.J.xy, bt * in.J.xz, bb * in.J.yy, bt * in.J.yz, in.twist * in.twist * in.J.zz};
    const X rounding = 4 * std::numeric_limits<T>::epsilon() * (S.xx + S.yy + S.zz);
    S.xx = S.xx + rounding, S.yy = S.yy + rounding, S.zz = S.zz + rounding;
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
    Symmetric<X> KG = sandwiched(rates, in.K);
    X weight; // g.h and the row
    const V3<X> spring{in.K.x * in.theta.x, in.K.y * in.theta.y, in.K.z * in.theta.z};
    V3<X> residual = -transposed_times(rates, spring);
    if constexpr (forces) residual = residual + in.tau;
    if constexpr (gravity) {
        residual = residual + cross(in.h, in.g);
        const X x = in.h.x * in.g.x, y = in.h.y * in.g.y, z = in.h.z * in.g.z;
        weight = in.gravity_row + (x + y + z);
        KG.xx = KG.xx + (weight - x), KG.yy = KG.yy + (weight - y), KG.zz = KG.zz + (weight - z);
        KG.xy = KG.xy - T(0.5) * (in.h.x * in.g.y + in.h.y * in.g.x);
        KG.xz = KG.xz - T(0.5) * (in.h.x * in.g.z + in.h.z * in.g.x);
        KG.yz = KG.yz - T(0.5) * (in.h.y * in.g.z + in.h.z * in.g.y);
    }

    Symmetric<X> A = reduced(L, KG);
    const X biggest = larger(larger(magnitude(A.xx), magnitude(A.yy)), magnitude(A.zz));
    const bool huge = any_above(biggest, each<X>(sizeof(T) == 4 ? T(1e15) : T(1e150)));
    Scale<X> unit;
    if (huge) { // scaled, exactly, so that no square overflows
        unit = scale_of(biggest);
        A = unit.inverse * A;
    }
    const M3<X> V = symmetric_eigen(A);
    if (huge) A.xx = unit.power * A.xx, A.yy = unit.power * A.yy, A.zz = unit.power * A.zz;
    const M3<X> U{back(L, V.x), back(L, V.y), back(L, V.z)};
    out.lambda[0] = A.xx, out.lambda[1] = A.yy, out.lambda[2] = A.zz;

    const V3<X>* columns[3] = {&U.x, &U.y, &U.z};
    const X r[3] = {dot(U.x, residual), dot(U.y, residual), dot(U.z, residual)};
    const X v[3] = {dot(V.x, w), dot(V.y, w), dot(V.z, w)};
    const X size2[3] = {dot(U.x, U.x), dot(U.y, U.y), dot(U.z, U.z)};
    X row[3];
    if constexpr (wind) {
        const X xy = magnitude(dot(U.x, U.y)), xz = magnitude(dot(U.x, U.z)), yz = magnitude(dot(U.y, U.z));
        row[0] = size2[0] + xy + xz, row[1] = size2[1] + xy + yz, row[2] = size2[2] + xz + yz;
    }
    constexpr int parts = Registers<X>::count;
    using W = std::remove_cvref_t<decltype(Registers<X>::part(row[0], 0))>;
    X dq[3], v_new[3];
    for (int k = 0; k < 3; ++k) {
        X b, l = out.lambda[k], force = r[k];
        if constexpr (gravity) // U^T K U = lambda - U^T G U
            b = in.beta * larger(l - (weight * size2[k] - dot(in.h, *columns[k]) * dot(in.g, *columns[k])), X{});
        else
            b = in.beta * l;
        if constexpr (wind) {
            const X d = row[k] * in.inverse_weight * in.wind_row;
            b = b + d;
            l = l + row[k] * in.turn_row;
            force = force + d * v[k];
        }
        out.with_air[k] = l;
        if (any_above(l, each<X>(largest))) {
            out.bounded = true;
            const X most = each<X>(largest), ratio = choose_above(l, most, largest / l, each<X>(1));
            b = ratio * b;
            l = choose_above(l, most, most, l);
            force = ratio * force;
        }
        W damping[parts], stiffness[parts];
        for (int j = 0; j < parts; ++j) {
            damping[j] = Registers<X>::part(b, j);
            stiffness[j] = Registers<X>::part(l, j);
        }
        WidePropagator<W> p[parts];
        propagate(damping, stiffness, h, p);
        X B, C, E;
        for (int j = 0; j < parts; ++j)
            Registers<X>::part(B, j) = p[j].B, Registers<X>::part(C, j) = p[j].C, Registers<X>::part(E, j) = p[j].E;
        dq[k] = E * force + B * v[k];
        v_new[k] = B * force + C * v[k];
    }
    const V3<X> modes{v_new[0], v_new[1], v_new[2]};
    out.phi = U * V3<X>{dq[0], dq[1], dq[2]};
    out.theta = in.theta + rates * out.phi;
    out.rate = V * modes;
    out.omega = U * modes;
    return out;
}

} // namespace BOUGH_TARGET
} // namespace bough::fast
