// expand.h: all bodies of a tree from a state of its reduced tree (reduce.h). Each rigid body follows its group as drawn on it; what stands still
// follows its ground.
//
// A rigid body's joint does not turn: its theta and theta_dot are 0. The torque that it passes on is unknown without the accelerations of all that it
// carries, so torque and stress are 0 too.
#pragma once
#include "../model/motion.h"
#include "plan.h"
#include "reduce.h"
#include "state.h"

namespace bough {

// The rotation world from body, and the body's joint [m].
struct WholePose {
    Mat3 R;
    Vec3 x;
};
// Returns the pose of a body of the whole tree. Needs the state's poses up to date. O(trees) for what stands still, else O(1).
template <class T> WholePose whole_pose(const Reduced&, const Plan<T>&, const State<T>&, std::size_t body);

// Makes a frame of the reduced tree, as filled from this state, one of the whole tree: its arrays grow in place. whole: its centres of mass are read,
// for velocities. O(bodies of the whole tree). Allocates nothing once the frame's arrays have grown.
template <class T> void expand_frame(const Reduced&, const Tree& whole, const Plan<T>&, const State<T>&, MotionFrame&);

} // namespace bough
