#include "world.h"
#include <stdexcept>

namespace bough {

template <class T> World<T> make_world(const Plan<T>& plan, const Tree& tree, const std::vector<TreeRange>& ranges) {
    World<T> world;
    const Scene& scene = plan.scene;
    if (!has_free_bodies(scene)) return world;
    world.tree = &tree;
    world.contact = scene.contact.value_or(Contact());
    world.balls = scene.balls.size();
    for (const Ball& ball : scene.balls) world.free.push_back(free_ball(ball, scene.air_density));
    if (scene.fracture) {
        world.breakable = breakable_joints(tree, ranges, *scene.fracture);
        world.remaining = whole_tree(plan, tree);
    }
    if (scene.fracture && !scene.walkers.empty())
        throw std::domain_error("walkers: not with /fracture, which may break off what they walk on");
    for (std::size_t k = 0; k < scene.walkers.size(); ++k)
        world.walkers.push_back(
            make_walk(tree, ranges, scene.walkers[k], scene.gravity, "/walkers/" + std::to_string(k)));
    if (scene.fracture || plan.contact) world.subtrees = make_subtrees(tree, plan.contact);
    if (plan.contact) {
        world.response.make(plan, tree, world.subtrees);
        world.rigid.make(plan, tree, world.subtrees, false);
    }
    if (plan.wind) world.wind = make_wind_table<double>(*scene.wind, plan.top, plan.reach);
    return world;
}

template <class T> std::size_t World<T>::bytes() const {
    std::size_t parts = 0;
    for (const FreeBody& body : free) parts += body.parts.capacity() * sizeof(FreePart);
    return free.capacity() * sizeof(FreeBody) + parts + breakable.capacity() * sizeof(Breakable) +
           remaining.gone.capacity() + remaining.c_mass.capacity() * sizeof(double) +
           remaining.moment.capacity() * sizeof(Vec3) + response.bytes() + rigid.bytes() +
           sizeof(std::uint32_t) * (subtrees.first_child.capacity() + subtrees.child.capacity()) +
           sizeof(float) * subtrees.reach.capacity() + near.bytes();
}

template <class T> std::optional<std::size_t> first_non_finite(const World<T>& world) {
    for (std::size_t k = 0; k < world.free.size(); ++k) {
        const FreeMotion& m = world.free[k].motion;
        if (!(m.x.allFinite() && m.v.allFinite() && m.omega.allFinite() && m.q.coeffs().allFinite())) return k;
    }
    return std::nullopt;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template struct World<T>;                                                                                          \
    template World<T> make_world(const Plan<T>&, const Tree&, const std::vector<TreeRange>&);                          \
    template std::optional<std::size_t> first_non_finite(const World<T>&);
#include "../base/instantiate.inc"

} // namespace bough
