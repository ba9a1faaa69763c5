// scaling.h: the measurement of `treeprofile scaling`: every tree with every way of stepping and every number of threads, round after round, so that
// what else the machine does meets all alike; what the machine can do at most, in each round; what is computed and moved, counted once.
#pragma once
#include "common.h"
#include "formats/reports/scaling_report.h"
#include "simulation.h"
#include <functional>

namespace bough {

struct ScalingTree {
    std::string shape; // "bushy", or the file's name
    Setting setting;
};

// bushy: an apple tree, willow: a willow, both bare, as `treegen --species NAME --bodies N --seed 1 | treeconvert -` makes them, or, of more bodies
// than the whole tree has, as many whole trees side by side as come to that; chain: a straight upright pole of 20 m and 0.2 m radius, cut into
// `bodies` pieces. Throws UsageError for a number that cannot be grown.
Tree scaling_tree(const std::string& shape, std::int64_t bodies);

struct ScalingChoice {
    std::vector<RunOptions> ways; // solver, precision, simd
    std::vector<int> threads;
    std::int64_t frames = 0; // measured; 0: by the tree's size, scaling_frames
    int repeat = 5;
    std::size_t array = 0; // [bytes] for the memory's bandwidth
};

// Enough for a time that a clock tells well: 4 million bodies' steps, at least 4 and at most 240.
std::int64_t scaling_frames(std::int64_t bodies);

// tick(done, total) before each run; may throw to end. Throws what plan_run throws; PromiseError for a state that became non-finite, and where two
// runs of the same, or of other threads, give another hash.
ScalingReport measure_scaling(const std::vector<ScalingTree>&, const ScalingChoice&,
                              const std::function<void(std::int64_t, std::int64_t)>& tick);

} // namespace bough
