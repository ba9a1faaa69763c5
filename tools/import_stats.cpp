#include "import_stats.h"
#include "lib/base/counted.h"
#include "lib/model/polyline.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace bough {
namespace {

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

} // namespace bough
