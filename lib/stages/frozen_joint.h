// frozen_joint.h: what a joint keeps between its refreshments (frozen.h).
#pragma once
#include "../model/math.h"

namespace bough {

template <class T> struct FrozenJoint {
    Matrix3<T> U;              // [1/sqrt(kg m^2)] modes, in body axes
    Vector3<T> E, B, carry, C; // of each mode
    T J[6] = {}; // [kg m^2] xx xy xz yy yz zz of the composite when they were made, in the parent's axes; 0: none yet
    T gravity = 0, wind = 0; // [kg m^2] what gravity and the air then added, times h^2
    T sensitivity = 0;       // [1/(kg m^2)] of the mode that feels such a change most
    static constexpr int reals = 30;
};

} // namespace bough
