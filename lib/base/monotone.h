// monotone.h: the cubic through keys that never swings past one: its slope at a key is the harmonic mean of those beside it, 0 at a turning
// point and at both ends (F. N. Fritsch, J. Butland, A method for constructing local monotone piecewise cubic interpolants, SIAM J. Sci.
// Stat. Comput. 5 (1984) 300). Continuous with its slope; between two keys it stays between their values; constant beyond the ends.
#pragma once
#include <vector>

namespace bough {

// x: the keys, rising; y: one value for each, at least one (of x none or one: y's first everywhere). O(log keys). Errors none.
double monotone_cubic(const std::vector<double>& x, const std::vector<double>& y, double at);

} // namespace bough
