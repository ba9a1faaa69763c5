// expand.h: all bodies of a tree from a state of its reduced one (reduce.h): each rigid body follows its group as it is drawn on it, what stands
// still its ground.
//
// Its joint has turned by nothing: theta and theta_dot are 0. What torque it passes on is not known without the accelerations of all that it
// carries: 0 too, as the stress of it.
#pragma once
#include "../model/motion.h"
#include "plan.h"
#include "reduce.h"
#include "state.h"

namespace bough {

// World from body, and its joint [m].
struct WholePose {
    Mat3 R;
    Vec3 x;
};
// Of a body of the whole tree. Needs the state's poses up to date. O(trees) for what stands still, else O(1).
template <class T> WholePose whole_pose(const Reduced&, const Plan<T>&, const State<T>&, std::size_t body);

// A frame of the reduced tree, as filled from this state, becomes one of the whole tree: its arrays grow in place. O(bodies of the whole tree).
// whole: centres of mass are read of it, for velocities. Allocates nothing once the frame's arrays have grown.
template <class T> void expand_frame(const Reduced&, const Tree& whole, const Plan<T>&, const State<T>&, MotionFrame&);

} // namespace bough
