#include "../model/drawn_pose.h"
#include "merge_joints.h"
#include <algorithm>
#include <cassert>

namespace bough {

GroupFrames drawn_frames(const Tree& tree, const JointGroups& groups) {
    const auto [R_wb, x_w] = drawn_pose(tree);
    GroupFrames frames;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        frames.R_wg.push_back(R_wb[std::size_t(groups.lead[g])]);
        frames.x_w.push_back(x_w[std::size_t(groups.first[g])]);
        if (groups.parent[g] < 0) {
            frames.rotation.emplace_back(frames.R_wg[g]);
            frames.position.push_back(frames.x_w[g]);
        } else {
            const std::size_t p = std::size_t(groups.parent[g]);
            frames.rotation.emplace_back(Mat3(frames.R_wg[p].transpose() * frames.R_wg[g]));
            frames.position.push_back(frames.R_wg[p].transpose() * (frames.x_w[g] - frames.x_w[p]));
        }
        frames.rotation.back().normalize();
    }
    return frames;
}

namespace {

constexpr std::size_t most_ends = 10000;

} // namespace

MergeError::MergeError(const Tree& tree, const JointGroups& groups)
    : groups_(groups), drawn_(drawn_frames(tree, groups)), R_wg_(groups.size()), x_w_(groups.size()) {
    const auto [R_wb, x_w] = drawn_pose(tree);
    const std::size_t n = tree.size_bodies(), picked = std::min(n, most_ends);
    for (std::size_t k = 0; k < picked; ++k) {
        const std::size_t i = k * n / picked, g = std::size_t(groups.group[i]);
        const Vec3 end = x_w[i] + R_wb[i].col(2) * tree.size[i].x();
        ends_.push_back({std::int32_t(i), tree.size[i].x(), drawn_.R_wg[g].transpose() * (end - drawn_.x_w[g])});
    }
}

void MergeError::add(const std::vector<Quat>& R_wb, const std::vector<Vec3>& x_w) {
    assert(R_wb.size() == groups_.group.size() && x_w.size() == groups_.group.size());
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        R_wg_[g] = R_wb[std::size_t(groups_.lead[g])].toRotationMatrix();
        const std::int32_t p = groups_.parent[g];
        x_w_[g] = p < 0 ? x_w[std::size_t(groups_.first[g])]
                        : Vec3(x_w_[std::size_t(p)] + R_wg_[std::size_t(p)] * drawn_.position[g]);
    }
    for (const End& end : ends_) {
        const std::size_t i = std::size_t(end.body), g = std::size_t(groups_.group[i]);
        const Vec3 is = x_w[i] + R_wb[i] * Vec3(0, 0, end.length);
        const double squared = (x_w_[g] + R_wg_[g] * end.in_group - is).squaredNorm();
        squares_ += squared;
        largest_ = std::max(largest_, std::sqrt(squared));
    }
    count_ += std::int64_t(ends_.size());
}

double MergeError::rms() const {
    return count_ > 0 ? std::sqrt(squares_ / double(count_)) : 0;
}

} // namespace bough
