// pipe.h: radii that carry what grows on them, by the pipe model: at every point of a branch r^exponent is at least
// the sum of r^exponent of all tips, its own and its side branches', further out; exponent 2 is da Vinci's rule. Radii
// only grow. Leaves and fruit stay on the bark (bark.h). Reads and writes Splines::radius (of a tree whose branches stand parents before
// children). O(points log points).
#pragma once
#include "../model/splines.h"

namespace bough {

void thicken_by_pipe_model(Splines&, double exponent);

// The exponent, `least` or more and at most 4, at which the tips of the tree's thickest root come to no more than that
// root's radius at its base, so that more twigs do not make a thicker trunk. O(branches).
double exponent_for_trunk(const Splines&, double least);

} // namespace bough
