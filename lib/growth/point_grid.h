// point_grid.h: for many points, the nearest of places that are named one after another, by a uniform grid of cells;
// points can be taken out. Each cell remembers the largest distance that a point of it still has, so that a place looks
// only into cells where it can be the nearest. Making it O(points).
#pragma once
#include "../base/math.h"
#include <algorithm>
#include <vector>

namespace bough {

class PointGrid {
public:
    // Cells of edge `cell` [m], longer where there would be more than four for each point.
    PointGrid(const std::vector<Vec3>& points, double cell);

    // f(index, squared distance) for every point left within `radius` of p, its edge included, whose squared distance to
    // the places before may be larger than that to p, and for some others; in no particular order. It returns the
    // smallest squared distance that the point now has to any place (infinity: no place counts yet). f must not remove
    // points.
    template <class F> void each_nearer(const Vec3& p, double radius, F&& f) {
        const double most = radius * radius;
        const Cell low = cell_of(p - Vec3::Constant(radius)), high = cell_of(p + Vec3::Constant(radius));
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x) {
                    const std::size_t c = number(x, y, z);
                    if (left_[c] == 0 || square_to({x, y, z}, p) > std::min(most, reach_[c])) continue;
                    double reach = 0;
                    for (std::size_t i = first_[c], end = first_[c] + left_[c]; i < end; ++i)
                        reach = std::max(reach, f(index_[i], (place_[i] - p).squaredNorm()));
                    reach_[c] = reach;
                }
    }

    void remove(std::int32_t index); // a point that has not been removed

private:
    struct Cell {
        int x, y, z;
    };
    Cell cell_of(const Vec3&) const; // clamped to the grid
    // Squared distance from p to the cell, a little less for rounding.
    double square_to(const Cell& c, const Vec3& p) const {
        const Vec3 low = lower_ + cell_ * Vec3(c.x, c.y, c.z);
        const Vec3 off = (low - p).cwiseMax(p - low - Vec3::Constant(cell_)).cwiseMax(0.0);
        return (1 - 1e-9) * off.squaredNorm();
    }
    std::size_t number(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_.y) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(size_.x) +
               static_cast<std::size_t>(x);
    }

    Vec3 lower_ = Vec3::Zero();
    double cell_ = 1;
    Cell size_{1, 1, 1};
    std::vector<std::uint32_t> first_, left_; // of each cell: its slots, and how many of them are left
    std::vector<double> reach_;               // of each cell: no point left has a larger squared distance
    std::vector<Vec3> place_;                 // of each slot
    std::vector<std::int32_t> index_;         // of each slot
    std::vector<std::uint32_t> slot_;         // of each point
};

} // namespace bough
