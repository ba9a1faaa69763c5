#include "merge_below.h"
#include "../laws/added_motion.h"
#include "../plan/hold.h"
#include "solvers.h"
#include "trajectory.h"
#include <algorithm>
#include <stdexcept>

namespace bough {
namespace {

using Tips = std::vector<Vector3<float>>;

class Trial {
public:
    Trial(const Tree& tree, const std::vector<TreeRange>& ranges, const MergeBelow& how)
        : tree_(tree), ranges_(ranges), how_(how), frames_(std::int64_t(std::round(how.seconds * how.fps))),
          places_(tree) {}

    // [m] What each joint's turning moves.
    std::vector<double> run_whole() {
        const Plan<double> plan = plan_of(tree_, ranges_, how_.scene);
        State<double> state = make_state(plan);
        const std::vector<Vec3> start = state.theta;
        std::vector<double> motion(tree_.size_bodies(), 0);
        for (std::int64_t f = 1; f <= frames_; ++f) {
            step(plan, state);
            if (first_non_finite(state)) throw std::domain_error("the trial run became non-finite");
            for (std::size_t i = 0; i < motion.size(); ++i)
                motion[i] = std::max(motion[i], (state.theta[i] - start[i]).norm());
            places_.tips_of(state, tips_.emplace_back());
        }
        const std::vector<double> reach = composite_reach(tree_);
        for (std::size_t i = 0; i < motion.size(); ++i) motion[i] *= reach[i];
        return motion;
    }

    // Holds these joints, for a whole run; false where nothing is left to move, or the run became non-finite.
    bool run_held(const Tree& held, RigidComparison& comparison) {
        const Reduced reduced = reduce(held, ranges_, how_.scene);
        if (reduced.tree.size_bodies() == 0) return false;
        const Plan<double> plan = plan_of(reduced.tree, reduced.ranges, scene_on(reduced, tree_, how_.scene));
        State<double> state = make_state(plan);
        Tips now;
        for (const Tips& whole : tips_) {
            step(plan, state);
            if (first_non_finite(state)) return false;
            comparison.tips_of(reduced, plan, state, now);
            comparison.compare(whole, now);
        }
        return true;
    }

private:
    Plan<double> plan_of(const Tree& tree, const std::vector<TreeRange>& ranges, const Scene& scene) const {
        return make_plan<double>(tree, ranges, scene, {}, 1 / how_.fps, Solver::coupled, Scheme::p12, how_.simd);
    }
    void step(const Plan<double>& plan, State<double>& state) {
        advance(plan, state);
        present(plan, state);
        if (how_.tick) how_.tick(++done_, frames_ * (how_.runs + 1));
    }

    const Tree& tree_;
    const std::vector<TreeRange>& ranges_;
    const MergeBelow& how_;
    std::int64_t frames_, done_ = 0;
    RigidComparison places_;
    std::vector<Tips> tips_; // of the whole tree, a frame after another
};

// What the joints on the ways of tips that are off by too much, or nearly, move by counts for more; where a tip is so again, it is for joints
// beside its way, of twice as many bodies further in each time.
void weigh(const Tree& tree, const RigidComparison& comparison, double error, std::vector<std::uint8_t>& again,
           std::vector<double>& motion) {
    std::vector<double> inward(tree.size_bodies(), 1), outward(tree.size_bodies(), 1);
    for (std::size_t k = 0; k < comparison.tips().size(); ++k) {
        const double off = std::sqrt(comparison.worst_of_tips()[k]) / error;
        if (!(off > 0.9)) continue;
        std::size_t base = comparison.tips()[k];
        inward[base] = 2 * off;
        for (int climb = again[k] > 0 ? 1 << again[k] : 0; climb > 0 && tree.parent[base] >= 0; --climb)
            base = std::size_t(tree.parent[base]);
        outward[base] = std::max(outward[base], again[k] > 0 ? 2 * off : 1);
        again[k] = std::uint8_t(std::min(again[k] + 1, 12));
    }
    for (std::size_t i = inward.size(); i-- > 0;)
        if (tree.parent[i] >= 0) {
            double& below = inward[std::size_t(tree.parent[i])];
            below = std::max(below, inward[i]);
        }
    for (std::size_t i = 0; i < outward.size(); ++i) {
        if (tree.parent[i] >= 0) outward[i] = std::max(outward[i], outward[std::size_t(tree.parent[i])]);
        motion[i] *= std::max(inward[i], outward[i]);
    }
}

} // namespace

MergedBelow merge_below(Tree& tree, const std::vector<TreeRange>& ranges, const MergeBelow& how) {
    tree.rigid.clear();
    Trial trial(tree, ranges, how);
    std::vector<double> motion = trial.run_whole();
    MergedBelow merged;
    merged.joints = tree.size_bodies();
    std::vector<std::uint8_t> best;
    std::size_t most = 0;
    std::vector<std::uint8_t> again(tip_bodies(tree).size(), 0); // how often each tip was off by too much
    double sum = 2 * how.error;                                  // [m] on the way to the ground
    for (int tries = 0; merged.runs < how.runs && tries < 10 * how.runs; ++tries) {
        Tree held = tree;
        const std::size_t count = hold_small(held, motion, sum);
        if (count <= most) { // nothing to win by a run
            sum *= 1.5;
            continue;
        }
        RigidComparison comparison(tree);
        ++merged.runs;
        if (!trial.run_held(held, comparison)) {
            sum /= 2;
            continue;
        }
        const RigidError found = comparison.result();
        if (found.worst <= how.error) {
            merged.found = found;
            best = std::move(held.rigid);
            most = count;
            sum *= 1.5;
        } else {
            weigh(tree, comparison, how.error, again, motion);
        }
    }
    tree.rigid = std::move(best);
    merged.moving = merged.joints - most;
    return merged;
}

} // namespace bough
