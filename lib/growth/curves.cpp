#include "curves.h"
#include <algorithm>

namespace bough {

std::vector<double> tree_extents(const Splines& splines) {
    const std::size_t n = splines.branches();
    std::vector<std::size_t> root(n);
    std::vector<Eigen::AlignedBox3d> box(n);
    for (std::size_t b = 0; b < n; ++b) {
        root[b] = splines.parent[b] < 0 ? b : root[splines.parent[b]];
        for (std::int32_t i = splines.first_point[b]; i < splines.first_point[b + 1]; ++i)
            box[root[b]].extend(splines.point[i]);
    }
    std::vector<double> extent(n);
    for (std::size_t b = 0; b < n; ++b) extent[b] = box[root[b]].sizes().maxCoeff();
    return extent;
}

namespace {

// Appends the points of branch b that are kept; returns false, with nothing appended, if they have no length.
bool append_points(Curves& curves, const Splines& splines, std::size_t b, double nearest) {
    const std::size_t begin = curves.point.size();
    for (std::int32_t i = splines.first_point[b]; i < splines.first_point[b + 1]; ++i) {
        double step = 0;
        if (curves.point.size() > begin) {
            step = (splines.point[i] - curves.point.back()).norm();
            if (!(step > nearest)) continue;
        }
        curves.arc.push_back(curves.point.size() > begin ? curves.arc.back() + step : 0.0);
        curves.point.push_back(splines.point[i]);
        curves.radius.push_back(splines.radius[i]);
    }
    const bool has_length = curves.point.size() > begin + 1;
    if (!has_length) {
        curves.point.resize(begin);
        curves.radius.resize(begin);
        curves.arc.resize(begin);
    }
    return has_length;
}

std::int64_t raise_thin(std::vector<double>& radius, std::size_t begin, double least) {
    std::int64_t raised = 0;
    for (std::size_t i = begin; i + 1 < radius.size(); ++i)
        if (radius[i] < least) {
            radius[i] = least;
            ++raised;
        }
    return raised;
}

// The segment of curve c that holds arc length s: index of its first point.
std::size_t segment_at(const Curves& curves, std::size_t c, double s) {
    const auto begin = curves.arc.begin() + curves.first[c] + 1, end = curves.arc.begin() + curves.first[c + 1] - 1;
    return std::size_t(std::upper_bound(begin, end, s) - curves.arc.begin()) - 1;
}

double fraction_in(const Curves& curves, std::size_t i, double s) {
    return std::clamp((s - curves.arc[i]) / (curves.arc[i + 1] - curves.arc[i]), 0.0, 1.0);
}

} // namespace

CurvePlace Curves::place(std::int32_t splines_branch, double at) const {
    if (splines_branch < 0) return {-1, 0};
    const std::int32_t c = curve_of[splines_branch];
    return c >= 0 ? CurvePlace{c, at} : host[splines_branch];
}

Vec3 Curves::position_at(std::size_t c, double s) const {
    const std::size_t i = segment_at(*this, c, s);
    const double t = fraction_in(*this, i, s);
    return (1 - t) * point[i] + t * point[i + 1];
}

double Curves::radius_at(std::size_t c, double s) const {
    const std::size_t i = segment_at(*this, c, s);
    const double t = fraction_in(*this, i, s);
    return (1 - t) * radius[i] + t * radius[i + 1];
}

Curves make_curves(const Splines& splines, double merge) {
    Curves curves;
    const std::size_t branches = splines.branches();
    const std::vector<double> extent = tree_extents(splines);
    curves.curve_of.assign(branches, -1);
    curves.host.assign(branches, {-1, 0});
    curves.first.push_back(0);
    for (std::size_t b = 0; b < branches; ++b) {
        const std::int64_t points = splines.first_point[b + 1] - splines.first_point[b];
        const std::size_t begin = curves.point.size();
        const CurvePlace parent = curves.place(splines.parent[b], splines.parent_at[b]);
        curves.host[b] = parent;
        const bool kept = append_points(curves, splines, b, merge * extent[b]);
        curves.merged_points += points - std::int64_t(curves.point.size() - begin);
        if (!kept) {
            ++curves.dropped_branches;
            curves.merged_points -= points; // counted as a branch instead
            continue;
        }
        curves.thin_points += raise_thin(curves.radius, begin, thin_radius * extent[b]);
        curves.curve_of[b] = std::int32_t(curves.size());
        curves.branch.push_back(std::int32_t(b));
        curves.parent.push_back(parent);
        curves.extent.push_back(extent[b]);
        curves.first.push_back(std::int32_t(curves.point.size()));
    }
    return curves;
}

} // namespace bough
