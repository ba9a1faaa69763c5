// wide_air.h: the air's law (laws/air.h, air_load.h) in lanes, except leaves' own (wide_leaf.h).
//
// It is written a second time because a kind is known for a whole group of rows, and speed and its inverse are worked out once and early for force,
// damping and turning together. Each of the scalar's functions takes a root and a quotient of its own. The lanes' tests hold the two together.
#pragma once
#include "../model/air_constants.h"
#include "../model/kind.h"
#include "wide_pair.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

template <class W> struct AirSpeed {
    W speed, inverse;
}; // [m/s] of the air that drags, and 1 over it, finite where it is 0
// Returns the speed of the air at velocity u past the body. It is apart from air_on(), so that what does not wait for it can go in between.
template <Kind kind, class W, class T = RealOf<W>> BOUGH_FORCE AirSpeed<W> air_speed(const V3<W>& u, const M3<W>& R) {
    V3<W> across = u;
    if constexpr (kind == Kind::branch) across = u - dot(u, R.z) * R.z;
    const W speed = root(dot(across, across));
    return {speed, 1 / larger(speed, all(T(1e-30)))};
}

// unfolding() of air_constants.h. Only in its Folds does a clump without a face differ from a fruit.
template <Kind kind, class W, class T = RealOf<W>> BOUGH_FORCE Unfolding<W> unfolding(Folds<T> folds, const W& speed) {
    const W opened = 1 + folds.fold * speed;
    if constexpr (kind == Kind::leaf) {
        const W g = 1 / opened;
        return {g, g * g};
    }
    const W square = smaller(speed * speed, all(T(1e9))), turned = 1 + folds.turn * square * square;
    const W both = 1 / (opened * turned), g = turned * both,
            r = opened * both; // one division for two; at 1e9 r is nothing
    const W h = all(T(streamed)) + T(1 - streamed) * r;
    return {g * h, g * (g * h - T(4 * (1 - streamed)) * r * (1 - r))};
}

// The law's factors of (u.n) n and of u (Facing of air.h): of a leaf, and of a clump with a face. Kind::clump is the latter alone in what is compiled
// for a kind, and all others go as fruit do. facing: of a clump.
template <class N> struct WideFacing { N along, all_ways; };
template <Kind kind, class W, class T = RealOf<W>> BOUGH_FORCE auto facing_of(const W& facing) {
    if constexpr (kind == Kind::leaf)
        return WideFacing<T>{T(1 - streaming_drag), T(streaming_drag)};
    else
        return WideFacing<W>{T(facing_along) * facing, 1 - T(facing_less) * facing};
}
// True for a kind whose force depends on its normal.
constexpr bool has_face(Kind kind) {
    return kind == Kind::leaf || kind == Kind::clump;
}

template <class W> struct AirOn {
    V3<W> force; // [N] with the drag of the velocity ahead
    Symmetric<W> D;
};

// Returns force and damping, and adds to H how a leaf's moment changes with its turning. arm: |com|.
template <Kind kind, class W, class T = RealOf<W>>
BOUGH_FORCE AirOn<W> air_on(const V3<W>& u, const AirSpeed<W>& s, const V3<W>& ahead, const M3<W>& R, const W& scale,
                            Symmetric<W>& H, const W& arm, Folds<T> folds, const W& facing) {
    AirOn<W> out;
    W one = scale * s.speed, more = scale * s.inverse;
    if constexpr (kind != Kind::branch) {
        const Unfolding<W> G = unfolding<kind>(folds, s.speed);
        one = G.share * one;
        more = G.slope * more;
    }
    if constexpr (kind == Kind::clump) { // along y
        const auto [across, all_ways] = facing_of<kind>(facing);
        const V3<W> du = W(all_ways * more) * u;
        const W s_one = all_ways * one, dn = across * (one + more * u.y * u.y);
        out.D = {s_one + du.x * u.x, du.x * u.y, du.x * u.z, s_one + du.y * u.y + dn, du.y * u.z, s_one + du.z * u.z};
        out.force = s_one * u + out.D * ahead;
        out.force.y = out.force.y + across * one * u.y;
    } else if constexpr (kind == Kind::leaf) {
        const V3<W>&n = R.y, &x = R.x;
        const W along = dot(u, n);
        const auto [across, all_ways] = facing_of<kind>(facing);
        const W s_one = all_ways * one;
        const V3<W> dn = W(across * (one + more * along * along)) * n, du = W(all_ways * more) * u;
        out.D = {s_one + du.x * u.x + dn.x * n.x, du.x * u.y + dn.x * n.y, du.x * u.z + dn.x * n.z,
                 s_one + du.y * u.y + dn.y * n.y, du.y * u.z + dn.y * n.z, s_one + du.z * u.z + dn.z * n.z};
        out.force = W(across * one * along) * n + s_one * u + out.D * ahead;
        const V3<W> hx = W(2 * across * one * arm * s.speed) * x;
        H = H + Symmetric<W>{hx.x * x.x, hx.x * x.y, hx.x * x.z, hx.y * x.y, hx.y * x.z, hx.z * x.z};
    } else {
        V3<W> across = u;
        const V3<W>& t = R.z;
        if constexpr (kind == Kind::branch) across = u - dot(u, t) * t;
        const V3<W> m = more * across;
        out.D = {one + m.x * across.x, m.x * across.y, m.x * across.z,
                 one + m.y * across.y, m.y * across.z, one + m.z * across.z};
        if constexpr (kind == Kind::branch) {
            const V3<W> s_t = one * t;
            out.D = out.D - Symmetric<W>{s_t.x * t.x, s_t.x * t.y, s_t.x * t.z, s_t.y * t.y, s_t.y * t.z, s_t.z * t.z};
        }
        out.force = one * across + out.D * ahead;
    }
    return out;
}

// streaming_stiffness. past: |u|. P: first moment of what is carried.
template <class W, class T = RealOf<W>>
BOUGH_FORCE Symmetric<W> streaming_stiffness(Folds<T> folds, const V3<W>& P, const V3<W>& u, const W& past) {
    const W along = past * unfolding<Kind::leaf>(folds, past).share * larger(dot(P, u), W{});
    const V3<W> p = W(along / larger(dot(P, P), all(T(1e-30)))) * P;
    return {along - p.x * P.x, -(p.x * P.y), -(p.x * P.z), along - p.y * P.y, -(p.y * P.z), along - p.z * P.z};
}

// spin_rate of foliage. folded: [m/s] G |u|.
template <Kind kind, class W, class T = RealOf<W>>
BOUGH_FORCE W spin_rate(const W& scale, const W& mass, const W& folded) {
    return T(kind == Kind::leaf ? blade_turning : clump_turning) * scale / larger(mass, all(T(1e-30))) * folded;
}

// air_work_bound without leaves' own. U: the wind's velocity, speed2 its square. relative: u.
template <Kind kind, class W, class T = RealOf<W>>
BOUGH_FORCE W air_work_bound(T h, const W& scale, const W& speed2, const V3<W>& relative, const W& facing) {
    W most{};
    if constexpr (has_face(kind)) most = T(0.25) * root(dot(relative, relative)) * speed2;
    if constexpr (kind == Kind::clump) most = facing_of<kind>(facing).along * most;
    if constexpr (kind != Kind::leaf) {
        const W others = T(4.0 / 27) * root(speed2) * speed2;
        if constexpr (kind == Kind::clump)
            most = most + facing_of<kind>(facing).all_ways * others;
        else
            most = others;
    }
    return h * scale * most;
}

// Returns the force over kappa rho A in the body's own axes, and the speed that scales it (AirForce). up: the upright there.
template <Kind kind, class W, class T = RealOf<W>>
BOUGH_FORCE V3<W> air_in_body_axes(const V3<W>& u, W& speed, Folds<T> folds, const W& facing, const V3<W>& up) {
    if constexpr (kind == Kind::branch) {
        speed = root(W(u.x * u.x + u.y * u.y));
        return {speed * u.x, speed * u.y, W{}};
    } else {
        speed = root(dot(u, u));
        speed = unfolding<kind>(folds, speed).share * speed;
        if constexpr (kind == Kind::fruit) return speed * u;
        const auto [along, all_ways] = facing_of<kind>(facing);
        const W streams = all_ways * speed;
        if constexpr (kind == Kind::clump)
            return streams * u + W(along * speed * dot(u, up)) * up;
        else
            return {streams * u.x, (along + all_ways) * speed * u.y, streams * u.z};
    }
}

} // namespace BOUGH_TARGET
} // namespace bough::fast
