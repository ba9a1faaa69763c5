// posed_tree.h: a tree drawn as it stands in a run. A pose that was reached under forces becomes the tree's own (§9 of the paper).
//
// Each joint's frame is turned by its angle, R_pj' = R_pj exp(theta), so theta = 0 puts every body where it is now. With pose drawn (pose.h) the new
// tree is in equilibrium there under gravity alone, exactly, whatever forces led to it: its springs' rest is made anew from its weight. With pose
// rest or settled the springs are unloaded there. Roots stand where their ground has carried them. What lay on the tree (Tree::load) becomes its own
// mass. Stiffness, damping and all else stay as they are in `tree`: without the scene's stiffness_scale and damping_scale, which make_plan takes from
// the scene.
// Reads   R_pj of the plan; theta, ground of a state of it that is up to date (present()); tree: what the plan was made of.
// Cost    O(bodies). Errors none; all of the tree must still be there (World::broken).
#pragma once
#include "plan.h"
#include "state.h"

namespace bough {

template <class T> Tree posed_tree(const Plan<T>&, const State<T>&, Tree tree);

} // namespace bough
