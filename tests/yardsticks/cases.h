// cases.h: trees, scenes and random motions on which accelerations are compared, and the measure of the difference.
#pragma once
#include "loads.h"
#include "tests/paper_trees.h"
#include <string>

namespace yardstick {

struct Case {
    std::string name;
    Tree tree;
    bough::Scene scene;
    std::vector<Target> targets; // of the scene's pulls
    double time = 0;             // [s] of wind and pulls
    Motion motion;
};

// Each tree under gravity, springs and dampers, oblique gusty wind and two pulls, in a random motion (angles up to 1 rad,
// rates up to 5 rad/s); as they are, and with springs 1e-6 times as stiff, so that gravity, wind and the velocities' own
// terms are of the springs' size and an error in them shows. Trees: the chain and the branched tree of paper_trees.h (E =
// 2e9), make_tree's branched tree, its random trees of 100 and 300 bodies, and two trees in one world.
std::vector<Case> acceleration_cases();

// The largest over the joints of |a - b| relative to |b|, or to the 1e-3 part of the root mean square of |b| over the
// joints where that is more: joint by joint, as the joints of twigs accelerate 1e4 times as fast as the trunk's; the floor
// is for the joint whose acceleration happens to pass through zero.
struct Difference {
    double largest = 0;
    std::size_t joint = 0;
};
Difference difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b);

// Accelerations of a case by an engine.
std::vector<Vec3> accelerations(Engine&, const Case&);

} // namespace yardstick
