#include "leaf_count.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace bough {
namespace {

std::int32_t whole_count(double leaves) {
    return std::int32_t(std::clamp(std::round(leaves), 1.0, double(std::numeric_limits<std::int32_t>::max())));
}

} // namespace

std::vector<std::int32_t> leaf_counts(const Splines& s) {
    if (!s.leaf_count.empty()) return s.leaf_count;
    std::vector<std::int32_t> counts(s.leaves(), 1);
    for (std::size_t k = 0; k < counts.size(); ++k) {
        const double over = s.leaf_length[k] / reference_leaf;
        if (s.leaf_length[k] > longest_leaf && !s.is_petal(k)) counts[k] = whole_count(over * over);
    }
    return counts;
}

void say_leaf_count(Splines& s) {
    s.leaf_count.clear();
    for (std::size_t k = 0; k < s.leaves(); ++k)
        if (!s.is_petal(k) && s.leaf_length[k] > longest_leaf) s.leaf_count.assign(s.leaves(), 1);
}

} // namespace bough
