#include "merge_below.h"
#include "../stages/added_motion.h"
#include "../stages/hold.h"
#include "advance.h"
#include <algorithm>
#include <limits>
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

    // What holding these joints moves the tips by, if that stays within the error.
    std::optional<RigidError> run_held(const Tree& held) {
        const Reduced reduced = reduce(held, ranges_, how_.scene);
        if (reduced.tree.size_bodies() == 0) return std::nullopt;
        const Plan<double> plan = plan_of(reduced.tree, reduced.ranges, scene_on(reduced, tree_, how_.scene));
        State<double> state = make_state(plan);
        RigidComparison comparison(tree_);
        Tips now;
        for (const Tips& whole : tips_) {
            step(plan, state);
            comparison.tips_of(reduced, plan, state, now);
            if (!(comparison.compare(whole, now) <= how_.error) || first_non_finite(state)) return std::nullopt;
        }
        return comparison.result();
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

} // namespace

MergedBelow merge_below(Tree& tree, const std::vector<TreeRange>& ranges, const MergeBelow& how) {
    tree.rigid.clear();
    Trial trial(tree, ranges, how);
    const std::vector<double> motion = trial.run_whole();
    MergedBelow merged;
    merged.joints = tree.size_bodies();
    std::vector<std::uint8_t> best;
    // [m] Sums on the way to the ground, and how many joints each holds: one that is known to be good, one that is known not to be.
    double good = 0, bad = std::numeric_limits<double>::infinity(), sum = how.error;
    std::size_t most = 0, least_bad = tree.size_bodies() + 1;
    for (int tries = 0; merged.runs < how.runs && tries < 60; ++tries) {
        Tree held = tree;
        const std::size_t count = hold_small(held, motion, sum);
        if (count > most && count < least_bad) {
            ++merged.runs;
            if (const std::optional<RigidError> found = trial.run_held(held)) {
                merged.found = *found;
                best = std::move(held.rigid);
                most = count;
                good = sum;
            } else {
                least_bad = count;
                bad = sum;
            }
        } else {
            (count <= most ? good : bad) = sum;
        }
        if (most + 1 >= least_bad) break; // not a joint between them
        const bool top = !(bad < std::numeric_limits<double>::infinity());
        sum = top ? 2 * sum : good > 0 ? std::sqrt(good * bad) : bad / 2;
        if (good > 0 && bad < 1.02 * good) break;
    }
    tree.rigid = std::move(best);
    merged.moving = merged.joints - most;
    return merged;
}

} // namespace bough
