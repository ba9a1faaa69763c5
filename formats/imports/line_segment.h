// line_segment.h: a straight part of a piece of wood, between two points of a list.
#pragma once
#include <cstdint>

namespace bough {

struct LineSegment {
    std::int32_t a = -1, b = -1; // points
    std::int32_t piece = -1;     // what it is part of
};

} // namespace bough
