#include "wood_axes.h"
#include "formats/imports/imported_tree.h"
#include <algorithm>
#include <limits>

namespace bough {
namespace {

constexpr double collar = 3; // radii

double smooth(double q) {
    q = std::clamp(q, 0.0, 1.0);
    return q * q * (3 - 2 * q);
}

} // namespace

WoodAxes::WoodAxes(const Tree& tree, const DrawnPose& pose) : tree_(tree), pose_(pose) {
    const std::size_t n = tree.size_bodies();
    chain_of_.assign(n, -1);
    place_of_.assign(n, -1);
    std::vector<std::vector<std::int32_t>> chains;
    for (std::size_t i = 0; i < n; ++i) {
        if (tree.kind[i] != Kind::branch) continue;
        const bool goes_on = continues_parent(tree, i) &&
                             chains[std::size_t(chain_of_[std::size_t(tree.parent[i])])].back() == tree.parent[i];
        if (!goes_on) chains.emplace_back();
        chain_of_[i] = goes_on ? chain_of_[std::size_t(tree.parent[i])] : std::int32_t(chains.size() - 1);
        chains[std::size_t(chain_of_[i])].push_back(std::int32_t(i));
    }
    first_.push_back(0);
    for (const auto& chain : chains) {
        for (const std::int32_t i : chain) {
            place_of_[std::size_t(i)] = std::int32_t(body_.size());
            body_.push_back(i);
            start_.push_back(pose.x_w[std::size_t(i)]);
            end_.push_back(pose.at(std::size_t(i), Vec3(0, 0, tree.size[std::size_t(i)][0])));
        }
        first_.push_back(body_.size());
    }
    if (!body_.empty()) boxes_ = std::make_unique<SegmentBoxes>(start_, end_);
}

WoodAxes::Bound WoodAxes::bind(std::int32_t chain, const Vec3& p) const {
    if (chain < 0) {
        const std::size_t nearest = boxes_->nearest(p);
        chain = chain_of_[std::size_t(body_[nearest])];
        return within(first_[std::size_t(chain)], first_[std::size_t(chain) + 1], nearest, p);
    }
    const std::size_t first = first_[std::size_t(chain)], end = first_[std::size_t(chain) + 1];
    std::size_t nearest = first;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = first; k < end; ++k) {
        const Vec3 on = start_[k] + projected(start_[k], end_[k], p) * (end_[k] - start_[k]);
        const double square = (on - p).squaredNorm();
        if (square < least) least = square, nearest = k;
    }
    return within(first, end, nearest, p);
}

WoodAxes::Bound WoodAxes::within(std::size_t first, std::size_t end, std::size_t k, const Vec3& p) const {
    const auto size = [&](std::size_t at) -> const Vec3& { return tree_.size[std::size_t(body_[at])]; };
    const double length = size(k)[0], half = length / 2;
    double z = pose_.R_wb[std::size_t(body_[k])].col(2).dot(p - start_[k]);
    if (k > first) z = std::max(z, 0.0); // on the outside of a bend: at the joint
    if (k + 1 < end) z = std::min(z, length);
    const std::int32_t own = body_[k];
    if (z >= half) {
        if (k + 1 == end) return {own, own, 0};
        return {own, body_[k + 1], float(smooth(0.5 + 0.5 * (z - length) / half))};
    }
    if (k > first) return {own, body_[k - 1], float(smooth(0.5 - 0.5 * z / half))};
    const std::int32_t bearer = tree_.parent[std::size_t(own)];
    if (bearer < 0 || tree_.kind[std::size_t(bearer)] != Kind::branch) return {own, own, 0};
    const double radius = size(k)[1], out = std::min(half, collar * radius);
    const double q = 0.5 + 0.5 * z / std::max(z < 0 ? radius : out, 1e-30);
    return {own, bearer, float(1 - smooth(q))};
}

} // namespace bough
