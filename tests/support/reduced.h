// reduced.h: what tests of trees with rigid bodies share: the tree without them, its plan.
#pragma once
#include "lib/plan/reduce.h"
#include "lib/study/solvers.h"

namespace reduced {

using namespace bough;

inline std::vector<TreeRange> all_of(const Tree& tree) {
    return {{0, tree.size_bodies(), 0}};
}

inline Reduced reduced_of(const Tree& tree, const Scene& scene = {}) {
    return reduce(tree, all_of(tree), scene);
}

template <class T = double>
Plan<T> plan_of(const Tree& tree, const std::vector<TreeRange>& ranges, const Scene& scene, double dt = 1.0 / 60,
                const Wishes& wishes = {true, false, true}) {
    return make_plan<T>(tree, ranges, scene, wishes, dt, Solver::coupled);
}

} // namespace reduced
