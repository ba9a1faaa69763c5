// tree_poses.h: where single bodies of a tree are and how they move, worked out only for those that are asked for and what carries them.
//
// A contact or a break concerns a few bodies of a tree that may have millions, whose state stands in rows of lanes. So no array over bodies is made
// for them. Poses are kept until the next begin(). They are in double, from the angles in the run's precision.
// Cost    O(bodies on the way to the root that were not asked for yet) a body; begin: O(bodies asked for), and with lanes O(rows).
#pragma once
#include "../plan/plan.h"
#include "../plan/state.h"
#include <deque>

namespace bough {

struct BodyPose {
    Mat3 R;        // world from body
    Mat3 R_joint;  // world from joint frame
    Vec3 x;        // [m] own joint
    Vec3 omega, v; // [rad/s], [m/s] of the joint
    Vec3 at(const Vec3& point_b) const { return x + R * point_b; }
    Vec3 velocity_at(const Vec3& point) const { return v + omega.cross(Vec3(point - x)); } // world
};

template <class T> class TreePoses {
public:
    // From here on, poses are those of the state as it stands. Both arguments are kept by reference until the next begin().
    void begin(const Plan<T>&, const State<T>&);
    // The same, but the poses stay when the state moves on: all angles are copied, O(n). There are poses alone, no velocities.
    void begin_copy(const Plan<T>&, const State<T>&);
    // Returns a pose, which stays where it is until the next begin().
    const BodyPose& of(std::size_t body);
    // The same for a body that was asked for before. Several threads may call it.
    const BodyPose& known(std::size_t body) const { return pose_[place_[body]]; }
    // [rad], [rad/s] joint frame.
    Vec3 theta(std::size_t body) const;
    Vec3 theta_dot(std::size_t body) const;

private:
    void add(std::size_t body);

    const Plan<T>* plan_ = nullptr;
    double time_ = 0;
    std::vector<std::uint32_t> place_; // in pose_, 0: not yet
    std::deque<BodyPose> pose_;
    std::vector<std::size_t> body_, path_;
    MotionView<T> motion_;
    std::vector<Vector3<T>> copy_; // of theta; empty without
};

} // namespace bough
