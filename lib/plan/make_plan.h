// make_plan.h: a plan of a tree in a scene.
#pragma once
#include "plan.h"
#include <memory>

namespace bough {

// [m] top: the highest point that a body of the tree could ever reach by standing straight up. reach: the farthest over the ground from (x, z). The
// wind's tables cover both. O(n).
struct WindReach {
    double top, reach;
};
WindReach wind_reach(const Tree&, const std::vector<TreeRange>&, const Scene&);

// Makes the plan. tree: joined and checked. ranges: of each of the scene's trees in it (one range for a tree on its own). Scales K and beta by the
// scene's factors, and finds the rest pose (pose.h), composite masses and weights (branch_mode.h). O(n). Throws std::out_of_range for a selector that
// names no body. Throws std::domain_error for a pose that gravity does not allow, for one that starts beyond a joint limit (with its body and angle),
// for what the stepper cannot hold (Stepper::refuse), for a swirl finer than a table can hold (wind_field.h), for columns of shelter that a body
// fills (shelter.h), for a scene that still has /wood, /load or /simulate, which must be in the tree before (wood_overrides.h, static_load.h,
// hold.h), and for rigid bodies not yet joined (reduce.h).
// Memory: a tree that is handed over (Tree&&) frees each array as soon as the plan has what it needs of it, so that the two never exist whole side by
// side. Branch numbers, name, material, source and colours stay.
template <class T>
Plan<T> make_plan(const Tree& tree, const std::vector<TreeRange>& ranges, const Scene&, const Wishes&, double dt,
                  std::unique_ptr<Stepper<T>>);
template <class T>
Plan<T> make_plan(Tree&& tree, const std::vector<TreeRange>& ranges, const Scene&, const Wishes&, double dt,
                  std::unique_ptr<Stepper<T>>);

} // namespace bough
