#include "up_axis.h"
#include <algorithm>
#include <limits>

namespace bough {
namespace {

constexpr double clearly_thicker = 1.5; // the thickest wood than the thinnest
constexpr double of_trunk = 0.5;        // of the thickest radius

// The thickest and the thinnest known radius.
struct Range {
    double thin = std::numeric_limits<double>::infinity(), thick = 0;
};

Range radii(const std::vector<double>& radius, const std::vector<LineSegment>& segments) {
    Range range;
    for (const LineSegment& s : segments)
        for (const std::int32_t p : {s.a, s.b}) {
            if (!(radius[p] > 0)) continue;
            range.thin = std::min(range.thin, radius[p]);
            range.thick = std::max(range.thick, radius[p]);
        }
    return range;
}

char along_trunks(const std::vector<Vec3>& point, const std::vector<double>& radius,
                  const std::vector<LineSegment>& segments, double thick) {
    Vec3 way = Vec3::Zero();
    for (const LineSegment& s : segments)
        if (std::min(radius[s.a], radius[s.b]) >= of_trunk * thick) way += (point[s.b] - point[s.a]).cwiseAbs();
    return way.z() > way.y() ? 'z' : 'y';
}

} // namespace

char likely_up(const std::vector<Vec3>& point, const std::vector<double>& radius,
               const std::vector<LineSegment>& segments) {
    if (segments.empty()) return 'y';
    const Range range = radii(radius, segments);
    if (range.thick > clearly_thicker * range.thin) return along_trunks(point, radius, segments, range.thick);
    std::int32_t low[2] = {segments.front().a, segments.front().a};
    Vec3 middle = Vec3::Zero();
    double length = 0;
    for (const LineSegment& s : segments) {
        const double l = (point[s.b] - point[s.a]).norm();
        middle += 0.5 * l * (point[s.a] + point[s.b]);
        length += l;
        for (const std::int32_t p : {s.a, s.b})
            for (const int axis : {0, 1})
                if (point[p][axis + 1] < point[low[axis]][axis + 1]) low[axis] = p;
    }
    if (length > 0) middle /= length;
    const auto upright = [&](int axis) {
        const Vec3 over = middle - point[low[axis]];
        const double distance = over.norm();
        return distance > 0 ? over[axis + 1] / distance : 0.0;
    };
    return upright(1) > upright(0) ? 'z' : 'y';
}

void note_guessed_up(char up, ImportNotes& notes) {
    notes.lines.push_back(
        std::string("up axis: the file states none; taken as ") + char(up - 'a' + 'A') +
        ", along which the wood stands more upright over its lowest or thickest end (--up overrides)");
    notes.up_from = "guessed";
}

} // namespace bough
