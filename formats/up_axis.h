// up_axis.h: which axis is up in a file that does not say so, from wood that has no root yet.
#pragma once
#include "nearest_segment.h"
#include <string>

namespace bough {

// 'y' or 'z': the one of the two that the thickest wood (half the largest radius and more) follows more closely; where
// no radii tell, along which the wood as a whole (the middle of its segments, weighed by length) lies more exactly above
// the lowest point along that axis. O(segments).
char likely_up(const std::vector<Vec3>& point, const std::vector<double>& radius, const std::vector<Segment>&);

// What likely_up() goes by, for a note.
inline std::string up_note(char up) {
    return std::string("up axis: the file states none; taken as ") + char(up - 'a' + 'A') +
           ", which the thickest wood, or without radii all of it, stands along more upright (--up overrides)";
}

} // namespace bough
