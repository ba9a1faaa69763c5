#include "weber_penn.h"
#include <cmath>

namespace bough {

namespace {

// The paper's formula to the letter.
double paper_envelope(const GrowthParameters& p, double ratio) {
    if (!(ratio >= 0 && ratio <= 1)) return 0;
    const double above = 1 - p.prune_width_peak;
    return ratio < above ? std::pow(ratio / above, p.prune_power_high)
                         : std::pow((1 - ratio) / above, p.prune_power_low);
}

// Two parabolas from base to middle to top.
double custom_shape(const std::array<double, 4>& shape, double ratio) {
    const auto [base, middle, place, top] = shape;
    const double up = 1 - ratio;
    if (up == 1) return top;
    if (up >= place) {
        const double part = (up - place) / (1 - place);
        return middle + part * part * (top - middle);
    }
    const double left = 1 - up / place;
    return base + (1 - left * left) * (middle - base);
}

double sapling_shape(const GrowthParameters& p, int shape, double ratio) {
    switch (shape) {
    case 0:
        return 0.05 + 0.95 * ratio;
    case 5:
        return 0.05 + 0.95 * (ratio <= 0.7 ? ratio / 0.7 : (1 - ratio) / 0.3);
    case 8:
        return custom_shape(p.sapling.custom_shape, ratio);
    case 9:
        return envelope_ratio(p, ratio);
    case 10:
        return 1 - 0.5 * ratio;
    default:
        return shape_ratio(shape, ratio);
    }
}

} // namespace

double shape_ratio(const GrowthParameters& p, int shape, double ratio) {
    switch (p.rules) {
    case GrowthRules::sapling:
        return sapling_shape(p, shape, ratio);
    case GrowthRules::arbaro:
        if (shape == 0) return ratio;
        [[fallthrough]];
    case GrowthRules::tree_gen:
        return shape == 8 ? paper_envelope(p, ratio) : shape_ratio(shape, ratio);
    default:
        return shape == 8 ? envelope_ratio(p, ratio) : shape_ratio(shape, ratio);
    }
}

} // namespace bough
