#include "carried.h"
#include "../laws/air.h"
#include "../laws/leaf_air.h"
#include "reduced.h"

namespace bough {

template <class T> void plan_surfaces(Plan<T>& plan, const Tree& tree) {
    plan.kind.reserve(plan.bodies);
    plan.drag_area.reserve(plan.bodies);
    const Scene& scene = plan.scene;
    for (std::size_t i = 0; i < plan.bodies; ++i) {
        plan.kind.push_back(kind_in_air(tree, i));
        plan.drag_area.push_back(T(drag_area(tree, i, plan.kind[i], scene.air_density, plate_kappa(scene))));
    }
    for (std::size_t i = 0; i < tree.leaf_facing.size(); ++i) {
        if (!(facing_in_air(tree, i) > 0)) continue;
        if (plan.facing.empty()) plan.facing.assign(plan.bodies, T(0));
        plan.facing[i] = T(facing_in_air(tree, i));
    }
}

template <class T> std::vector<Vec3> carried_moments(const Plan<T>& plan, const Tree& tree) {
    std::vector<Vec3> P(plan.bodies);
    for (std::size_t i = 0; i < plan.bodies; ++i) P[i] = tree.mass[i] * tree.com[i];
    for (std::size_t i = 0; i < plan.bodies; ++i)
        if (tree.parent[i] >= 0) P[std::size_t(tree.parent[i])] += double(plan.c_mass[i]) * tree.joint_position[i];
    return P;
}

template <class T> std::vector<Vec3> carried_drag(const Plan<T>& plan, const Tree& tree) {
    std::vector<double> drag(plan.bodies); // [kg/m] of all outboard, its own included
    std::vector<Vec3> P(plan.bodies);
    for (std::size_t i = plan.bodies; i-- > 0;) {
        const Kind kind = kind_in_air(tree, i);
        const double all_ways =
            facing_of(kind, facing_in_air(tree, i)).all_ways; // of a clump all that a level wind finds
        drag[i] += double(plan.drag_area[i]) * (is_flat(kind) ? blade_mean : all_ways);
        P[i] = double(plan.drag_area[i]) * all_ways * tree.com[i];
        if (tree.parent[i] >= 0) drag[std::size_t(tree.parent[i])] += drag[i];
    }
    for (std::size_t i = 0; i < plan.bodies; ++i)
        if (tree.parent[i] >= 0) P[std::size_t(tree.parent[i])] += drag[i] * tree.joint_position[i];
    return P;
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template void plan_surfaces(Plan<T>&, const Tree&);                                                                \
    template std::vector<Vec3> carried_moments(const Plan<T>&, const Tree&);                                           \
    template std::vector<Vec3> carried_drag(const Plan<T>&, const Tree&);
#include "../base/instantiate.inc"

} // namespace bough
