// tubes.h: bark as modelling programs draw it: rings of corners about an axis, joined by triangles.
#pragma once
#include "formats/imports/bark.h"
#include <numbers>

namespace bough::test {

// A tube of `corners` about a line of points, each ring across the way between its neighbours; all rings of a step's beginning belong to
// the bone of that step, the last ring to the last one's. A radius of 0 at the end is one corner.
inline void add_tube(BarkSurface& to, const std::vector<Vec3>& axis, const std::vector<double>& radius,
                     const std::vector<std::int32_t>& bone, int corners, double turned = 0) {
    std::vector<std::vector<std::int32_t>> rings;
    for (std::size_t k = 0; k < axis.size(); ++k) {
        const Vec3 way = (axis[std::min(k + 1, axis.size() - 1)] - axis[k > 0 ? k - 1 : 0]).normalized();
        const Vec3 u = way.unitOrthogonal(), v = way.cross(u);
        rings.emplace_back();
        for (int c = 0; c < (radius[k] > 0 ? corners : 1); ++c) {
            const double angle = turned + 2 * std::numbers::pi * c / corners;
            rings.back().push_back(std::int32_t(to.point.size()));
            to.point.push_back(axis[k] + radius[k] * (std::cos(angle) * u + std::sin(angle) * v));
            to.bone.push_back(bone[std::min(k, bone.size() - 1)]);
        }
    }
    for (std::size_t k = 0; k + 1 < rings.size(); ++k)
        for (std::size_t c = 0; c < rings[k].size(); ++c) {
            const auto &a = rings[k], &b = rings[k + 1];
            const std::size_t d = (c + 1) % a.size();
            to.triangle.push_back({a[c], a[d], b[c % b.size()]});
            if (b.size() > 1) to.triangle.push_back({a[d], b[d], b[c]});
        }
}

} // namespace bough::test
