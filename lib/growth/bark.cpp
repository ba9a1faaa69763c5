#include "bark.h"
#include <algorithm>

namespace bough {

namespace {

// Between point `index` and the next, `share` of the way.
struct PointOnBranch {
    std::size_t index;
    double share;
};

// Arc lengths of one branch, kept while its items are gone through.
class BranchArc {
public:
    explicit BranchArc(const Splines& s) : s_(s) {}
    // Where fraction `at` of a branch lies. O(points) for another branch than before, then O(log points).
    PointOnBranch find(std::int32_t branch, double at) {
        if (branch != branch_) measure(branch);
        const double length = at * arc_.back();
        const auto after = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, length);
        const auto k = std::size_t(after - arc_.begin()) - 1;
        const double step = arc_[k + 1] - arc_[k];
        return {first_ + k, step > 0 ? std::min(1.0, (length - arc_[k]) / step) : 1};
    }

private:
    void measure(std::int32_t branch) {
        branch_ = branch;
        first_ = static_cast<std::size_t>(s_.first_point[std::size_t(branch)]);
        const auto end = static_cast<std::size_t>(s_.first_point[std::size_t(branch) + 1]);
        arc_.assign(1, 0.0);
        for (std::size_t i = first_; i + 1 < end; ++i)
            arc_.push_back(arc_.back() + (s_.point[i + 1] - s_.point[i]).norm());
    }

    const Splines& s_;
    std::int32_t branch_ = -1;
    std::size_t first_ = 0;
    std::vector<double> arc_;
};

template <class T> T between(const std::vector<T>& values, const PointOnBranch& place) {
    return values[place.index] + place.share * (values[place.index + 1] - values[place.index]);
}

// How far an item at `position` moves so that it stands off the branch's axis as before, but from the grown radius.
Vec3 outward(const Splines& s, const std::vector<double>& drawn, const PointOnBranch& place, const Vec3& position) {
    const double growth = between(s.radius, place) - between(drawn, place);
    const Vec3 off = position - between(s.point, place);
    const double distance = off.norm();
    return growth > 0 && distance > 0 ? Vec3(growth / distance * off) : Vec3(Vec3::Zero());
}

} // namespace

double radius_at(const Splines& splines, std::int32_t branch, double at) {
    return between(splines.radius, BranchArc(splines).find(branch, at));
}

void seat_on_bark(Splines& s, const std::vector<double>& drawn) {
    BranchArc arc(s);
    for (std::size_t i = 0; i < s.leaves(); ++i)
        s.leaf_position[i] += outward(s, drawn, arc.find(s.leaf_branch[i], s.leaf_at[i]), s.leaf_position[i]);
    for (std::size_t i = 0; i < s.fruits(); ++i) {
        const Vec3 moved = outward(s, drawn, arc.find(s.fruit_branch[i], s.fruit_at[i]), s.fruit_position[i]);
        s.fruit_position[i] += moved;
        s.fruit_center[i] += moved;
    }
}

} // namespace bough
