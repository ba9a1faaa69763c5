// cases.h: trees, scenes and random motions on which accelerations are compared, and the measure of the difference.
#pragma once
#include "loads.h"
#include "tests/support/paper_trees.h"
#include <string>

namespace yardstick {

struct Case {
    std::string name;
    Tree tree;
    bough::Scene scene;
    std::vector<Target> targets; // of the scene's pulls
    double time = 0;             // [s] of wind and pulls
    Motion motion;
    double joint_limit, kinetic_limit; // Difference from the truth that a solver in doubles is allowed
};

// Each tree under gravity, springs and dampers, oblique gusty wind and two pulls, in a random motion (angles up to 1 rad,
// rates up to 5 rad/s); as they are, and with springs 1e-6 times as stiff, so that gravity, wind and the velocities' own
// terms are of the springs' size and an error in them shows. Trees: the chain and the branched tree of paper_trees.h (E =
// 2e9), make_tree's branched tree, it and a chain in one world, a grown tree of about 300 bodies with leaves and fruit, and
// make_tree's random trees of 100 and 300. Allowed are 1e-9 or less of the kinetic norm, but for the last: fruit on twigs of
// a millionth of their mass take ten digits and more from every double-precision solver, the engines' too (MuJoCo 1e-6,
// Simbody 6e-5), though the data determine the motion to 1e-12. It is there so that a solver which fails altogether shows.
std::vector<Case> acceleration_cases();

// How far accelerations a are from the truth, by two scales that leave out neither twig nor trunk.
//   joint    the largest over the joints of |a - truth| relative to |truth| of the same joint, or to 1e-3 of its root mean
//            square over the joints where that is more (for the joint whose acceleration passes through zero)
//   kinetic  the norm that kinetic energy gives: the sum over the bodies of m |dx|^2 + dw I dw, dx, dw the differences of
//            acceleration and angular acceleration of the body in the world; relative to the same sum of the truth itself
struct Difference {
    double joint = 0, kinetic = 0;
    std::size_t worst_joint = 0;
};
Difference difference(const Case&, const std::vector<Vec3>& a, const std::vector<Vec3>& truth);

// Accelerations of a case by an engine.
std::vector<Vec3> accelerations(Engine&, const Case&);

} // namespace yardstick
