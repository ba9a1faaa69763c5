// hyper_dual.h: numbers that carry first and second derivatives of whatever is computed with them, exactly (Fike, Alonso, AIAA 2011-886), and vectors and turns of
// them.
#pragma once
#include "lib/base/math.h"

namespace hyper_dual {

using namespace bough;

// a + b e1 + c e2 + d e1 e2: b, c, d carry the derivatives of whatever is computed with them.
struct Dual {
    double a = 0, b = 0, c = 0, d = 0;
    Dual() = default;
    Dual(double value) : a(value) {} // NOLINT: numbers are such
    Dual(double value, double first, double second) : a(value), b(first), c(second) {}
};
inline Dual operator+(const Dual& x, const Dual& y) {
    Dual z(x.a + y.a, x.b + y.b, x.c + y.c);
    z.d = x.d + y.d;
    return z;
}
inline Dual operator*(const Dual& x, const Dual& y) {
    Dual z(x.a * y.a, x.a * y.b + x.b * y.a, x.a * y.c + x.c * y.a);
    z.d = x.a * y.d + x.b * y.c + x.c * y.b + x.d * y.a;
    return z;
}
inline Dual operator-(const Dual& x, const Dual& y) {
    return x + Dual(-1) * y;
}
// f(x) by f, f', f'' at its value.
inline Dual chain(const Dual& x, double f, double f1, double f2) {
    Dual z(f, f1 * x.b, f1 * x.c);
    z.d = f1 * x.d + f2 * x.b * x.c;
    return z;
}

struct DualVector {
    Dual x, y, z;
};
inline DualVector operator+(const DualVector& u, const DualVector& v) {
    return {u.x + v.x, u.y + v.y, u.z + v.z};
}
struct DualTurn { // a quaternion
    Dual w;
    DualVector v;
};
inline DualTurn operator*(const DualTurn& p, const DualTurn& q) {
    return {p.w * q.w - p.v.x * q.v.x - p.v.y * q.v.y - p.v.z * q.v.z,
            {p.w * q.v.x + p.v.x * q.w + p.v.y * q.v.z - p.v.z * q.v.y,
             p.w * q.v.y - p.v.x * q.v.z + p.v.y * q.w + p.v.z * q.v.x,
             p.w * q.v.z + p.v.x * q.v.y - p.v.y * q.v.x + p.v.z * q.w}};
}
inline DualTurn dual(const Quat& q) {
    return {q.w(), {q.x(), q.y(), q.z()}};
}
inline DualVector turned(const DualTurn& q, const Vec3& r) {
    const DualTurn image =
        q * DualTurn{0, {r.x(), r.y(), r.z()}} * DualTurn{q.w, {Dual(-1) * q.v.x, Dual(-1) * q.v.y, Dual(-1) * q.v.z}};
    return image.v;
}

} // namespace hyper_dual
