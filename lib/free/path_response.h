// path_response.h: how bodies of a tree that are met in a step answer impulses on them, with all contacts seeing each other's.
//
// A contact concerns the joints on the body's way to the root and no others. These are gathered once a step, with the matrices of response.h turned
// to the world's axes. Two products a joint then tell what the impulses do:
//   inward   a moment u and a force f about a joint: e += E u; handed on are the moment u - A E u and the force f - B^T E u
//   outward  v = v_p + omega_p x r, omega = omega_p + e - E A omega_p - E B v
// (A + Z) E = 1, so u - A E u is Z E u. In the analytic step E A and E B are zero: u and f go on whole.
// Reads    poses and angles as the step leaves them, a TreeResponse with springs and one without.
// Cost     752 bytes and about a microsecond a joint to gather; an impulse or a velocity 27 multiplications a joint on the way; the mobility of
//          a point about eight of these, and several threads may ask for it at once.
#pragma once
#include "response.h"
#include <span>

namespace bough {

class PathResponse {
public:
    // Takes the bodies named (-1: the ground, which has no way). Contact k is the k-th of them in all that follows.
    template <class T>
    PathResponse(const Plan<T>&, TreePoses<T>&, const TreeResponse<T>& sprung, const TreeResponse<T>& rigid,
                 std::span<const std::int64_t> bodies);

    // Forgets all impulses.
    void forget_impulses();
    // Applies an impulse [N s] at a point [m] of contact k's body, world.
    void apply_impulse(std::size_t k, const Vec3& point, const Vec3& impulse);
    // Applies what each joint's own spring and damper do in the step: -h K (theta + (h + beta) theta_dot) on the body, the opposite on its parent.
    void apply_springs();
    // Returns how the impulses so far change the point's velocity [m/s].
    Vec3 velocity(std::size_t k, const Vec3& point) const;
    // Returns the velocity of the point by a unit impulse there [1/kg], without the impulses so far. It is with springs, or as in a step of no
    // length, in which they do nothing.
    Mat3 mobility(std::size_t k, const Vec3& point, bool sprung) const;

private:
    struct Answer { // world axes
        Mat3 E, EA, EB;
    };
    struct Link { // what every round reads
        Answer answer;
        Vec3 x; // [m] the joint
        Vec3 e; // [rad/s] E u of the impulses so far
    };
    // A contact's joints from the root outward, as places in link_.
    std::span<const std::uint32_t> path(std::size_t k) const {
        return std::span(path_).subspan(first_[k], first_[k + 1] - first_[k]);
    }

    bool coupled_ = true;
    std::vector<Link> link_; // parents first
    std::vector<Answer> rigid_;
    std::vector<Vec3> spring_; // [N m s] world, on the body
    std::vector<std::int32_t> parent_;
    std::vector<std::uint32_t> path_;
    std::vector<std::size_t> first_;
};

} // namespace bough
