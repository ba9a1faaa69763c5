// body_air.h: what every solver, guard and reference asks about the air at a body: what the laws take of the body (laws/air_load.h), and
// the wind there, with its shelter and its tree's clock. WindTable::at (laws/wind.h) and wind_factor (wind_weather.h) hold what else a wind does at a
// place.
#pragma once
#include "../laws/air.h"
#include "../laws/leaf_air.h"
#include "../laws/wind.h"
#include "plan.h"
#include "reduced.h"

namespace bough {

// Returns Tree::leaf_facing of a clump, and 0 for other bodies.
template <class T> T facing_of(const Plan<T>& plan, std::size_t body) {
    return plan.facing.empty() ? T(0) : plan.facing[body];
}

// Returns the body as the air's laws take it, in a run's precision or another.
template <class Real, class T> AirBody<Real> air_body(const Plan<T>& plan, std::size_t body) {
    return {plan.kind[body], Real(plan.drag_area[body]), Real(plan.mass[body]), plan.com[body].template cast<Real>(),
            Real(facing_of(plan, body))};
}

// The same of a tree that no plan has been made of.
inline AirBody<double> air_body(const Tree& tree, std::size_t body, const Scene& scene) {
    const Kind kind = kind_in_air(tree, body);
    return {kind, drag_area(tree, body, kind, scene.air_density, plate_kappa(scene)), tree.mass[body], tree.com[body],
            facing_in_air(tree, body)};
}

// Returns the wind's clock that a body's tree goes by.
template <class T> std::size_t clock_of(const Plan<T>& plan, std::size_t body) {
    return plan.clock.empty() ? 0 : plan.clock[body];
}

// Returns the wind's velocity [m/s] at a body whose centre of mass is at `place` [m].
template <class T, class Real>
Vector3<Real> wind_on_body_at(const Plan<T>& plan, std::size_t body, const WindTable<Real>& wind,
                              const Vector3<Real>& place) {
    const Vector3<Real> undisturbed = wind.at(place, clock_of(plan, body));
    return plan.shelter.empty() ? undisturbed : Vector3<Real>(Real(plan.shelter[body]) * undisturbed);
}

// Returns the change of that velocity over a step, for a wind over the ground whose fields at the step's start and end are given.
template <class T>
Vector3<T> wind_change_on_body_at(const Plan<T>& plan, std::size_t body, const WindTable<T>& wind,
                                  const WindField<T>& start, const WindField<T>& end, const Vector3<T>& place) {
    const std::size_t clock = clock_of(plan, body);
    const Vector3<T> change = end.at(place.x(), place.z(), clock) - start.at(place.x(), place.z(), clock);
    const Vector3<T> undisturbed = wind.factor(place) * change;
    return plan.shelter.empty() ? undisturbed : Vector3<T>(T(plan.shelter[body]) * undisturbed);
}

} // namespace bough
