// modes.h: a tree's natural frequencies and the shapes in which it swings at them.
//
// The lowest of K a = omega^2 M a (small_motion.h): gravity's gradient at the standing pose is in it. Lanczos's method (lanczos.h) on R^-T M R^-1,
// whose largest eigenvalues 1 / omega^2 are. Of frequencies that several modes share, each turns up once those before it are taken out.
// Damping ratio of a mode, of the shape's own motion (what damping couples it with is left out, and a shape is not bent by it):
//   zeta = a^T D a / (2 omega a^T M a),   D = wood's K beta, and with an air the derivative of its forces at rest in the mean wind
//                                         (air.h, leaf_air.h)
// Single leaves have that of their mean over their own motion in it (streaming() of air.h).
// Effective mass along a direction: (its linear momentum)^2 over a^T M a; all modes' together are at most the tree's mass, and less by what
// no turning of joints can move as a whole.
#pragma once
#include "../model/scene.h"
#include "../model/tree.h"
#include "small_motion.h"
#include <functional>

namespace bough {

struct NaturalMode {
    double frequency = 0; // [Hz]
    double damping = 0;   // [1] zeta
    double wood = 0;      // [1] of which the wood's
    Vec3 effective_mass;  // [kg] along x, y, z
    // [1] of the kinetic energy, a number for each level of branches and one for what hangs on them (leaves, fruit)
    std::vector<double> share;
    std::vector<Vec3> turn;   // [rad, world] of each joint, the farthest end moving by 1 m
    std::size_t farthest = 0; // whose far end that is
};

struct ModeOptions {
    int count = 20;   // fewer where the tree has fewer
    bool air = false; // the scene's wind at its mean, or still air with /leaves, damps
};

// The lowest `count` modes of the tree that `small` is of, frequencies rising; stiffness and damping as scaled by the scene already.
// progress: called now and then with the number of operations; may throw. O(n count) a restart, memory about (2 count + 40) x 24 B + 400 B a body.
// Throws std::domain_error where the iteration does not converge.
std::vector<NaturalMode> natural_modes(const SmallMotion& small, const Tree&, const Scene&, const ModeOptions&,
                                       const std::function<void(std::int64_t)>& progress = {});

// Where bodies are as the mode has swung by `amplitude` [m] of its farthest end, joints turning about their axes by the shape: positions of joints
// and rotations, world from body.
struct ShapePose {
    std::vector<Vec3> position;
    std::vector<Quat> rotation;
};
ShapePose swung(const SmallMotion&, const Tree&, const NaturalMode&, double amplitude);

// What of a mode's shape one branch has, and what hangs on it.
struct BranchMotion {
    std::int32_t branch = -1, level = 0;
    Vec3 way = Vec3::Zero(); // [1] of its end of a body that moves farthest, over the way of the mode's farthest end
    double share = 0;        // [1] of the kinetic energy
};
// The `most` branches with the largest shares, falling. O(n).
std::vector<BranchMotion> moving_branches(const SmallMotion&, const Tree&, const NaturalMode&, std::size_t most);

// How a tree as a whole sways along a horizontal direction. Lanczos' method from the bend that a steady push of that direction on all of its mass
// gives it, 24 steps, O(n) each: its values are the modes that the bend is made of, each with its share of the bend's energy. In a crown of many
// alike branches no one mode sways; what stands out is then a band of modes, which so few steps show as one.
struct Sway {
    double frequency = 0; // [Hz] of what has most of the bend
    double share = 0;     // [1] of its energy
    double lowest = 0;    // [Hz] of the lowest in it
};
Sway sway_along(const SmallMotion&, const Vec3& direction);

} // namespace bough
