#include "stability_motion.h"
#include "../laws/wind_field.h"
#include "../model/drawn_pose.h"
#include "trajectory.h"
#include <algorithm>

namespace bough {
namespace {

constexpr double truth_steps = 64; // a frame
constexpr double share = 0.25, of_height = 1e-4;

double height_of(const Tree& tree) {
    const DrawnPose drawn = drawn_pose(tree);
    double low = INFINITY, high = -INFINITY;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        low = std::min(low, drawn.x_w[i].y());
        high = std::max(high, drawn.x_w[i].y() + std::max(0.0, drawn.R_wb[i](1, 2)) * tree.size[i][0]);
    }
    return high - low;
}

} // namespace

std::optional<MotionTruth> motion_truth(const StabilitySetup& setup, std::int64_t frames,
                                        const std::function<void()>& tick) {
    if (!setup.scene.wind || !trunk_top(setup.tree)) return std::nullopt;
    const Problem problem{setup.tree, setup.ranges, setup.scene, 1 / setup.dt, frames + 1, setup.simd};
    const Variant fine{.solver = Solver::coupled, .steps_per_frame = truth_steps};
    const Trajectory run = run_trajectory(problem, fine, true, 1, tick);
    if (!run.finite) return std::nullopt;
    return MotionTruth{run.motion, height_of(setup.tree), !steady(*setup.scene.wind)};
}

std::string judge_motion(const MotionSummary& run, const MotionTruth& truth, StabilityCell& cell) {
    std::string text;
    const auto compare = [&](const char* what, double is, double should, double& error) {
        error = is / should - 1;
        if (std::abs(is - should) <= std::max(share * should, of_height * truth.height)) return;
        char line[80];
        std::snprintf(line, sizeof line, "trunk's %s %.3g m, truth %.3g", what, is, should);
        text += (text.empty() ? "" : "; ") + std::string(line);
    };
    compare("mean lean", run.top.lean, truth.motion.top.lean, cell.lean_error);
    compare("std", run.top.spread, truth.motion.top.spread, cell.spread_error);
    cell.still = run.still;
    if (truth.unsteady && run.still > 0 && truth.motion.still == 0)
        text += (text.empty() ? "" : "; ") + std::to_string(run.still) + " still frames";
    cell.compared = true;
    cell.moves = text.empty();
    return text;
}

} // namespace bough
