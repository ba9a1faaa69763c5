// fracture.h: joints that break (§6, §8).
//
// A joint breaks when the torque of its spring and damper, |T^T K (theta + beta theta_dot)|, T = J^-1 (scene.h), is above its threshold at a step's
// end. What it carried then leaves the tree as one rigid body of the bodies as they stand. What hangs beyond another joint that broke in the same
// step leaves by itself. The piece's velocity and angular velocity keep the linear and angular momentum of its bodies:
//   v = sum m_b v_b / m,   omega = I^-1 sum (I_b omega_b + m_b (c_b - c) x (v_b - v))
// The motion of its joints against each other is lost with their springs. The tree keeps its rates; its composite masses and moments are less by what
// left. In the plan, a body that has left has no mass, and nothing moves it (Stepper::drop): theta = 0. Factors of inertia and weights of the
// analytic step (spring.h, drag.h) stay those of the whole tree.
#pragma once
#include "free_body.h"
#include "response.h"

namespace bough {

struct Breakable {
    std::uint32_t body;
    double torque; // [N m] above which it breaks
};

// Returns the joints that have a threshold, by the scene's kinds, strength, selectors and seed; rising. Throws std::out_of_range for a selector that
// names no body. O(n).
std::vector<Breakable> breakable_joints(const Tree&, const std::vector<TreeRange>&, const Fracture&);

// Returns |T^T K (theta + beta theta_dot)| [N m].
double spring_torque(const Vec3& theta, const Vec3& theta_dot, const Vec3& K, double beta);

// Returns what hangs on `joints` (rising: the joints that broke), one free body each. The state's poses are those of `poses`; there are drag areas if
// the plan has wind.
template <class T>
std::vector<FreeBody> pieces_of(const Plan<T>&, const Tree&, const Subtrees&, TreePoses<T>&,
                                const std::vector<std::uint32_t>& joints);

// What is still on the tree. It is in double, since a leaf's mass is below the resolution of a float that holds a tree's.
struct Remaining {
    std::vector<double> c_mass;     // [kg] (1)
    std::vector<Vec3> moment;       // [kg m] that a body's turning moves (carried.h), where the solver reads it
    std::vector<std::uint8_t> gone; // of each body
};
template <class T> Remaining whole_tree(const Plan<T>&, const Tree&);

// Takes what the joints (rising) carry out of plan and state. The same calls in the same order leave the same bits. O(bodies that leave + bodies on
// the joints' ways to the root + rows of lanes).
template <class T>
void detach(Plan<T>&, State<T>&, const Subtrees&, const std::vector<std::uint32_t>& joints, Remaining&);

} // namespace bough
