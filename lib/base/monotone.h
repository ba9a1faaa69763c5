// monotone.h: the cubic through keys that never swings past one. Its slope at a key is the harmonic mean of those beside it, and 0 at a turning point
// and at both ends (F. N. Fritsch, J. Butland, A method for constructing local monotone piecewise cubic interpolants, SIAM J. Sci. Stat. Comput. 5
// (1984) 300). It is continuous with its slope, stays between the values of two neighbouring keys, and is constant beyond the ends.
#pragma once
#include <vector>

namespace bough {

// x: the keys, rising. y: one value for each, at least one (for no key or one: y's first everywhere). O(log keys). Errors none.
double monotone_cubic(const std::vector<double>& x, const std::vector<double>& y, double at);

} // namespace bough
