#include "leaf_form.h"
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace bough {
namespace {

// [1] Half a petiole's width, of the leaf's length: thinner under a narrow blade.
double stalk_of(double width) {
    return 0.012 * std::min(1.0, width / 0.5);
}

void require(bool good, const char* field, const char* expected) {
    if (!good) throw std::invalid_argument(std::string(field) + " is out of range, expected " + expected);
}

Vec2 between(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, double t) {
    return 0.5 * (2 * b + t * (c - a) + t * t * (2 * a - 5 * b + 4 * c - d) + t * t * t * (3 * b - a - 3 * c + d));
}

// The curve through points, `fine` between two; a point that stands twice is a corner, and stands once in the result.
std::vector<Vec2> through(const std::vector<Vec2>& points, int fine) {
    std::vector<Vec2> curve;
    const std::size_t n = points.size();
    for (std::size_t k = 0; k + 1 < n; ++k) {
        const Vec2 &b = points[k], &c = points[k + 1];
        if (b == c) continue;
        const Vec2 a = k > 0 ? points[k - 1] : b, d = k + 2 < n ? points[k + 2] : c;
        for (int j = 0; j <= fine; ++j) curve.push_back(between(a, b, c, d, double(j) / (fine + 1)));
    }
    curve.push_back(points.back());
    return curve;
}

// Teeth that point to the tip: along the curve the margin goes out evenly, and back in at once.
std::vector<Vec2> toothed(const std::vector<Vec2>& curve, int teeth, double depth, int fine) {
    std::vector<double> arc{0};
    for (std::size_t k = 1; k < curve.size(); ++k) arc.push_back(arc.back() + (curve[k] - curve[k - 1]).norm());
    std::vector<Vec2> result{curve.front()};
    std::size_t k = 1;
    const int steps = fine > 0 ? 4 : 1; // points on a tooth's back
    for (int tooth = 0; tooth < teeth; ++tooth)
        for (int j = 0; j <= steps; ++j) {
            const double rise = double(j) / steps, at = arc.back() * (tooth + 0.9 * rise) / teeth;
            if (at <= 0) continue;
            while (k + 1 < curve.size() && arc[k] < at) ++k;
            const Vec2 way = curve[k] - curve[k - 1];
            const double t = way.norm() > 0 ? (at - arc[k - 1]) / way.norm() : 0;
            const Vec2 out = way.norm() > 0 ? Vec2(Vec2(way.y(), -way.x()) / way.norm()) : Vec2(1, 0);
            const double taper = std::min({1.0, 4 * at / arc.back(), 4 * (1 - at / arc.back())});
            Vec2 p = curve[k - 1] + t * way + depth * taper * rise * out;
            p.x() = std::max(p.x(), 0.0);
            result.push_back(p);
        }
    result.push_back(curve.back());
    return result;
}

} // namespace

void check_leaf_form(const LeafForm& f) {
    const std::size_t n = f.outline.size();
    require(n == 0 || (n % 2 == 0 && n >= 6), "leaf_outline", "pairs (along, across), three at least");
    for (std::size_t k = 0; k < n; ++k) require(f.outline[k] >= 0 && f.outline[k] <= 1, "leaf_outline", "0 to 1 each");
    if (n > 0) require(f.outline[n - 2] == 1 && f.outline[n - 1] == 0, "leaf_outline", "a curve that ends at (1, 0)");
    require(f.veins == "pinnate" || f.veins == "palmate" || f.veins == "parallel", "leaf_veins",
            "pinnate, palmate or parallel");
    require(f.petiole >= 0 && f.petiole <= 0.8, "leaf_petiole", "0 to 0.8");
    require(std::abs(f.fold) <= 80, "leaf_fold", "-80 to 80 degrees");
    require(std::abs(f.curl) <= 180, "leaf_curl", "-180 to 180 degrees");
    require(f.teeth >= 0 && f.teeth <= 60, "leaf_teeth", "0 to 60");
    require(f.tooth >= 0 && f.tooth <= 0.5, "leaf_tooth", "0 to 0.5");
    require(f.needles >= 1 && f.needles <= 30, "leaf_needles", "1 to 30");
    require(f.spread >= 0 && f.spread <= 180, "leaf_spread", "0 to 180 degrees");
}

std::vector<Vec2> leaf_half(const LeafForm& form, double width, int fine) {
    std::vector<Vec2> points;
    const double blade = 1 - form.petiole;
    for (std::size_t k = 0; k + 1 < form.outline.size(); k += 2)
        points.emplace_back(form.outline[k + 1] * width / 2, form.petiole + blade * form.outline[k]);
    std::vector<Vec2> curve = through(points, fine);
    if (form.teeth > 0) curve = toothed(curve, form.teeth, form.tooth * width / 2, fine);
    std::vector<Vec2> half{{0, 0}};
    if (form.petiole > 0) {
        half.emplace_back(stalk_of(width), 0);
        half.emplace_back(stalk_of(width), form.petiole);
    }
    for (const Vec2& p : curve)
        if ((p - half.back()).norm() > 1e-6) half.push_back(p);
    return half;
}

double leaf_area_of(const std::vector<Vec2>& half) {
    double area = 0;
    for (std::size_t k = 0; k + 1 < half.size(); ++k)
        area += half[k].x() * half[k + 1].y() - half[k + 1].x() * half[k].y();
    return std::abs(area); // the midrib, x = 0, adds nothing
}

std::vector<double> needle_angles(const LeafForm& form) {
    std::vector<double> angles;
    const double all = form.spread * std::numbers::pi / 180;
    for (std::int32_t k = 0; k < form.needles; ++k)
        angles.push_back(form.needles > 1 ? all * (double(k) / (form.needles - 1) - 0.5) : 0);
    return angles;
}

const std::vector<SprayLeaf>& spray_leaves() {
    static const std::vector<SprayLeaf> leaves{{{0.004, 0.10}, 1.05, 0.42}, {{-0.004, 0.20}, -1.00, 0.44},
                                               {{0.004, 0.30}, 0.90, 0.45}, {{-0.004, 0.40}, -0.80, 0.45},
                                               {{0.004, 0.48}, 0.62, 0.43}, {{-0.002, 0.54}, -0.28, 0.44}};
    return leaves;
}

} // namespace bough
