// quintic.h: a smooth curve through keys: the interpolant of least integrated squared jerk that is at rest outside them.
//
// Of all curves through the keys with velocity and acceleration zero at the first and last, take the one that makes integral |x'''|^2 dt least. It is
// a polynomial of degree 5 between keys, and x to x'''' are continuous at the keys between. Its unknowns are v and a at those keys. With D = x_1 -
// x_0 over a piece of length h,
//   x'''(0)  = ( 60 D - h (36 v_0 + 24 v_1) - h^2 (9 a_0 - 3 a_1)) / h^3,       x'''(h)  by reversing time,
//   x''''(0) = (-360 D + h (192 v_0 + 168 v_1) + h^2 (36 a_0 - 24 a_1)) / h^4,
// and equal x''', x'''' on both sides of each key make a system of 2x2 blocks. It is tridiagonal, symmetric and positive definite (the gradient of
// that integral), so block elimination without pivoting solves it. Two keys give the minimum-jerk polynomial x_0 + D (10 s^3 - 15 s^4 + 6 s^5). Like
// every such curve it may swing past a key.
#pragma once
#include "math.h"
#include <vector>

namespace bough {

struct QuinticSpline {
    std::vector<double> time;  // [s] rising, at least 2
    std::vector<Vec3> x, v, a; // value and its two derivatives at each key
};

struct CurvePoint {
    Vec3 x = Vec3::Zero(), v = Vec3::Zero(), a = Vec3::Zero();
};

// Makes the curve. time rises; there is one x a time, at least 2. O(keys).
QuinticSpline make_quintic(const std::vector<double>& time, const std::vector<Vec3>& x);

// Returns value, velocity and acceleration at t. Outside the keys it is the nearest key's value, at rest. O(log keys).
CurvePoint curve_at(const QuinticSpline&, double t);

// Returns an upper bound on component `axis` over all times: the greatest Bezier point of all pieces. O(keys).
double greatest(const QuinticSpline&, int axis);

} // namespace bough
