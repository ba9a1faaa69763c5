// lanes_stepper.h: the common part of steppers whose steps are made in lanes. Angles, rates and what else is carried stand in rows. The state's
// arrays in document order are made of them where somebody reads them.
#pragma once
#include "../plan/state_update.h"
#include "lane_motion.h"

namespace bough::fast {

template <class T> class LanesStepper : public Stepper<T> {
public:
    using Stepper<T>::Stepper;
    virtual const PlannedLanes<T>& lanes() const = 0;

    void begin(const Plan<T>& plan, State<T>& state, const std::vector<Vector3<T>>& theta) const final {
        update_kinematics(plan, state);
        pack_rows(plan, state, theta);
        if (plan.pose) return;
        give_back(state.theta, state.theta_dot); // present() makes them again, as what is carried
        for (const CarriedArray<T>& carried : this->carried(state)) give_back(*carried.array);
        lanes_of(state).presented = false;
    }
    void present(const Plan<T>& plan, State<T>& state) const final {
        Lanes<T>& lanes = lanes_of(state);
        if (lanes.presented) return;
        unpack_rows(plan, state);
        lanes.presented = true;
        if (plan.pose) update_kinematics(plan, state);
    }
    std::optional<NonFinite> non_finite(const Plan<T>& plan, State<T>& state) const final {
        return lanes_of(state).finite ? std::nullopt : Stepper<T>::non_finite(plan, state);
    }

protected:
    virtual Lanes<T>& lanes_of(State<T>&) const = 0;
    // Fill the rows from theta [rad] and the state's arrays, zero where one is left out, and go back. O(n).
    virtual void pack_rows(const Plan<T>&, State<T>&, const std::vector<Vector3<T>>& theta) const = 0;
    virtual void unpack_rows(const Plan<T>&, State<T>&) const = 0;
};

} // namespace bough::fast
