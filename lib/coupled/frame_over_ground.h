// frame_over_ground.h: a body's place over the ground, in the frames of those sweeps that are compiled for a wind that varies there. The other
// sweeps' frames have no such members, since members that are never read cost registers all the same (measured: 3 % of the instructions).
#pragma once
#include "../lanes/wide.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

template <class W, bool field> struct FrameOverGround {};
template <class W> struct FrameOverGround<W, true> {
    W x, z; // [m]
};

} // namespace BOUGH_TARGET
} // namespace bough::fast
