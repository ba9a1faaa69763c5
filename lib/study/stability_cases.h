// stability_cases.h: the grid of extremes: what each case makes of a tree and its scene, and whether bough promises it.
//
// All start from the tree unloaded (pose rest) with gravity switched on, as the scene has it, and its wind taken away; a case
// then changes one thing, or two where they make one another worse. A few bring trees of their own.
// Promised (the analytic solver, float and double): stiffness x 1e-3 to 1e6, beta 0 to 1 s, dt 1/240 to 1/10 s, wind to 50 m/s, gusts and storm,
// mass ratios to 1e6, chains to 1e5 deep, degenerate pieces, fracture and balls of any threshold, number, mass and speed here; beyond that the cases
// are run to say where it ends.
#pragma once
#include "../lanes/target.h"
#include "../model/scene.h"
#include "../model/tree.h"
#include <functional>
#include <string>
#include <vector>

namespace bough {

struct StabilitySetup {
    Tree tree;
    std::vector<TreeRange> ranges;
    Scene scene;
    double dt = 1.0 / 30;                            // [s]
    std::optional<fast::Target> simd = std::nullopt; // the fast path, for what it holds; none: the plain path
};

struct StabilityCase {
    std::string group, name;
    bool promised = false;
    std::function<void(StabilitySetup&)> apply;
    bool compared = false; // with the truth (stability_motion.h): wind on the user's tree
};

std::vector<StabilityCase> stability_cases();

} // namespace bough
