#include "point_grid.h"
#include <algorithm>
#include <limits>
#include <numeric>

namespace bough {

PointGrid::PointGrid(const std::vector<Vec3>& points, double cell) : cell_(cell) {
    if (points.empty()) {
        first_ = {0, 0}, left_ = {0}, reach_ = {0};
        return;
    }
    Vec3 upper = lower_ = points[0];
    for (const Vec3& p : points) lower_ = lower_.cwiseMin(p), upper = upper.cwiseMax(p);
    const Vec3 extent = upper - lower_;
    const auto along = [&](int k) { return std::floor(extent[k] / cell_) + 1; };
    while (along(0) * along(1) * along(2) > 4 * static_cast<double>(points.size()) + 64) cell_ *= 1.25;
    size_ = {static_cast<int>(along(0)), static_cast<int>(along(1)), static_cast<int>(along(2))};
    const std::size_t cells = number(0, 0, size_.z);
    first_.assign(cells + 1, 0);
    std::vector<std::size_t> cell_number(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Cell c = cell_of(points[i]);
        cell_number[i] = number(c.x, c.y, c.z);
        ++first_[cell_number[i] + 1];
    }
    left_.assign(first_.begin() + 1, first_.end());
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    reach_.assign(cells, std::numeric_limits<double>::infinity());
    place_.resize(points.size());
    index_.resize(points.size());
    slot_.resize(points.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::uint32_t slot = next[cell_number[i]]++;
        place_[slot] = points[i];
        index_[slot] = static_cast<std::int32_t>(i);
        slot_[i] = slot;
    }
}

PointGrid::Cell PointGrid::cell_of(const Vec3& p) const {
    const auto along = [&](int k, int size) {
        return static_cast<int>(std::clamp(std::floor((p[k] - lower_[k]) / cell_), 0.0, static_cast<double>(size - 1)));
    };
    return {along(0, size_.x), along(1, size_.y), along(2, size_.z)};
}

// The last point left of the cell takes the slot.
void PointGrid::remove(std::int32_t index) {
    const std::uint32_t slot = slot_[static_cast<std::size_t>(index)];
    const Cell at = cell_of(place_[slot]);
    const std::size_t c = number(at.x, at.y, at.z);
    const std::uint32_t last = first_[c] + --left_[c];
    place_[slot] = place_[last];
    index_[slot] = index_[last];
    slot_[static_cast<std::size_t>(index_[slot])] = slot;
}

} // namespace bough
