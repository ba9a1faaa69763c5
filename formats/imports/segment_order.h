// segment_order.h: segments put into an order in which those that stand side by side lie close together.
#pragma once
#include "lib/base/math.h"
#include "line_segment.h"
#include <vector>

namespace bough {

// Large pieces (512 segments and more) one after another, each begun at a multiple of 64 and the gaps filled by segments of
// point -1, so that few blocks hold parts of several. Before them all others. Each by size, in classes of a factor of
// 32768, within one along a Morton curve. Arguments as of SegmentSearch (nearest_segment.h). O(segments), 36 bytes each while it works.
void sort_by_place(const std::vector<Vec3>& point, const std::vector<double>& radius, std::vector<LineSegment>&,
                   std::size_t pieces);

} // namespace bough
