// spring_load.h: what a joint of spring.h starts its step with.
#pragma once
#include "../base/math.h"

namespace bough {

// One joint at the start of its step, in the axes of its body.
template <class T> struct SpringJoint {
    Matrix3<T> T_tb;       // rates of theta from the body's: J^-1
    Vector3<T> residual_b; // [N m] tau - T^T K theta
    Matrix3<T> K_b, KG_b;  // [N m/rad] T^T K T, and with gravity's gradient
    Vector3<T> held_b;     // [N m] of tau, what is held constant over the step: all but gravity
    Vector3<T> g_b, h_b;   // [m/s^2], [kg m] gravity and the composite's first moment
};

} // namespace bough
