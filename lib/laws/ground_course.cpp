#include "ground_course.h"
#include "../base/nearest_vector.h"

namespace bough {
namespace {

bool unresolved(const Vec3& slope, const Vec3& before, const Vec3& after, const Vec3& way, double h) {
    const double off = (slope - (after - before)).norm();
    return off > (before.norm() + after.norm()) / 32 && h * h / 12 * off > 1e-6 * way.norm();
}

} // namespace

GroundCourse ground_course(const RootSpline& spline, double t, double h) {
    GroundCourse c;
    c.start = ground_at(spline, t);
    c.end = ground_at(spline, t + h);
    const auto pivot = [&](double at) { return spline.position ? curve_at(*spline.position, at) : CurvePoint{}; };
    const CurvePoint before = pivot(t), after = pivot(t + h);
    const Vec3 mean_omega = (c.start.omega + c.end.omega) / 2;
    // A ground that does not turn has the same R bit by bit, and no rounding error of R R^T.
    const bool turns = !(c.start.R.array() == c.end.R.array()).all();
    c.turned = turns ? nearest_vector(Quat(Mat3(c.end.R * c.start.R.transpose())), h * mean_omega) : Vec3(Vec3::Zero());
    const Vec3 integral = c.turned + h * h / 12 * c.start.omega.cross(c.end.omega);
    c.v_0 = before.v;
    c.v_1 = after.v;
    c.a = (c.v_1 - c.v_0) / h;
    c.slope = 12 / h * ((c.v_0 + c.v_1) / 2 - (after.x - before.x) / h);
    c.alpha = (c.end.omega - c.start.omega) / h;
    c.slope_turn = 12 / h * (mean_omega - integral / h);
    c.jumps = unresolved(c.slope, before.a, after.a, after.x - before.x, h) ||
              unresolved(c.slope_turn, c.start.alpha, c.end.alpha, c.turned, h);
    return c;
}

} // namespace bough
