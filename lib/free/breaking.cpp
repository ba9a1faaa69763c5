#include "breaking.h"
#include <algorithm>

namespace bough {
namespace {

// A body that leaves in the step in which it was met was no part of its tree any more: the impulse, which was the tree's to answer, is taken
// back, and the two free bodies meet as such. first: of the new pieces.
template <class T>
void meet_pieces(State<T>& state, World<T>& world, const std::vector<ContactPoint>& points, std::size_t first) {
    std::erase_if(state.loads, [&](const Load<T>& load) { return world.remaining.gone[load.body] != 0; });
    const auto holds = [](const FreeBody& piece, std::int64_t body) {
        return std::any_of(piece.parts.begin(), piece.parts.end(),
                           [body](const FreePart& part) { return part.body == body; });
    };
    for (const ContactPoint& c : points) {
        if (c.body < 0 || !world.remaining.gone[std::size_t(c.body)]) continue;
        FreeBody& free = world.free[c.free];
        const auto piece = std::find_if(world.free.begin() + std::ptrdiff_t(first), world.free.end(),
                                        [&](const FreeBody& p) { return holds(p, c.body); });
        push(free, c.arm, Vec3(-c.impulse));
        const Vec3 arm = c.point - piece->motion.x;
        const double approach = -c.normal.dot(Vec3(free.velocity_at(c.arm) - piece->velocity_at(arm)));
        if (!(approach > 0)) continue;
        const Mat3 W = mobility_of(free, c.arm) + mobility_of(*piece, arm);
        const Vec3 impulse = (1 + world.contact.restitution) * approach / c.normal.dot(W * c.normal) * c.normal;
        push(free, c.arm, impulse);
        push(*piece, arm, Vec3(-impulse));
    }
}

} // namespace

template <class T>
void break_joints(Plan<T>& plan, State<T>& state, World<T>& world, const std::vector<ContactPoint>& points) {
    std::vector<std::uint32_t> joints;
    std::erase_if(world.breakable, [&](const Breakable& joint) {
        const std::size_t i = joint.body;
        if (world.remaining.gone[i]) return true;
        // T^T makes a torque longer by up to half of pi.
        const Vec3 theta = world.poses.theta(i), rate = world.poses.theta_dot(i);
        const Vec3 K = plan.K[i].template cast<double>();
        const double beta = double(plan.beta[i]);
        if (!(1.6 * K.cwiseProduct(Vec3(theta + beta * rate)).norm() > joint.torque)) return false;
        const double torque = spring_torque(theta, rate, K, beta);
        if (!(torque > joint.torque)) return false;
        joints.push_back(joint.body);
        ++world.counts.broke[std::size_t(world.tree->kind[i])];
        world.events.add("broke", std::int64_t(i), -1, torque);
        return true;
    });
    if (joints.empty()) return;
    for (FreeBody& piece : pieces_of(plan, *world.tree, world.subtrees, world.poses, joints))
        world.free.push_back(std::move(piece));
    detach(plan, state, world.subtrees, joints, world.remaining);
    meet_pieces(state, world, points, world.free.size() - joints.size());
    world.broken.insert(world.broken.end(), joints.begin(), joints.end());
    if (!plan.contact) return;
    std::vector<std::size_t> path; // all that carried something that left, each once
    for (const std::uint32_t joint : joints)
        for (std::int64_t i = plan.parent[joint]; i >= 0 && !world.remaining.gone[std::size_t(i)];
             i = plan.parent[std::size_t(i)])
            path.push_back(std::size_t(i));
    std::sort(path.rbegin(), path.rend());
    path.erase(std::unique(path.begin(), path.end()), path.end());
    world.response.remake(plan, world.subtrees, path);
    world.rigid.remake(plan, world.subtrees, path);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void break_joints(Plan<T>&, State<T>&, World<T>&, const std::vector<ContactPoint>&);
#include "../base/instantiate.inc"

} // namespace bough
