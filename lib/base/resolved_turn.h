// resolved_turn.h: the part of an angular velocity that a step of h still resolves: a radian in the step.
#pragma once
#include "math.h"

namespace bough {

// Returns omega or, where it turns by more than a radian in h, its direction at that rate. `count` goes up where it does.
template <class T> Vector3<T> resolved_turn(const Vector3<T>& omega, T h, std::uint64_t& count) {
    const T turn = h * omega.norm();
    if (!(turn > 1)) return omega;
    ++count;
    return omega / turn;
}

} // namespace bough
