#include "stand.h"
#include "bark.h"
#include "carry.h"
#include "flexibility.h"
#include "segment.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

constexpr double weights = 2;       // times its own that a tree stands under
constexpr double slowest = 0.8;     // S / m of a branch on the trunk, over the tree's
constexpr double next_level = 0.5;  // and of one a level further out, over that
constexpr double least_own = 0.2;   // of the give of a branch's own joints that is left to it at a time
constexpr double beyond = 1.03;     // of the radius that would do
constexpr double raised = 7.0 / 6;  // a radius, where a branch does not stand
constexpr double most_raised = 1.5; // at a time
constexpr double hanging = 0.3;     // height of the load's centre below the base, over their distance
constexpr int most_times = 40;

Splines bare(const Splines& s) {
    Splines wood;
    wood.parent = s.parent;
    wood.parent_at = s.parent_at;
    wood.level = s.level;
    wood.first_point = s.first_point;
    wood.point = s.point;
    wood.radius = s.radius;
    return wood;
}

// Of a branch, or of a part of one that is a root.
struct Own {
    double mass = 0, give = 0, whole = 0; // of all that its first joint carries; of its own joints; of all
    bool stands = true, hangs = false, root = false;
};

class Standing {
public:
    Standing(const Splines& s, const Material& wood) : own_(s.branches()), level_(s.level), trunk_(s.branches(), -1) {
        tree_ = segment(bare(s), wood, {});
        pose_ = drawn_pose(tree_);
        mass_ = tree_.mass;
        const std::size_t n = tree_.size_bodies();
        first_.resize(n);
        on_.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            first_[i] = pose_.R_wb[i] * (tree_.mass[i] * tree_.com[i]);
            on_[i] = own_part(tree_, i, pose_.R_wb[i], 0);
        }
        hang(s, hung_items(s, wood));
        sweep();
        for (std::size_t b = 0; b < s.branches(); ++b)
            trunk_[b] = s.parent[b] < 0 ? std::int32_t(b) : trunk_[std::size_t(s.parent[b])];
    }
    bool stands(std::size_t b) const { return own_[b].stands; }
    // What the branch's radii are to be raised by.
    double factor(std::size_t b) const {
        const Own& own = own_[b];
        if (!own.stands) return raised;
        if (own.root || own.hangs || !(own.give > 0)) return 1;
        const Own& trunk = own_[std::size_t(trunk_[b])];
        const double limit = slowest * std::pow(next_level, level_[b] - 1) * trunk.whole / trunk.mass;
        if (own.whole <= limit * own.mass) return 1;
        const double room = std::max(limit * own.mass - (own.whole - own.give), least_own * own.give);
        return room < own.give ? std::min(std::pow(own.give / room, 0.25) * beyond, most_raised) : 1;
    }

private:
    void hang(const Splines&, const std::vector<HungItem>&);
    void sweep();

    std::vector<Own> own_;
    std::vector<std::int32_t> level_;
    std::vector<std::int32_t> trunk_; // of each branch
    Tree tree_;
    DrawnPose pose_;
    std::vector<double> mass_; // [kg] of all that a joint carries
    std::vector<Vec3> first_;  // [kg m] its first moment about the joint, world
    std::vector<Borne> on_;    // what its body and its children have together
};

// Bodies of a branch stand one after another.
void Standing::hang(const Splines& s, const std::vector<HungItem>& items) {
    std::vector<std::int32_t> begin(s.branches() + 1, 0);
    for (const std::int32_t b : tree_.branch) ++begin[std::size_t(b) + 1];
    for (std::size_t b = 0; b < s.branches(); ++b) begin[b + 1] += begin[b];
    for (const HungItem& item : items) {
        std::size_t b = std::size_t(item.branch);
        double at = item.at;
        while (begin[b] == begin[b + 1] && s.parent[b] >= 0) at = s.parent_at[b], b = std::size_t(s.parent[b]);
        if (begin[b] == begin[b + 1]) continue; // a root without length
        const auto from = tree_.s.begin() + begin[b], to = tree_.s.begin() + begin[b + 1];
        const auto i = std::size_t(std::upper_bound(from + 1, to, at) - tree_.s.begin()) - 1;
        mass_[i] += item.mass;
        const Vec3 moment = item.mass * (item.center - pose_.x_w[i]);
        first_[i] += moment;
        on_[i].a += cross_matrix(moment);
        on_[i].d += item.mass * Mat3::Identity();
    }
}

void Standing::sweep() {
    const std::size_t n = tree_.size_bodies();
    std::vector<double> give(n, 0.0);
    for (std::size_t i = n; i-- > 0;) {
        // Twice the weight on the wood is the weight on wood half as stiff.
        const bool root = tree_.parent[i] < 0;
        const auto p = std::size_t(root ? 0 : tree_.parent[i]);
        const Vec3 arm = root ? Vec3(Vec3::Zero()) : Vec3(pose_.x_w[i] - pose_.x_w[p]);
        const Yielding y = yielding(stiffness_w(tree_, i, pose_.R_wb[i]) / weights, first_[i], on_[i], arm);
        Own& own = own_[std::size_t(tree_.branch[i])];
        own.stands &= y.stands;
        own.give += y.give;
        give[i] += y.give;
        if (!continues_parent(tree_, i)) {
            own.mass = mass_[i];
            own.whole = give[i];
            own.hangs = first_[i].y() < -hanging * first_[i].norm();
            own.root = root;
        }
        if (root) continue;
        mass_[p] += mass_[i];
        give[p] += give[i];
        first_[p] += first_[i] + mass_[i] * arm;
        on_[p] += y.passed;
    }
}

} // namespace

std::size_t thicken_to_stand(Splines& s, const Material& wood, double most_sag) {
    for (int time = 0;; ++time) {
        const Standing standing(s, wood);
        const std::vector<double> drawn = s.radius;
        std::size_t raised_now = 0, falling = 0;
        for (std::size_t b = 0; b < s.branches(); ++b) {
            const double factor = standing.factor(b);
            if (factor == 1) continue;
            ++raised_now;
            falling += !standing.stands(b);
            for (auto k = std::size_t(s.first_point[b]); k < std::size_t(s.first_point[b + 1]); ++k)
                s.radius[k] *= factor;
        }
        if (raised_now == 0 || time == most_times) {
            s.radius = drawn;
            return falling;
        }
        seat_on_bark(s, drawn);
        thicken_to_carry(s, wood, most_sag);
    }
}

} // namespace bough
