// trajectory.h: motion of a tree with an engine as the source of accelerations: the classical Runge-Kutta method of order 4
// with a fixed step. The state is a unit quaternion and a rate a joint (engine.h), normalised after each step: no rotation
// vector is integrated, so that nothing of the library's chart is in it.
#pragma once
#include "loads.h"

namespace yardstick {

// A point [m] for each tip and frame: frames[k][tip], frame 0 the start, k / fps seconds later.
using Track = std::vector<std::vector<Vec3>>;

// From the drawn tree at rest, frames + 1 of them, `steps` steps a frame. The tips' points are the far ends (0, 0, length)
// of the bodies named.
Track integrate(Engine&, const Tree&, const bough::Scene&, const std::vector<std::size_t>& tips, int frames, double fps,
                int steps);

// The largest |a - b| over frames and tips, relative to the root mean square of b's |x(t) - x(0)| over both.
double track_difference(const Track& a, const Track& b);

} // namespace yardstick
