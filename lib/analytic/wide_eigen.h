// wide_eigen.h: eigenvectors of symmetric 3x3 matrices by Jacobi rotations (base/symmetric_eigen.h), for registers of lanes.
//
// It is written a second time because one number stops where its matrix is diagonal, while lanes turn until the last of them is, and a choice keeps
// those that are. A sweep of three rotations is about 150 operations a register. Two sweeps mostly suffice in float, three in double. Each operation
// of a rotation waits for the one before. Hence pairs (wide_pair.h), and the machine's square roots, which are there sooner than an iteration's
// result.
#pragma once
#include "../lanes/wide_pair.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

// Does one Jacobi rotation of the axes p and q, with r the third: the off-diagonal element pq becomes 0. tan phi = 2 a_pq / (d + sqrt(d^2 + 4
// a_pq^2)), d = |a_qq - a_pp|. Lanes in which there is nothing to turn keep what they have.
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

// Returns the eigenvectors of A as columns; A becomes diagonal. It is as bough::symmetric_eigen, except that a lane is left alone once its
// elements off the diagonal are below half a rounding error. Elements whose squares are no normal numbers are not looked at.
template <class X> BOUGH_FORCE M3<X> symmetric_eigen(Symmetric<X>& A) {
    // The first sweep, whose axes are still the original ones.
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

} // namespace BOUGH_TARGET
} // namespace bough::fast
