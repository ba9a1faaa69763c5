// plain_stepper.h: the common part of steppers that keep a state where others read it, in arrays in document order.
#pragma once
#include "state_update.h"

namespace bough {

template <class T> class PlainStepper : public Stepper<T> {
public:
    using Stepper<T>::Stepper;
    void begin(const Plan<T>& plan, State<T>& state, const std::vector<Vector3<T>>&) const override {
        update_kinematics(plan, state);
    }
    void view_motion(const State<T>& state, MotionView<T>& view) const override {
        view = {state.theta.front().data(), state.theta_dot.front().data(), 1, nullptr, 1, std::move(view.first)};
    }
};

} // namespace bough
