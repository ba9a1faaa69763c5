// pose.h: the springs' rest pose and the start angles, for the three ways a scene can mean its drawn tree (scene.h).
//
// drawn    The drawn tree is the equilibrium. Each joint frame is turned back, R_pj = R_drawn exp(-theta), and starts at theta with K theta = J^T tau
//          (spring.h). tau is the moment of gravity on the drawn composite in the body's drawn frame, J = J(theta) the body rates of theta. The
//          positions do not change, so the joints are independent: this takes one backward sweep and a 3x3 Newton iteration a joint. It is exact to
//          rounding.
// settled  The drawn tree is unloaded; theta is its sag (sag.h). A branch that buckles under its own weight is refused, with its name.
// rest     The drawn tree is unloaded and the run starts from it: theta = 0.
// Load. With Tree::load (static_load.h) `drawn` means the tree without it. The springs' rest is the one that carries the drawn tree less its load.
// The start is the sag of these springs under all of it, as for `settled`, found from the drawn pose on. A twig that buckles under its load goes
// over. Where Newton's steps from there do not end in a stable sag, they are made downhill in energy (indefinite blocks lifted, steps halved until it
// falls), and then do. Newton's matrix decides what is stable. It leaves out how T turns with theta, so for joints turned by half a radian and more
// it may misjudge a mode next to neutral. `settled` and `rest` treat the load as any other weight.
// Each root's tree finds its sag by itself. Reads a checked tree (K as scaled by the scene). Cost O(n) (settled: O(n) an iteration, about 5 to 50).
// Throws NoStart, which names body and branch: for drawn with K = 0 under load or no solution within half a turn, and for settled without
// convergence.
#pragma once
#include "../model/scene.h"
#include "../model/tree.h"
#include "start_pose.h"
#include <cstdint>
#include <stdexcept>
#include <string>

namespace bough {

struct NoStart : std::domain_error {
    NoStart(std::size_t body, std::int32_t branch, const std::string& why);
    std::size_t body;
    std::int32_t branch;
    std::string why; // what() without "body B of branch b"
};

StartPose start_pose(const Tree&, const Vec3& gravity, Pose);

} // namespace bough
