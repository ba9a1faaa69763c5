#include "../base/parallel.h"
#include "../model/drawn_pose.h"
#include "skin.h"
#include <cassert>

namespace bough {

SkinDeformer::SkinDeformer(const Skin& skin, const Tree& tree) : skin_(skin) {
    DrawnPose drawn = drawn_pose(tree);
    drawn_R_bw_ = std::move(drawn.R_wb);
    drawn_x_w_ = std::move(drawn.x_w);
    for (Mat3& R : drawn_R_bw_) R.transposeInPlace();
}

void SkinDeformer::deform(const std::vector<Mat3>& R_wb, const std::vector<Vec3>& x_w, std::vector<Vec3>& position,
                          std::vector<Vec3>& normal) const {
    assert(R_wb.size() == drawn_R_bw_.size() && x_w.size() == drawn_x_w_.size());
    position.resize(skin_.position.size());
    normal.resize(skin_.normal.size());
    std::vector<Mat3> moved(R_wb.size()); // world now from world drawn
    constexpr double body_ns = 15, vertex_ns = 40;
    parallel_for(moved.size(), body_ns, [&](std::size_t b) { moved[b] = R_wb[b] * drawn_R_bw_[b]; });
    parallel_for(position.size(), vertex_ns, [&](std::size_t v) {
        // The first weight is what the others leave, so that float weights sum to 1 in double.
        double first = 1;
        Vec3 at = Vec3::Zero(), facing = Vec3::Zero();
        for (int k = 3; k >= 0; --k) {
            const double weight = k == 0 ? first : double(skin_.weight[v][std::size_t(k)]);
            if (weight == 0) continue;
            first -= weight;
            const std::size_t b = std::size_t(skin_.joint[v][std::size_t(k)]);
            at += weight * (x_w[b] + moved[b] * (skin_.position[v] - drawn_x_w_[b]));
            facing += weight * (moved[b] * skin_.normal[v]);
        }
        position[v] = at;
        const double length = facing.norm();
        normal[v] = length > 0 ? Vec3(facing / length) : Vec3(moved[std::size_t(skin_.joint[v][0])] * skin_.normal[v]);
    });
}

} // namespace bough
