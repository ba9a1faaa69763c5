// pipe.h: radii that carry what grows on them, by da Vinci's rule (the pipe model with exponent 2): at every point of a
// branch the cross-section is at least the sum of those of all tips, its own and its side branches', further out. Radii
// only grow. Reads and writes Splines::radius (of a tree whose branches stand parents before children). O(points log points).
#pragma once
#include "../model/splines.h"

namespace bough {

void thicken_by_pipe_model(Splines&);

} // namespace bough
