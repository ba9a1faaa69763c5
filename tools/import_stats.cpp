#include "import_stats.h"
#include "lib/base/counted.h"
#include "lib/model/polyline.h"
#include "lib/study/modes.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace bough {
namespace {

constexpr double leans_any_way =
    1e-3; // [Hz] below, a round stem that has gone over turns about the upright: rounding alone

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void add(double v) {
        low = std::min(low, v);
        high = std::max(high, v);
    }
};

std::string unit_name(double unit) {
    for (const auto& [metres, name] : {std::pair(1.0, "m"), std::pair(0.01, "cm"), std::pair(0.001, "mm"),
                                       std::pair(0.3048, "ft"), std::pair(0.0254, "in"), std::pair(1e-6, "um")})
        if (std::abs(unit / metres - 1) < 1e-9) return name;
    std::ostringstream text;
    text << unit << " m";
    return text.str();
}

double length_of(const Splines& s) {
    double length = 0;
    for (std::size_t b = 0; b < s.branches(); ++b) length += arc_lengths(points_of(s, b)).back();
    return length;
}

} // namespace

std::string import_statistics(const Splines& s, const ImportNotes& notes) {
    std::array<Range, 3> extent;
    Range radius;
    for (const Vec3& p : s.point)
        for (int k = 0; k < 3; ++k) extent[std::size_t(k)].add(p[k]);
    for (const double r : s.radius) radius.add(r);
    const auto roots = std::count(s.parent.begin(), s.parent.end(), -1);
    const int levels = s.level.empty() ? 0 : 1 + *std::max_element(s.level.begin(), s.level.end());
    std::ostringstream text;
    text << "read        " << notes.format << ": " << counted(s.branches(), "branch", "branches") << " on "
         << counted(levels, "level", "levels") << ", " << counted(s.points(), "point", "points") << ", "
         << counted(s.leaves(), "leaf", "leaves") << ", " << s.fruits() << " fruit\n"
         << "units       " << unit_name(notes.unit) << " (" << notes.unit_from << ")\n"
         << "up axis     " << (notes.up == 'z' ? "Z" : "Y") << " (" << notes.up_from << ")\n"
         << "roots       " << roots << "\n";
    if (s.points() > 0) {
        text << "height      " << extent[1].high - extent[1].low << " m, from " << extent[1].low << " to "
             << extent[1].high << "; " << extent[0].high - extent[0].low << " by " << extent[2].high - extent[2].low
             << " m wide\n"
             << "wood        " << length_of(s) << " m long; radii from " << radius.low << " to " << radius.high
             << " m\n";
    }
    for (const std::string& line : notes.lines) text << "note        " << line << "\n";
    return text.str();
}

std::string sway_text(const Tree& tree) {
    std::ostringstream text;
    try {
        const SmallMotion small(tree, Vec3(0, -9.81, 0), Pose::drawn);
        const Sway x = sway_along(small, Vec3::UnitX()), z = sway_along(small, Vec3::UnitZ());
        const double lowest = std::min(x.lowest, z.lowest);
        std::string buckles;
        if (!small.buckled().empty())
            buckles = "branch " + std::to_string(tree.branch[small.buckled().front()]) +
                      " buckles under what it carries, and leans " + (lowest < leans_any_way ? "any way; " : "over; ") +
                      buckling_remedy;
        if (!buckles.empty() && lowest < leans_any_way) return "none: " + buckles;
        text << x.frequency << " and " << z.frequency << " Hz along x and z, " << std::lround(100 * x.share)
             << " % and " << std::lround(100 * z.share) << " % of the bend under a steady push; lowest mode " << lowest
             << " Hz (treeprofile modes)";
        if (!buckles.empty()) text << "; " << buckles;
    } catch (const std::domain_error& error) {
        text << "none: " << error.what();
    }
    return text.str();
}

} // namespace bough
