// ground_course.h: what a moving ground (root_motion.h) does over one step, whatever it does within it.
//
// All quantities are at the pivot, world. The ground's acceleration is replaced by a + slope (t/h - 1/2): the linear function of time with the same
// integral, which is the change of velocity, and the same integral of that:
//   a = (v_1 - v_0) / h,   slope = 12/h ((v_0 + v_1)/2 - moved/h)
// So places and velocities at both ends are met, whatever happens in between: the motion is the cubic through them. Where the step resolves the
// motion, slope is the change of the acceleration. A jump within the step becomes the pair of impulses that it is. alpha and its slope are found
// likewise, with the integral of omega for `moved`. With phi the rotation vector of R_1 R_0^T (of the many, the one nearest to the mean omega times
// h) that integral is phi + h^2/12 omega_0 x omega_1 to fourth order (Magnus).
// jumps: the step does not resolve the motion. slope, or slope_turn, should be the difference of the accelerations at both ends. The step jumps if it
// is off by more than 1/32 of their sum (for an oscillation: with less than four steps a period), and by more than rounding: a millionth of the way.
#pragma once
#include "../model/root_motion.h"

namespace bough {

struct GroundCourse {
    Ground start, end;
    Vec3 turned;                      // [rad] phi
    Vec3 v_0, v_1;                    // [m/s] of the pivot
    Vec3 a, slope, alpha, slope_turn; // [m/s^2], [rad/s^2]
    bool jumps;
};

// Returns the course from t for h > 0 [s]. O(log keys).
GroundCourse ground_course(const RootSpline&, double t, double h);

} // namespace bough
