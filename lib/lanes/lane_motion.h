// lane_motion.h: the angles and rates of bodies where rows hold them, as a stepper shows them.
#pragma once
#include "../plan/stepper.h"
#include "lanes.h"

namespace bough::fast {

template <class... Arrays> void give_back(Arrays&... arrays) {
    (Arrays().swap(arrays), ...);
}

// Rows of `count` quantities each, and where each row's quantities stand.
inline std::vector<std::size_t> even_rows(const Layout& layout, std::size_t count) {
    std::vector<std::size_t> at(layout.rows);
    for (std::size_t row = 0; row < at.size(); ++row) at[row] = row * count;
    return at;
}

// Fills in the view, except where each row's quantities stand. theta is a row's quantity 0.
template <class T>
void view_rows(const PlannedLanes<T>& planned, const RowVector<T>& rows, int theta_dot, MotionView<T>& view) {
    view.theta = rows.front().lane;
    view.theta_dot = view.theta + theta_dot * Row<T>::lanes;
    view.stride = view.lanes = Row<T>::lanes;
    view.slot = planned.layout.slot.data();
}

} // namespace bough::fast
