// held_joints.h: a tree of which joints are held, run beside the whole one.
#pragma once
#include "lib/lanes/target.h"
#include "lib/study/rigid_error.h"
#include "lib/study/solvers.h"
#include "tests/support/reduced.h"

namespace held_joints {

using namespace bough;
using reduced::all_of;

// RMS and worst distance of tips between the whole tree and what is held of it.
inline RigidError run_both(const Tree& held, const Scene& scene, int frames) {
    Tree whole = held;
    whole.rigid.clear();
    const Reduced r = reduce(held, all_of(held), scene);
    const double dt = 1.0 / 60;
    const Plan<double> whole_plan =
        make_plan<double>(whole, all_of(whole), scene, {}, dt, Solver::coupled, Scheme::p12, fast::best_target());
    const Plan<double> plan = make_plan<double>(r.tree, r.ranges, scene_on(r, held, scene), {}, dt, Solver::coupled);
    State<double> there = make_state(whole_plan), here = make_state(plan);
    RigidComparison comparison(whole);
    std::vector<Vector3<float>> a, b;
    for (int k = 0; k < frames; ++k) {
        advance(whole_plan, there);
        present(whole_plan, there);
        advance(plan, here);
        comparison.tips_of(there, a);
        comparison.tips_of(r, plan, here, b);
        comparison.compare(a, b);
    }
    return comparison.result();
}

} // namespace held_joints
