#include "monotone.h"
#include <algorithm>
#include <cstddef>

namespace bough {

double monotone_cubic(const std::vector<double>& x, const std::vector<double>& y, double at) {
    if (x.size() < 2 || at <= x.front()) return y.front();
    if (at >= x.back()) return y.back();
    const auto i = std::size_t(std::upper_bound(x.begin(), x.end(), at) - x.begin()) - 1;
    const auto rise = [&](std::size_t k) { return (y[k + 1] - y[k]) / (x[k + 1] - x[k]); };
    const auto slope = [&](std::size_t k) {
        if (k == 0 || k + 1 == x.size()) return 0.0;
        const double a = rise(k - 1), b = rise(k);
        return a * b > 0 ? 2 * a * b / (a + b) : 0.0;
    };
    const double h = x[i + 1] - x[i], w = (at - x[i]) / h, v = 1 - w;
    return v * v * (1 + 2 * w) * y[i] + w * w * (1 + 2 * v) * y[i + 1] + h * w * v * (v * slope(i) - w * slope(i + 1));
}

} // namespace bough
