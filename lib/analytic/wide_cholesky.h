// wide_cholesky.h: factors of positive symmetric 3x3 matrices, for registers of lanes.
// It is written a second time beside base/cholesky.h. That one solves with L, which divides; lanes divide three times a matrix, for L^-1, and
// multiply from there.
#pragma once
#include "../lanes/wide_pair.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

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

} // namespace BOUGH_TARGET
} // namespace bough::fast
