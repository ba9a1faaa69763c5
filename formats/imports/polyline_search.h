// polyline_search.h: the nearest points of polylines that are asked for many times: of branches on which others begin.
#pragma once
#include "imported_tree.h"
#include <memory>

namespace bough {

// Of one polyline, which stays as it is meanwhile. Boxes around its runs, and boxes around those. O(points) to make, and to ask for one
// about O(log points) where the polyline is no ball of wool.
class PolylineSearch {
public:
    explicit PolylineSearch(const std::vector<Vec3>& polyline);
    OnPolyline nearest(const Vec3& p) const; // what nearest_on() finds, bit by bit

private:
    struct Box {
        Vec3 low, high;
    };
    double distance2(const Box&, const Vec3& p) const;
    double reached(const Vec3& p) const;
    void look(std::size_t level, std::size_t box, const Vec3& p, double within, OnPolyline& best, double& arc) const;

    const std::vector<Vec3>& polyline_;
    std::vector<double> arc_;             // where each segment begins, and the whole
    std::vector<std::vector<Box>> level_; // runs of segments first, the box around all last
};

// Of branches, whose points stay as they are. Short ones are looked through.
class BranchSearch {
public:
    explicit BranchSearch(const std::vector<ImportedBranch>& branches) : branches_(branches) {}
    OnPolyline nearest(std::size_t branch, const Vec3& p);

private:
    const std::vector<ImportedBranch>& branches_;
    std::vector<std::unique_ptr<PolylineSearch>> search_; // of each branch that was asked for
};

} // namespace bough
