#include "flight.h"
#include "../stages/air.h"
#include <Eigen/LU>

namespace bough {
namespace {

struct AirLoad {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero(); // [N], [N m] about the centre of mass
    double damping = 0, turning = 0;                  // [N s/m], [N m s]
};

AirLoad air_on(const FreeBody& free, const WindTable<double>& wind) {
    AirLoad load;
    const Mat3 R = free.motion.q.toRotationMatrix();
    for (const FreePart& part : free.parts) {
        const Vec3 arm = R * part.com;
        const Vec3 u = wind.at((free.motion.x + arm).y()) - free.velocity_at(arm);
        const AirForce<double> air = air_force(part.kind, Mat3(R * part.q.toRotationMatrix()), u);
        load.force += part.drag_area * air.force;
        load.moment += part.drag_area * arm.cross(air.force);
        const double d = 2 * part.drag_area * u.norm();
        load.damping += d;
        load.turning += d * arm.squaredNorm();
    }
    return load;
}

} // namespace

FreeMotion fly(const FreeBody& free, const Scene& scene, const WindTable<double>* wind, double h) {
    FreeMotion next = free.motion;
    const AirLoad air = wind ? air_on(free, *wind) : AirLoad();
    next.v += h / (free.mass + h * air.damping) * (free.mass * scene.gravity + air.force);
    const Mat3 R = free.motion.q.toRotationMatrix();
    const Mat3 inertia = R * free.inertia * R.transpose();
    next.omega += (inertia + h * air.turning * Mat3::Identity()).inverse() * Vec3(h * air.moment);
    const Vec3 spin = inertia * next.omega;
    next.x += h * next.v;
    next.q = (quaternion_from_vector(Vec3(h * next.omega)) * free.motion.q).normalized();
    const Mat3 turned = next.q.toRotationMatrix();
    next.omega = turned * free.inverse_inertia * turned.transpose() * spin;
    return next;
}

} // namespace bough
