// point_grid.h: which of many points lie within a distance of a place, by a uniform grid of cells; points can be taken
// out. Making it O(points); a query visits the cells within the distance and the points left in them.
#pragma once
#include "../model/math.h"
#include <vector>

namespace bough {

class PointGrid {
public:
    // Cells of edge `cell` [m], longer where there would be more than four for each point.
    PointGrid(const std::vector<Vec3>& points, double cell);

    // f(index, squared distance) for every point left within `radius` of p, its edge included; in no particular order.
    // f must not remove points.
    template <class F> void each_within(const Vec3& p, double radius, F&& f) const {
        const double most = radius * radius;
        const Cell low = cell_of(p - Vec3::Constant(radius)), high = cell_of(p + Vec3::Constant(radius));
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x) {
                    const std::size_t c = number(x, y, z);
                    for (std::size_t i = first_[c], end = first_[c] + left_[c]; i < end; ++i) {
                        const double d = (place_[i] - p).squaredNorm();
                        if (d <= most) f(index_[i], d);
                    }
                }
    }

    void remove(std::int32_t index); // a point that has not been removed

private:
    struct Cell {
        int x, y, z;
    };
    Cell cell_of(const Vec3&) const; // clamped to the grid
    std::size_t number(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_.y) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(size_.x) +
               static_cast<std::size_t>(x);
    }

    Vec3 lower_ = Vec3::Zero();
    double cell_ = 1;
    Cell size_{1, 1, 1};
    std::vector<std::uint32_t> first_, left_; // of each cell: its slots, and how many of them are left
    std::vector<Vec3> place_;                 // of each slot
    std::vector<std::int32_t> index_;         // of each slot
    std::vector<std::uint32_t> slot_;         // of each point
};

} // namespace bough
