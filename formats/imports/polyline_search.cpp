#include "polyline_search.h"
#include <algorithm>
#include <limits>

namespace bough {
namespace {

constexpr std::size_t run_of_segments = 8; // segments in a box of the lowest level, boxes in one of the next
constexpr std::size_t few = 64;

} // namespace

PolylineSearch::PolylineSearch(const std::vector<Vec3>& polyline) : polyline_(polyline) {
    const std::size_t segments = polyline.size() < 2 ? 0 : polyline.size() - 1;
    double arc = 0;
    for (std::size_t k = 0; k < segments; ++k) {
        arc_.push_back(arc);
        arc += (polyline[k + 1] - polyline[k]).norm();
    }
    arc_.push_back(arc);
    if (segments == 0) return;
    std::vector<Box> boxes;
    for (std::size_t k = 0; k < segments; k += run_of_segments) {
        Box box{polyline[k], polyline[k]};
        for (std::size_t j = k; j <= std::min(k + run_of_segments, segments); ++j) {
            box.low = box.low.cwiseMin(polyline[j]);
            box.high = box.high.cwiseMax(polyline[j]);
        }
        boxes.push_back(box);
    }
    level_.push_back(std::move(boxes));
    while (level_.back().size() > 1) {
        const std::vector<Box>& below = level_.back();
        std::vector<Box> above;
        for (std::size_t k = 0; k < below.size(); k += run_of_segments) {
            Box box = below[k];
            for (std::size_t j = k + 1; j < std::min(k + run_of_segments, below.size()); ++j) {
                box.low = box.low.cwiseMin(below[j].low);
                box.high = box.high.cwiseMax(below[j].high);
            }
            above.push_back(box);
        }
        level_.push_back(std::move(above));
    }
}

double PolylineSearch::distance2(const Box& box, const Vec3& p) const {
    return (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0).squaredNorm();
}

// [m] A distance at which some point of the polyline is: down the nearest boxes to a run's first point.
double PolylineSearch::reached(const Vec3& p) const {
    std::size_t at = 0;
    for (std::size_t level = level_.size(); level-- > 1;) {
        const std::size_t from = at * run_of_segments, to = std::min(from + run_of_segments, level_[level - 1].size());
        std::size_t nearest = from;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = from; k < to; ++k)
            if (const double d = distance2(level_[level - 1][k], p); d < least) least = d, nearest = k;
        at = nearest;
    }
    return (polyline_[at * run_of_segments] - p).norm();
}

// In the order of the polyline, so that of equally near points the first is found. `within`: nothing farther is looked for.
void PolylineSearch::look(std::size_t level, std::size_t box, const Vec3& p, double within, OnPolyline& best,
                          double& arc) const {
    const double limit = std::min(within, best.distance) * (1 + 1e-9);
    if (distance2(level_[level][box], p) > limit * limit) return;
    if (level > 0) {
        for (std::size_t k = box * run_of_segments; k < std::min((box + 1) * run_of_segments, level_[level - 1].size());
             ++k)
            look(level - 1, k, p, within, best, arc);
        return;
    }
    for (std::size_t k = box * run_of_segments; k < std::min((box + 1) * run_of_segments, polyline_.size() - 1); ++k) {
        const Vec3 &a = polyline_[k], &b = polyline_[k + 1];
        const double t = projected(a, b, p), distance = (a + t * (b - a) - p).norm();
        if (distance < best.distance) {
            best.segment = k;
            best.t = t;
            best.distance = distance;
            arc = arc_[k] + t * (b - a).norm();
        }
    }
}

OnPolyline PolylineSearch::nearest(const Vec3& p) const {
    OnPolyline best;
    best.distance = std::numeric_limits<double>::infinity();
    if (level_.empty()) return best;
    double arc = 0;
    look(level_.size() - 1, 0, p, reached(p), best, arc);
    best.fraction = arc_.back() > 0 ? std::min(1.0, arc / arc_.back()) : 0.0;
    return best;
}

OnPolyline BranchSearch::nearest(std::size_t branch, const Vec3& p) {
    const std::vector<Vec3>& polyline = branches_[branch].point;
    if (polyline.size() < few) return nearest_on(polyline, p);
    search_.resize(branches_.size());
    if (!search_[branch]) search_[branch] = std::make_unique<PolylineSearch>(polyline);
    return search_[branch]->nearest(p);
}

} // namespace bough
