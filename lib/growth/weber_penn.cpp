#include "weber_penn.h"
#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace bough {

double shape_ratio(int shape, double ratio) {
    constexpr double pi = std::numbers::pi;
    const double flame = ratio <= 0.7 ? ratio / 0.7 : (1 - ratio) / 0.3;
    switch (shape) {
    case 0:
        return 0.2 + 0.8 * ratio;
    case 1:
        return 0.2 + 0.8 * std::sin(pi * ratio);
    case 2:
        return 0.2 + 0.8 * std::sin(0.5 * pi * ratio);
    case 4:
        return 0.5 + 0.5 * ratio;
    case 5:
        return flame;
    case 6:
        return 1 - 0.8 * ratio;
    case 7:
        return 0.5 + 0.5 * flame;
    default:
        return 1;
    }
}

double envelope_ratio(const GrowthParameters& p, double ratio) {
    if (!(ratio > 0 && ratio < 1)) return 0;
    const double above = 1 - p.prune_width_peak;
    return ratio < above ? std::pow(ratio / above, p.prune_power_high)
                         : std::pow((1 - ratio) / (1 - above), p.prune_power_low);
}

double crown_ratio(const GrowthParameters& p, double trunk, double base, double offset) {
    const double ratio = (trunk - offset) / (trunk - base);
    if (p.shape == 8) return envelope_ratio(p, ratio);
    const double share = shape_ratio(p.shape, ratio);
    return p.crown_top < 0 ? share : 1 - (1 - share) * (1 - p.crown_top) / (1 - shape_ratio(p.shape, 0));
}

double exact_taper_radius(double taper, double radius, double length, double z) {
    const double unit = taper < 1 ? taper : taper < 2 ? 2 - taper : 0;
    const double cone = radius * (1 - unit * z); // the paper's taper_z
    double result = cone;
    if (taper > 1 && cone > 0) {
        const double from_tip = (1 - z) * length;
        const double depth = taper < 2 || from_tip < cone ? 1 : taper - 2;
        const double bump =
            taper < 2 ? from_tip : std::abs(from_tip - 2 * cone * std::trunc(from_tip / (2 * cone) + 0.5));
        if (taper >= 2 || bump < cone)
            result = (1 - depth) * cone + depth * std::sqrt(std::max(0.0, cone * cone - (bump - cone) * (bump - cone)));
    }
    return result;
}

double taper_radius(double taper, double radius, double length, double z) {
    return std::max(exact_taper_radius(taper, radius, length, z), kLeastTaper * radius);
}

double flare_factor(double flare, double z) {
    const double y = std::max(0.0, 1 - 8 * z);
    return flare * (std::pow(100.0, y) - 1) / 100 + 1;
}

std::vector<double> taper_marks(double taper, double flare, double radius, double length) {
    std::vector<double> marks;
    if (flare != 0) marks = {1.0 / 64, 1.0 / 32, 3.0 / 64, 1.0 / 16, 1.0 / 8};
    if (taper > 1 && length > radius) {
        // The rounding starts where what is left of the stem is as long as it is thick.
        const double unit = taper < 2 ? 2 - taper : 0;
        const double thick = radius * (1 - unit * (length - radius) / (length - unit * radius));
        for (double part : {1.0, 0.5, 0.134}) marks.push_back(1 - part * thick / length);
    }
    if (taper > 2) {
        // A mark every half radius.
        if (!(length <= 1e5 * radius))
            throw std::invalid_argument("taper: is over 2 where ratio, ratio_power, radius_scale and radius_mod make a "
                                        "stem over 1e5 times as long as its radius, expected at most 2");
        for (int k = 3; 0.5 * k * radius < length; ++k) marks.push_back(1 - 0.5 * k * radius / length);
    }
    std::erase_if(marks, [](double z) { return !(z > 0 && z < 1); });
    std::sort(marks.begin(), marks.end());
    return marks;
}

std::int64_t whole_number(double count, double unit) {
    const double whole = std::floor(count);
    return static_cast<std::int64_t>(whole) + (count - whole + unit >= 1 ? 1 : 0);
}

} // namespace bough
