#include "pushes.h"
#include <algorithm>

namespace bough {

Vec3 pull_force(const Pull& pull, double t) {
    if (pull.time.empty() || t < pull.time.front() || t > pull.time.back()) return Vec3::Zero();
    const auto after = std::upper_bound(pull.time.begin(), pull.time.end(), t);
    if (after == pull.time.end()) return pull.force.back();
    const auto k = std::size_t(after - pull.time.begin()) - 1;
    const double w = (t - pull.time[k]) / (pull.time[k + 1] - pull.time[k]);
    return (1 - w) * pull.force[k] + w * pull.force[k + 1];
}

} // namespace bough
