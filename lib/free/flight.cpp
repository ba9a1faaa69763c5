#include "flight.h"
#include "../laws/air.h"
#include "leaf_flight.h"
#include <Eigen/LU>

namespace bough {
namespace {

struct AirLoad {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero(); // [N], [N m] about the centre of mass
    double damping = 0, turning = 0;                  // [N s/m], [N m s]
};

// Where there is no wind the air stands still.
Vec3 wind_at(const WindTable<double>* wind, const Vec3& place) {
    return wind ? wind->at(place) : Vec3(Vec3::Zero());
}

AirLoad air_on(const FreeBody& free, const WindTable<double>* wind) {
    AirLoad load;
    const Mat3 R = free.motion.q.toRotationMatrix();
    for (const FreePart& part : free.parts) {
        const Vec3 arm = R * part.com;
        const Vec3 u = wind_at(wind, Vec3(free.motion.x + arm)) - free.velocity_at(arm);
        const AirForce<double> air = air_force(part.kind, Mat3(R * part.q.toRotationMatrix()), u);
        load.force += part.drag_area * air.force;
        load.moment += part.drag_area * arm.cross(air.force);
        const double d = 2 * part.drag_area * u.norm();
        load.damping += d;
        load.turning += d * arm.squaredNorm();
    }
    return load;
}

// A leaf's own axes are its frame's but for the centre of mass: x along the width, y the normal, principal (body_shape.h).
FreeMotion fly_card(const FreeBody& free, const Scene& scene, const WindTable<double>* wind, double h) {
    const FreePart& part = free.parts.front();
    const Mat3 R = part.q.toRotationMatrix();
    const Mat3 inertia = R.transpose() * free.inertia * R;
    const LeafCard card{free.mass, inertia.diagonal(), leaf_area(part.size[0], part.size[1])};
    FreeMotion next = free.motion;
    next.q = (free.motion.q * part.q).normalized();
    fly_leaf(scene.leaves.value_or(LeafAir()), card, wind_at(wind, free.motion.x), scene.gravity, scene.air_density, h,
             next);
    next.q = (next.q * part.q.conjugate()).normalized();
    return next;
}

// From q on under the angular momentum L, world.
void turn_freely(const FreeBody& free, const Vec3& L, double h, FreeMotion& motion) {
    Quat q = motion.q;
    const auto turn_about = [&](int axis, double time) {
        const double along = Vec3(free.axes.col(axis)).dot(q.conjugate() * L);
        const double rate = along * (1 / free.moments[axis] - 1 / free.moments[2]);
        q = q * quaternion_from_vector(Vec3(time * rate * free.axes.col(axis)));
    };
    turn_about(0, h / 2);
    turn_about(1, h);
    turn_about(0, h / 2);
    motion.q = (quaternion_from_vector(Vec3(h / free.moments[2] * L)) * q).normalized();
    const Mat3 R = motion.q.toRotationMatrix();
    motion.omega = R * free.inverse_inertia * R.transpose() * L;
}

} // namespace

FreeMotion fly(const FreeBody& free, const Scene& scene, const WindTable<double>* wind, double h) {
    if (free.leaf()) return fly_card(free, scene, wind, h);
    FreeMotion next = free.motion;
    const AirLoad air = scene.air_density > 0 ? air_on(free, wind) : AirLoad();
    next.v += h / (free.mass + h * air.damping) * (free.mass * scene.gravity + air.force);
    const Mat3 R = free.motion.q.toRotationMatrix();
    const Mat3 inertia = R * free.inertia * R.transpose();
    next.omega += (inertia + h * air.turning * Mat3::Identity()).inverse() * Vec3(h * air.moment);
    next.x += h * next.v;
    turn_freely(free, Vec3(inertia * next.omega), h, next);
    return next;
}

} // namespace bough
