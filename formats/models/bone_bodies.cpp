#include "bone_bodies.h"
#include "formats/imports/imported_tree.h"
#include <algorithm>
#include <limits>
#include <numeric>

namespace bough {
namespace {

constexpr std::int32_t leaf_size = 4;

double square_to_box(const Vec3& low, const Vec3& high, const Vec3& p) {
    return (low - p).cwiseMax(p - high).cwiseMax(Vec3::Zero()).squaredNorm();
}

} // namespace

SegmentBoxes::SegmentBoxes(std::vector<Vec3> start, std::vector<Vec3> end)
    : start_(std::move(start)), end_(std::move(end)), order_(start_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    boxes_.push_back({Vec3::Zero(), Vec3::Zero(), 0, std::int32_t(order_.size())});
    for (std::size_t b = 0; b < boxes_.size(); ++b) {
        Box box = boxes_[b];
        box.low = Vec3::Constant(std::numeric_limits<double>::infinity());
        box.high = -box.low;
        for (std::int32_t k = box.first; k < box.first + box.count; ++k) {
            const std::int32_t s = order_[k];
            box.low = box.low.cwiseMin(start_[s]).cwiseMin(end_[s]);
            box.high = box.high.cwiseMax(start_[s]).cwiseMax(end_[s]);
        }
        if (box.count > leaf_size) {
            int axis = 0;
            (box.high - box.low).maxCoeff(&axis);
            const std::int32_t half = box.count / 2;
            const auto from = order_.begin() + box.first;
            std::nth_element(from, from + half, from + box.count, [&](std::int32_t a, std::int32_t c) {
                return start_[a][axis] + end_[a][axis] < start_[c][axis] + end_[c][axis];
            });
            const std::int32_t first = box.first, count = box.count;
            box.first = std::int32_t(boxes_.size());
            box.count = 0;
            boxes_.push_back({Vec3::Zero(), Vec3::Zero(), first, half});
            boxes_.push_back({Vec3::Zero(), Vec3::Zero(), first + half, count - half});
        }
        boxes_[b] = box;
    }
}

double SegmentBoxes::distance(std::size_t s, const Vec3& p) const {
    return (start_[s] + projected(start_[s], end_[s], p) * (end_[s] - start_[s]) - p).norm();
}

std::size_t SegmentBoxes::nearest(const Vec3& p) const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    std::vector<std::int32_t> stack{0};
    while (!stack.empty()) {
        const Box& box = boxes_[stack.back()];
        stack.pop_back();
        if (square_to_box(box.low, box.high, p) >= least * least) continue;
        if (box.count == 0) { // the nearer one last, so first
            const Box &a = boxes_[box.first], &b = boxes_[box.first + 1];
            const bool a_nearer = square_to_box(a.low, a.high, p) < square_to_box(b.low, b.high, p);
            stack.push_back(box.first + (a_nearer ? 1 : 0));
            stack.push_back(box.first + (a_nearer ? 0 : 1));
            continue;
        }
        for (std::int32_t k = box.first; k < box.first + box.count; ++k) {
            const double d = distance(std::size_t(order_[k]), p);
            if (d < least) least = d, best = std::size_t(order_[k]);
        }
    }
    return best;
}

BoneBodies bodies_of_bones(const std::vector<speedtree::Bone>& bones, const Tree& tree, const std::vector<Mat3>& R_wb,
                           const std::vector<Vec3>& x_w) {
    std::vector<std::int32_t> body, segment_of(tree.size_bodies(), -1);
    std::vector<Vec3> start, end;
    constexpr double any = std::numeric_limits<double>::infinity();
    Vec3 low = Vec3::Constant(any), high = -low;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        if (tree.kind[i] != Kind::branch) continue;
        segment_of[i] = std::int32_t(body.size());
        body.push_back(std::int32_t(i));
        start.push_back(x_w[i]);
        end.push_back(x_w[i] + R_wb[i].col(2) * tree.size[i][0]);
        low = low.cwiseMin(start.back()).cwiseMin(end.back());
        high = high.cwiseMax(start.back()).cwiseMax(end.back());
    }
    BoneBodies result;
    result.turn.assign(bones.size(), -1);
    result.place.assign(bones.size(), -1);
    if (body.empty()) {
        result.missed = bones.size();
        return result;
    }
    result.tree_size = (high - low).maxCoeff();
    low = Vec3::Constant(any), high = -low;
    for (const speedtree::Bone& bone : bones) {
        low = low.cwiseMin(bone.start).cwiseMin(bone.end);
        high = high.cwiseMax(bone.start).cwiseMax(bone.end);
    }
    result.bones_size = (high - low).maxCoeff();
    const SegmentBoxes boxes(start, end);
    for (std::size_t b = 0; b < bones.size(); ++b) {
        const Vec3 along = bones[b].end - bones[b].start,
                   points[3] = {bones[b].start + 0.25 * along, bones[b].start + 0.5 * along,
                                bones[b].start + 0.75 * along};
        double least = std::numeric_limits<double>::infinity(), off = 0;
        std::size_t chosen = 0;
        const auto try_segment = [&](std::size_t s) {
            const double distance =
                (boxes.distance(s, points[0]) + boxes.distance(s, points[1]) + boxes.distance(s, points[2])) / 3;
            const double across = 1 - along.normalized().dot((end[s] - start[s]).normalized());
            const double cost = distance + 0.1 * across * along.norm();
            if (cost < least) least = cost, chosen = s;
        };
        for (const Vec3& p : points) {
            const std::size_t s = boxes.nearest(p);
            off += boxes.distance(s, p) / 3;
            try_segment(s);
            const std::int32_t parent = tree.parent[std::size_t(body[s])];
            if (parent >= 0 && segment_of[parent] >= 0) try_segment(std::size_t(segment_of[parent]));
        }
        result.worst = std::max(result.worst, off);
        const double radius = std::min(tree.size[std::size_t(body[chosen])][1], 0.05 * result.bones_size);
        if (off > 0.01 * result.bones_size + radius) {
            ++result.missed;
            continue;
        }
        std::int32_t place = body[chosen];
        for (std::int32_t i = place; continues_parent(tree, std::size_t(i));) {
            i = tree.parent[i];
            if (boxes.distance(std::size_t(segment_of[i]), bones[b].start) <
                boxes.distance(std::size_t(segment_of[place]), bones[b].start) * (1 - 1e-9))
                place = i;
            else
                break;
        }
        result.turn[b] = body[chosen];
        result.place[b] = place;
    }
    return result;
}

} // namespace bough
