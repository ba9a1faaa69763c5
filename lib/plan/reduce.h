// reduce.h: joins a tree's rigid bodies (Tree::rigid) with what they hang on: the same wood on fewer joints. What moves is simulated on the reduced
// tree. expand.h gives all bodies their poses back.
//
// Groups. Each body that is not rigid leads a group, whose frame is its own. A rigid body joins its parent's group, held as it is drawn. A rigid root
// and what is rigid on it stand still: they are not simulated, and what moves on them is a root of the reduced tree, with its joint at its place in
// the world. Groups stand in the order of their leaders, a parent's before its children's.
//
// What turns about each joint is exact: sums over the bodies give its composite's first moment and inertia about the joint. Joint, stiffness,
// damping, branch, level and s are the leader's. So statics under gravity and pulls are those of the whole tree with those joints held, and so are
// its dynamics in vacuo. (Tree::load is summed too, and lies at the group's centre of mass.)
//
// In the air a group is one body, whose force stands for the sum of its bodies' (air.h). A cylinder along the leader and a sphere are fitted. The
// drag area of each is the one nearest to the sum over the directions of the wind: least squares over 64 directions that are even over the sphere;
// where the wind has one mean direction, those near it count, by the eighth power of the cosine. The fit with the smaller remaining difference is
// taken. Bodies parallel to the leader give the cylinder of their summed areas, exactly. Kind and size tell which fit was taken: size is (reach of
// the leader's branch, radius, radius), as a branch's, and where Tree::rigid is round_to_air the air meets a sphere of that radius (kind_in_air). The
// air's force acts at the centre of mass. A mass at the joint turns nothing about it and moves with what the group hangs on, so it may belong to
// either. A group gives as much of such mass to what it hangs on (a root: to the ground) as moves its own centre of mass out to the centre of its
// drag areas, as far along as that is and its inertia allows. So masses and centres of mass are not the wood's own, and bodies that bear groups are
// heavier at their ends. A body that neither is a group nor bears one is the whole tree's, bit by bit.
// Left out: that leaves in groups fold with the wind; force across the wind of bodies that are not parallel; what turning adds to the damping of
// bodies away from the centre; that leaves in groups would give way to the wind; and for these (23)'s second term and (24) of /leaves.
// A cherry of 20 000 bodies was run with levels 0 to 1 or 0 to 2 moving for 10 s. The RMS error of its tips, over that without these two measures
// (only a sphere's mean over all directions, at the centre of mass), was 0.85 to 0.92 bare in calm, breeze and gusty; in leaf 0.64 to 0.97, in breeze
// 1.1.
#pragma once
#include "../model/scene.h"
#include "reduced.h"
#include <optional>

namespace bough {

// plate_kappa: of leaves and petals, where the scene has its own (air.h). toward: the wind's mean direction; zero: none. Reads a checked tree. O(n).
// Errors none.
Reduced reduce(const Tree& whole, const std::vector<TreeRange>& ranges, double plate_kappa,
               const Vec3& toward = Vec3::Zero());
Reduced reduce(const Tree& whole, const std::vector<TreeRange>& ranges, const Scene&);

// Returns the same place on the reduced tree; none where it stands still.
std::optional<Selector> selector_on(const Reduced&, const Selected& in_whole);

// Returns the scene for the reduced tree. What its pulls select becomes points of bodies there. A pull on a level becomes one for each of its bodies.
// A pull at a part that stands still is left out. Attachments are treated likewise. Nothing else that a scene may have beside rigid parts selects
// bodies. Throws std::out_of_range as select() does.
Scene scene_on(const Reduced&, const Tree& whole, Scene);

} // namespace bough
