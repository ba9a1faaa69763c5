#include "own_mover.h"
#include "lib/base/parallel.h"
#include "lib/model/drawn_pose.h"
#include <algorithm>

namespace bough {

OwnMover::OwnMover(const OwnMesh& mesh, const Tree& tree) : mesh_(mesh) {
    DrawnPose drawn = drawn_pose(tree);
    drawn_R_bw_ = std::move(drawn.R_wb);
    drawn_x_w_ = std::move(drawn.x_w);
    for (Mat3& R : drawn_R_bw_) R.transposeInPlace();
    const auto add = [&](const OwnPart& part, const OwnPlace* place) {
        const Run run{vertices_, &part, place};
        const std::size_t count = surface_of(run).position.size();
        if (count > 0) runs_.push_back(run);
        vertices_ += count;
    };
    for (const OwnPart& part : mesh.part) {
        add(part, nullptr);
        for (const OwnPlace& place : part.placed) add(part, &place);
    }
}

void OwnMover::go_to(const MotionFrame& frame) {
    turn_.resize(drawn_R_bw_.size());
    for (std::size_t b = 0; b < turn_.size(); ++b) turn_[b] = frame.rotation[b].toRotationMatrix() * drawn_R_bw_[b];
    x_w_ = frame.position;
}

void OwnMover::positions(std::size_t first, std::span<Vec3> to) const {
    constexpr std::size_t share = 2048; // vertices a thread takes at once
    constexpr double vertex_ns = 30;
    parallel_blocks((to.size() + share - 1) / share, vertex_ns * double(share), [&](std::size_t k, int) {
        const std::size_t from = k * share;
        fill(first + from, to.subspan(from, std::min(share, to.size() - from)));
    });
}

void OwnMover::fill(std::size_t first, std::span<Vec3> to) const {
    auto run = std::upper_bound(runs_.begin(), runs_.end(), first,
                                [](std::size_t vertex, const Run& r) { return vertex < r.first; });
    --run;
    std::size_t v = first - run->first;
    for (Vec3& at : to) {
        while (v >= surface_of(*run).position.size()) ++run, v = 0;
        const Vec3 drawn = position_of(surface_of(*run), v, run->place).cast<double>();
        const OwnShare share = share_of(*run->part, surface_of(*run), v, run->place);
        const double second = double(share.weight), rest = 1 - second;
        at = Vec3::Zero();
        if (second != 0) at += second * moved(share.second, drawn);
        if (rest != 0) at += rest * moved(share.first, drawn);
        ++v;
    }
}

} // namespace bough
