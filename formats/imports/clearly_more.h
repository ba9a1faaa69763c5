// clearly_more.h: which of two lengths is the larger, where rounding must not decide it: two readers choose by it which child goes on.
#pragma once

namespace bough {

// Whether a is larger than b by more than a millionth of b. Both 0 or above, of one unit.
inline bool clearly_more(double a, double b) {
    return a > b * (1 + 1e-6);
}

} // namespace bough
