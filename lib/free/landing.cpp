#include "landing.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

constexpr double lying_time = 0.08;  // [s]
constexpr double lying_angle = 0.01; // [rad]

// The lowest of the triangle's corners, from the centre of mass [m].
double lowest(const FreeBody& leaf) {
    const FreePart& part = leaf.parts.front();
    const Quat q = leaf.motion.q * part.q;
    const Vec3 joint = leaf.motion.q * part.joint;
    const double length = part.size[0], half = part.size[1] / 2, thick = part.size[2] / 2;
    double y = INFINITY;
    for (const Vec3& corner : {Vec3(-half, 0, 0), Vec3(half, 0, 0), Vec3(0, 0, length)})
        y = std::min(y, (joint + q * corner).y());
    return y - thick;
}

} // namespace

bool lie_down(FreeBody& leaf, double ground_height, double h) {
    FreeMotion& motion = leaf.motion;
    if (motion.x.y() + lowest(leaf) > ground_height && leaf.quiet == 0) return false;
    const bool first = leaf.quiet == 0;
    leaf.quiet += h;
    motion.v = motion.omega = Vec3::Zero();
    const Vec3 normal = motion.q * (leaf.parts.front().q * Vec3(Vec3::UnitY()));
    const Vec3 up = normal.y() < 0 ? Vec3(-Vec3::UnitY()) : Vec3(Vec3::UnitY());
    const Vec3 turn = vector_from_quaternion(shortest_turn(normal, up));
    const bool lies = turn.norm() < lying_angle;
    const double part = lies ? 1 : 1 - std::exp(-h / lying_time);
    motion.q = (quaternion_from_vector(Vec3(part * turn)) * motion.q).normalized();
    motion.x.y() = ground_height - lowest(leaf);
    leaf.at_rest = lies;
    return first;
}

} // namespace bough
