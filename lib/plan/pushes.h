// pushes.h: forces on single points of bodies: the scene's pulls and the loads of a step.
#pragma once
#include "plan.h"
#include "state.h"

namespace bough {

// Calls visit(body, point [m, body frame], force [N, world]) for every pull at `time` [s] and every load of the step to come.
template <class T, class Visit>
void visit_pushes(const Plan<T>& plan, const State<T>& state, double time, Visit&& visit);

// [N] Returns the force of a pull at time t [s]: linear between its keys, zero outside of them.
Vec3 pull_force(const Pull&, double t);

template <class T, class Visit>
void visit_pushes(const Plan<T>& plan, const State<T>& state, double time, Visit&& visit) {
    for (const PlannedPull<T>& pull : plan.pulls)
        visit(pull.body, pull.point_b, Vector3<T>(pull_force(plan.scene.pulls[pull.source], time).template cast<T>()));
    for (const Load<T>& load : state.loads) visit(load.body, load.point_b, load.force);
}

} // namespace bough
