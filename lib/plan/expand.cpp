#include "expand.h"

namespace bough {
namespace {

// The ground under a body that stands still, null where it rests.
template <class T>
const Ground* ground_under(const Reduced& r, const Plan<T>& plan, const State<T>& state, std::size_t body) {
    if (!plan.root_motion) return nullptr;
    std::size_t tree = 0;
    while (tree + 1 < r.whole.size() && body >= r.whole[tree + 1].first_body) ++tree;
    for (std::size_t k = 0; k < plan.scene.root_motion.size(); ++k) // a spline each, in order (make_plan)
        if (std::size_t(plan.scene.root_motion[k].tree) == tree) return &state.ground[k];
    return nullptr;
}

// From the last body down: a group's own values stand at or before each of its bodies.
template <class A, class Value> void expand(A& array, std::size_t bodies, Value&& value) {
    if (array.empty()) return;
    array.resize(bodies);
    for (std::size_t i = bodies; i-- > 0;) array[i] = value(i);
}

} // namespace

template <class T>
WholePose whole_pose(const Reduced& r, const Plan<T>& plan, const State<T>& state, std::size_t body) {
    const Mat3 R = r.rotation[body].toRotationMatrix();
    const std::int32_t g = r.body[body];
    if (g < 0) {
        const Ground* ground = ground_under(r, plan, state, body);
        if (!ground) return {R, r.offset[body]};
        return {ground->R * R, ground->x + ground->R * r.offset[body]};
    }
    const Mat3 R_g = state.R_wb[std::size_t(g)].template cast<double>();
    return {R_g * R, state.x_w[std::size_t(g)].template cast<double>() + R_g * r.offset[body]};
}

template <class T>
void expand_frame(const Reduced& r, const Tree& whole, const Plan<T>& plan, const State<T>& state, MotionFrame& frame) {
    const std::size_t n = r.body.size();
    const auto leads = [&](std::size_t i) {
        return r.body[i] >= 0 && r.leader[std::size_t(r.body[i])] == std::int32_t(i);
    };
    const auto of_leader = [&](auto& array, const auto& none) {
        using Value = std::decay_t<decltype(array[0])>;
        expand(array, n,
               [&](std::size_t i) -> Value { return leads(i) ? array[std::size_t(r.body[i])] : Value(none); });
    };
    // Before the positions, the rotations and the angular velocities that they are made with.
    expand(frame.velocity, n, [&](std::size_t i) -> Vec3 {
        const std::int32_t g = r.body[i];
        if (g < 0) {
            const Ground* ground = ground_under(r, plan, state, i);
            if (!ground) return Vec3::Zero();
            const Vec3 arm = ground->R * Vec3(r.offset[i] + r.rotation[i] * whole.com[i]);
            return ground->v + ground->omega.cross(arm);
        }
        const Vec3 v = frame.velocity[std::size_t(g)];
        if (leads(i) && plan.com[std::size_t(g)] == whole.com[i].template cast<T>()) return v;
        const Vec3 from = r.offset[i] + r.rotation[i] * whole.com[i] - plan.com[std::size_t(g)].template cast<double>();
        const Vec3 arm = state.R_wb[std::size_t(g)].template cast<double>() * from;
        return v + frame.angular_velocity[std::size_t(g)].cross(arm);
    });
    expand(frame.angular_velocity, n, [&](std::size_t i) -> Vec3 {
        if (r.body[i] >= 0) return frame.angular_velocity[std::size_t(r.body[i])];
        const Ground* ground = ground_under(r, plan, state, i);
        return ground ? ground->omega : Vec3(Vec3::Zero());
    });
    expand(frame.position, n, [&](std::size_t i) -> Vec3 {
        const std::int32_t g = r.body[i];
        if (g < 0) return whole_pose(r, plan, state, i).x;
        if (leads(i)) return frame.position[std::size_t(g)];
        return frame.position[std::size_t(g)] + frame.rotation[std::size_t(g)] * r.offset[i];
    });
    expand(frame.rotation, n, [&](std::size_t i) -> Quat {
        const std::int32_t g = r.body[i];
        if (g < 0) return positive(Quat(whole_pose(r, plan, state, i).R));
        if (leads(i)) return frame.rotation[std::size_t(g)];
        return positive(frame.rotation[std::size_t(g)] * r.rotation[i]);
    });
    of_leader(frame.torque, Vec3::Zero());
    of_leader(frame.theta, Vec3::Zero());
    of_leader(frame.theta_dot, Vec3::Zero());
    of_leader(frame.stress, 0);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template WholePose whole_pose(const Reduced&, const Plan<T>&, const State<T>&, std::size_t);                       \
    template void expand_frame(const Reduced&, const Tree&, const Plan<T>&, const State<T>&, MotionFrame&);
#include "../base/instantiate.inc"

} // namespace bough
