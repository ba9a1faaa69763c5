#include "near_pairs.h"
#include "../base/parallel.h"
#include "../plan/state.h"
#include "shape.h"
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace bough {
namespace {

constexpr int most_cells = 1 << 18;
constexpr std::size_t bodies_a_block = 1024;
constexpr double body_ns = 60; // to place it, and to look into its cells

Vector3<float> in_float(const Vec3& v) {
    return v.cast<float>();
}

} // namespace

template <class T> typename NearPairs<T>::Box NearPairs<T>::box_of(const Ends& from, const Ends& to, double radius) {
    Box box{from.a.cwiseMin(from.b).cwiseMin(to.a).cwiseMin(to.b),
            from.a.cwiseMax(from.b).cwiseMax(to.a).cwiseMax(to.b)};
    const float far = std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
    const float wider = float(radius) + 1e-4f + 1e-5f * far; // where it is, and what counts as touching (shape.h)
    box.low.array() -= wider;
    box.high.array() += wider;
    return box;
}

// What is not meets nothing, and ends the run after the step.
template <class T> bool NearPairs<T>::finite(const Box& box) {
    return box.low.allFinite() && box.high.allFinite();
}

template <class T>
typename NearPairs<T>::Ends NearPairs<T>::ends_of(const State<T>& state, const Tree& tree, std::size_t i) const {
    const Capsule own = capsule_of(tree.kind[i], tree.size[i]); // along its z-axis
    const Vector3<float> x = state.x_w[i].template cast<float>(), along = state.R_wb[i].col(2).template cast<float>();
    return {x + float(own.a.z()) * along, x + float(own.b.z()) * along};
}

template <class T>
void NearPairs<T>::begin(const Plan<T>& plan, State<T>& state, const Tree& tree, const Subtrees& trees) {
    if (order_.empty()) {
        order_.reserve(plan.bodies);
        std::vector<std::uint32_t> stack;
        for (const std::uint32_t root : trees.roots)
            visit_subtree(trees, root, stack, [&](std::size_t i) {
                order_.push_back(std::uint32_t(i));
                return true;
            });
        ends_.resize(plan.bodies);
    }
    if (at_ == state.step) return;
    present(plan, state);
    parallel_for(order_.size(), body_ns / 3,
                 [&](std::size_t rank) { ends_[rank] = ends_of(state, tree, order_[rank]); });
    at_ = state.step;
}

template <class T>
const std::vector<NearPair>& NearPairs<T>::find(const Plan<T>& plan, State<T>& state, const Tree& tree,
                                                const Contact& contact, const std::vector<FreeBody>& free,
                                                const std::vector<std::optional<FreeMotion>>& ends) {
    parts_.clear();
    pairs_.clear();
    for (std::size_t k = 0; k < free.size(); ++k)
        if (ends[k] && !free[k].at_rest && (contact.leaves || !free[k].leaf())) add_parts(free[k], k, *ends[k]);
    make_grid();
    present(plan, state);
    const bool stand = at_ == state.step;
    const std::size_t blocks = (order_.size() + bodies_a_block - 1) / bodies_a_block;
    found_.resize(blocks);
    parallel_blocks(blocks, body_ns * double(bodies_a_block), [&](std::size_t block, int) {
        found_[block].clear();
        const std::size_t end = std::min(order_.size(), (block + 1) * bodies_a_block);
        for (std::size_t rank = block * bodies_a_block; rank < end; ++rank) {
            const std::size_t i = order_[rank];
            const Ends now = stand ? ends_[rank] : ends_of(state, tree, i), before = std::exchange(ends_[rank], now);
            if (plan.mass[i] == 0 || (is_flat(tree.kind[i]) && !contact.leaves)) continue;
            const Capsule own = capsule_of(tree.kind[i], tree.size[i]);
            look(std::uint32_t(rank), box_of(before, now, std::max(own.radius_a, own.radius_b)), found_[block]);
        }
    });
    for (const std::vector<NearPair>& found : found_) pairs_.insert(pairs_.end(), found.begin(), found.end());
    at_ = state.step;
    std::sort(pairs_.begin(), pairs_.end(), [](const NearPair& a, const NearPair& b) {
        return std::tie(a.free, a.rank, a.part) < std::tie(b.free, b.rank, b.part);
    });
    return pairs_;
}

template <class T> void NearPairs<T>::add_parts(const FreeBody& free, std::size_t k, const FreeMotion& end) {
    for (std::size_t p = 0; p < free.parts.size(); ++p) {
        const Capsule from = placed(free.motion, free.parts[p]), to = placed(end, free.parts[p]);
        const Box box = box_of({in_float(from.a), in_float(from.b)}, {in_float(to.a), in_float(to.b)},
                               std::max(from.radius_a, from.radius_b));
        if (finite(box)) parts_.push_back({box, std::uint32_t(k), std::uint32_t(p)});
    }
}

// Cells as large as the parts' boxes are on average, or larger where parts are so far from each other that there would be too many.
template <class T> void NearPairs<T>::make_grid() {
    if (parts_.empty()) return;
    all_ = parts_.front().box;
    double sum = 0;
    for (const PartBox& part : parts_) {
        all_ = {all_.low.cwiseMin(part.box.low), all_.high.cwiseMax(part.box.high)};
        sum += double((part.box.high - part.box.low).maxCoeff());
    }
    const Eigen::Array3d extent = (all_.high.template cast<double>() - all_.low.template cast<double>()).array();
    double size = sum / double(parts_.size());
    while (((extent / size).floor() + 1).prod() > most_cells) size *= 1.25;
    size_ = float(size);
    count_ = (extent / double(size_)).floor().template cast<int>() + 1;
    first_.assign(std::size_t(count_.prod()) + 2, 0);
    for (const PartBox& part : parts_) visit_cells(part.box, [&](std::size_t cell) { ++first_[cell + 2]; });
    for (std::size_t c = 2; c < first_.size(); ++c) first_[c] += first_[c - 1];
    in_cell_.resize(first_.back());
    for (std::size_t p = 0; p < parts_.size(); ++p)
        visit_cells(parts_[p].box, [&](std::size_t cell) { in_cell_[first_[cell + 1]++] = std::uint32_t(p); });
}

template <class T> typename NearPairs<T>::Cell NearPairs<T>::cell_at(const Vector3<float>& point) const {
    const Eigen::Array3f cell = ((point - all_.low) / size_).array().floor(),
                         last = (count_ - 1).template cast<float>();
    return cell.max(0).min(last).template cast<int>(); // no int holds what is far away
}

template <class T> template <class Visit> void NearPairs<T>::visit_cells(const Box& box, Visit&& visit) const {
    const Cell low = cell_at(box.low), high = cell_at(box.high);
    for (int z = low.z(); z <= high.z(); ++z)
        for (int y = low.y(); y <= high.y(); ++y)
            for (int x = low.x(); x <= high.x(); ++x) visit(std::size_t((z * count_.y() + y) * count_.x() + x));
}

template <class T> void NearPairs<T>::look(std::uint32_t rank, const Box& box, std::vector<NearPair>& found) const {
    const auto apart = [&box](const Box& other) {
        return (box.low.array() > other.high.array()).any() || (box.high.array() < other.low.array()).any();
    };
    if (parts_.empty() || !finite(box) || apart(all_)) return;
    visit_cells(box, [&](std::size_t cell) {
        for (std::uint32_t c = first_[cell]; c < first_[cell + 1]; ++c) {
            const PartBox& part = parts_[in_cell_[c]];
            if (apart(part.box)) continue;
            // Of the cells that both overlap, in one alone: where the lower corner of what they share is.
            const Cell own = cell_at(box.low.cwiseMax(part.box.low));
            if (std::size_t((own.z() * count_.y() + own.y()) * count_.x() + own.x()) == cell)
                found.push_back({part.free, rank, part.part});
        }
    });
}

template <class T> std::size_t NearPairs<T>::bytes() const {
    std::size_t found = 0;
    for (const std::vector<NearPair>& some : found_) found += sizeof(NearPair) * some.capacity();
    return found + sizeof(std::uint32_t) * (order_.capacity() + first_.capacity() + in_cell_.capacity()) +
           sizeof(Ends) * ends_.capacity() + sizeof(PartBox) * parts_.capacity() + sizeof(NearPair) * pairs_.capacity();
}

#define BOUGH_INSTANTIATE(T) template class NearPairs<T>;
#include "../base/instantiate.inc"

} // namespace bough
