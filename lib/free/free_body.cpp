#include "free_body.h"
#include "../laws/air.h"
#include "../model/body_shape.h"
#include "../model/own_inertia.h"
#include "../model/scene.h"
#include "shape.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace bough {

void finish(FreeBody& body) {
    body.inertia = own_inertia(body.inertia);
    body.inverse_inertia = body.inertia.inverse();
    const Eigen::SelfAdjointEigenSolver<Mat3> principal(body.inertia);
    body.axes = principal.eigenvectors();
    if (body.axes.determinant() < 0) body.axes.col(0) *= -1;
    body.moments = principal.eigenvalues();
    body.bound = 0;
    for (const FreePart& part : body.parts) {
        const Capsule c = capsule_of(part.kind, part.size);
        const Vec3 a = part.joint + part.q * c.a, b = part.joint + part.q * c.b;
        body.bound = std::max({body.bound, a.norm() + c.radius_a, b.norm() + c.radius_b});
    }
}

Capsule placed(const FreeMotion& motion, const FreePart& part) {
    const Capsule own = placed(capsule_of(part.kind, part.size), part.q, part.joint);
    return placed(own, motion.q, motion.x);
}

FreeBody free_ball(const Ball& ball, double air_density) {
    FreeBody body;
    body.motion.x = ball.position;
    body.motion.v = ball.velocity;
    body.motion.omega = ball.angular_velocity;
    body.mass = ball.mass;
    body.inertia = 0.4 * ball.mass * ball.radius * ball.radius * Mat3::Identity();
    FreePart part;
    part.size = Vec3(0, ball.radius, ball.radius);
    part.drag_area = ::bough::drag_area(part.kind, part.size, air_density);
    body.parts.push_back(part);
    finish(body);
    return body;
}

} // namespace bough
