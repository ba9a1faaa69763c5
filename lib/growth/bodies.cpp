#include "bodies.h"
#include "leaf_count.h"
#include <algorithm>
#include <limits>
#include <numbers>

namespace bough {

using std::numbers::pi;

namespace {

class Builder {
public:
    Builder(const Splines& splines, const Curves& curves, const CutRule& rule);
    void add_curve(std::size_t c);
    void add_leaf(std::size_t k, const Material&);
    void add_fruit(std::size_t k);
    void count_leaves();
    Tree finish();

private:
    std::int32_t piece_at(const CurvePlace& place) const;
    const Quat& frame_of(std::int32_t piece) const { return piece < 0 ? ground_ : turned_[std::size_t(piece)]; }
    void add(Kind, std::int32_t parent, const Vec3& joint, const Quat& frame, const Vec3& size, std::int32_t branch,
             double s);

    const Splines& splines_;
    const Curves& curves_;
    std::size_t next_ = 0;
    Tree tree_;
    std::vector<Vec3> joint_w_;          // [m] per body
    std::vector<Quat> turned_;           // world from body
    std::vector<double> cut_;            // of all curves, each with both ends
    std::vector<std::size_t> first_cut_; // per curve, and one more
    const Quat ground_{Eigen::AngleAxisd(-pi / 2, Vec3::UnitX())};
};

Builder::Builder(const Splines& splines, const Curves& curves, const CutRule& rule)
    : splines_(splines), curves_(curves) {
    std::vector<double> cuts;
    first_cut_.push_back(0);
    for (std::size_t c = 0; c < curves.size(); ++c) {
        cut_curve(curves, c, rule, std::numeric_limits<std::int32_t>::max(), cuts);
        cut_.insert(cut_.end(), cuts.begin(), cuts.end());
        first_cut_.push_back(cut_.size());
    }
    const std::size_t bodies = cut_.size() - curves.size() + splines.leaves() + splines.fruits();
    tree_.resize(bodies);
    joint_w_.resize(bodies);
    turned_.resize(bodies);
}

// Curve c has one cut more than pieces, so its first piece is c before its first cut.
std::int32_t Builder::piece_at(const CurvePlace& place) const {
    if (place.curve < 0) return -1;
    const auto c = std::size_t(place.curve);
    const double length = curves_.length(c);
    const auto begin = cut_.begin() + std::ptrdiff_t(first_cut_[c]),
               end = cut_.begin() + std::ptrdiff_t(first_cut_[c + 1]);
    const double s = place.at * length + 1e-12 * length;
    const auto after = std::upper_bound(begin + 1, end - 1, s);
    return std::int32_t(after - 1 - cut_.begin()) - place.curve;
}

void Builder::add(Kind kind, std::int32_t parent, const Vec3& joint, const Quat& frame, const Vec3& size,
                  std::int32_t branch, double s) {
    const std::size_t i = next_++;
    const Quat near = parent < 0 ? Quat::Identity() : turned_[std::size_t(parent)].conjugate();
    const Vec3 origin = parent < 0 ? Vec3::Zero() : joint_w_[std::size_t(parent)];
    joint_w_[i] = joint;
    turned_[i] = frame;
    tree_.parent[i] = parent;
    tree_.kind[i] = kind;
    tree_.joint_position[i] = near * Vec3(joint - origin);
    tree_.joint_rotation[i] = (near * frame).normalized();
    tree_.size[i] = size;
    tree_.branch[i] = branch;
    tree_.level[i] = splines_.level[std::size_t(branch)];
    tree_.s[i] = s;
}

void Builder::add_curve(std::size_t c) {
    const double length = curves_.length(c);
    std::int32_t parent = piece_at(curves_.parent[c]);
    Vec3 from = curves_.point[std::size_t(curves_.first[c])];
    double radius = curves_.radius[std::size_t(curves_.first[c])];
    for (std::size_t k = first_cut_[c]; k + 1 < first_cut_[c + 1]; ++k) {
        const Vec3 to = curves_.position_at(c, cut_[k + 1]);
        const double radius_to = curves_.radius_at(c, cut_[k + 1]);
        const Vec3 along = to - from;
        add(Kind::branch, parent, from, least_turn(frame_of(parent), along), {along.norm(), radius, radius_to},
            curves_.branch[c], cut_[k] / length);
        parent = std::int32_t(next_) - 1;
        from = to;
        radius = radius_to;
    }
}

void Builder::add_leaf(std::size_t k, const Material& material) {
    const std::int32_t branch = splines_.leaf_branch[k];
    const std::int32_t parent = piece_at(curves_.place(branch, splines_.leaf_at[k]));
    const bool petal = splines_.is_petal(k);
    add(petal ? Kind::petal : Kind::leaf, parent, splines_.leaf_position[k], splines_.leaf_rotation[k].normalized(),
        {splines_.leaf_length[k], splines_.leaf_width[k], petal ? material.petal_thickness : material.leaf_thickness},
        branch, splines_.leaf_at[k]);
}

void Builder::add_fruit(std::size_t k) {
    const std::int32_t branch = splines_.fruit_branch[k];
    const std::int32_t parent = piece_at(curves_.place(branch, splines_.fruit_at[k]));
    const Vec3 along = splines_.fruit_center[k] - splines_.fruit_position[k];
    const double radius = splines_.fruit_radius[k];
    add(Kind::fruit, parent, splines_.fruit_position[k], least_turn(frame_of(parent), along),
        {along.norm(), radius, radius}, branch, splines_.fruit_at[k]);
}

// Leaves stand behind the wood, in their order.
void Builder::count_leaves() {
    const std::vector<std::int32_t> counts = leaf_counts(splines_);
    if (std::all_of(counts.begin(), counts.end(), [](std::int32_t n) { return n == 1; })) return;
    tree_.leaf_count.assign(tree_.size_bodies(), 1);
    std::copy(counts.begin(), counts.end(), tree_.leaf_count.begin() + std::ptrdiff_t(next_ - counts.size()));
}

Tree Builder::finish() {
    return std::move(tree_);
}

} // namespace

Tree make_bodies(const Splines& splines, const Curves& curves, const CutRule& rule, const Material& material) {
    Builder build(splines, curves, rule);
    for (std::size_t c = 0; c < curves.size(); ++c) build.add_curve(c);
    for (std::size_t k = 0; k < splines.leaves(); ++k) build.add_leaf(k, material);
    build.count_leaves();
    for (std::size_t k = 0; k < splines.fruits(); ++k) build.add_fruit(k);
    return build.finish();
}

} // namespace bough
