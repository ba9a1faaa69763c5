// up_axis.h: which axis is up in a file that does not say so, from wood that has no root yet.
#pragma once
#include "import.h"
#include "nearest_segment.h"

namespace bough {

// 'y' or 'z': the one of the two that the thickest wood (half the largest radius and more) follows more closely; where
// no radii tell, along which the wood as a whole (the middle of its segments, weighed by length) lies more exactly above
// the lowest point along that axis. O(segments).
char likely_up(const std::vector<Vec3>& point, const std::vector<double>& radius, const std::vector<LineSegment>&);

// Notes what likely_up() chose, and by what.
void note_guessed_up(char up, ImportNotes&);

} // namespace bough
