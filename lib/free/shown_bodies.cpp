#include "../model/drawn_pose.h"
#include "world.h"

namespace bough {

template <class T> void place_free_bodies(const World<T>& world, MotionFrame& frame) {
    if (!world.on()) return;
    const std::size_t bodies = world.tree->size_bodies();
    for (auto* array :
         {&frame.position, &frame.velocity, &frame.angular_velocity, &frame.torque, &frame.theta, &frame.theta_dot})
        if (!array->empty()) array->resize(bodies + world.balls + world.walkers.size(), Vec3::Zero());
    if (!frame.stress.empty()) frame.stress.resize(bodies + world.balls + world.walkers.size(), 0);
    if (!frame.rotation.empty()) frame.rotation.resize(bodies + world.balls + world.walkers.size(), Quat::Identity());
    for (std::size_t k = 0; k < world.free.size(); ++k) {
        const FreeBody& free = world.free[k];
        const FreeMotion& m = free.motion;
        for (const FreePart& part : free.parts) {
            const std::size_t i = free.ball() ? bodies + k : std::size_t(part.body);
            if (!frame.position.empty()) frame.position[i] = m.x + m.q * part.joint;
            if (!frame.rotation.empty()) frame.rotation[i] = positive(m.q * part.q);
            if (!frame.velocity.empty()) frame.velocity[i] = free.velocity_at(Vec3(m.q * part.com));
            if (!frame.angular_velocity.empty()) frame.angular_velocity[i] = m.omega;
        }
    }
    for (std::size_t k = 0; k < world.walkers.size(); ++k) {
        const std::size_t i = bodies + world.balls + k;
        const WalkerPlace place = walker_place(world.walkers[k], frame.time);
        const auto at = [&](std::size_t body, const Vec3& point_b) {
            return Vec3(frame.position[body] + frame.rotation[body] * point_b);
        };
        if (!frame.position.empty())
            frame.position[i] = (1 - place.part) * at(place.body, place.point_b) +
                                place.part * at(place.next, place.next_b) + place.bow;
        if (!frame.velocity.empty()) frame.velocity[i] = walker_velocity(world.walkers[k], frame.time);
    }
    frame.events = world.events;
}

std::vector<Ball> shown_balls(const Tree& tree, const Scene& scene, const std::vector<Walk>& walkers) {
    std::vector<Ball> balls = scene.balls;
    if (walkers.empty()) return balls;
    const auto [R_wb, x_w] = drawn_pose(tree);
    for (const Walk& walk : walkers) {
        const WalkerPlace place = walker_place(walk, 0);
        balls.push_back({Vec3(x_w[place.body] + R_wb[place.body] * place.point_b), Vec3::Zero(), Vec3::Zero(),
                         walk.radius, walk.mass});
    }
    return balls;
}

#define BOUGH_INSTANTIATE(T) template void place_free_bodies(const World<T>&, MotionFrame&);
#include "../base/instantiate.inc"

} // namespace bough
