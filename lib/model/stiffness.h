// stiffness.h: what a tree's bodies get from their material and size: mass, joint stiffness, damping.
//
// Branch. A joint bends as the wood around it does, from the middle of the parent's piece to the middle of its own. Its compliance about each bend
// axis is the integral of ds / (E pi r^4 / 4) over that stretch, about the twist axis that of ds / (G pi r^4 / 2), in closed form over the taper
// (below). At the ground and where a branch leaves its parent, only the child's half counts. The sag of a cantilever is then second order in the
// number n of pieces: 1 + 1 / (2 n^2) for a load at the tip of a uniform one.
// Leaf. Its length is one third petiole and two thirds blade (body_shape.h). It bends on the petiole: a round rod with a radius of 0.009 blade
// lengths and the modulus leaf_modulus. The leaf's one joint, at the petiole's foot, stands for this rod. It flaps and sways under a force at the
// blade's centre as a cantilever of length l bends with a rigid arm a beyond its end:
//   K = E I (l + a)^2 / (l^3/3 + l^2 a + l a^2),   twist E I / (4.3 l)
// 4.3 is the ratio EI/GJ of petioles measured by Louf et al., Sci. Rep. 8:16314 (2018), within the 2.7 to 8.0 of Vogel, J. Exp. Bot. 43:1527 (1992).
// As the radius is in proportion, a leaf of any size droops alike under its own weight (0.17 rad at the presets' values and a width of 0.7 of the
// length). Blades of 5 and 10 cm flap at 5.2 and 3.7 Hz and twist at 7.5 and 5.3 Hz; measured leaves flap at 2 to 6 Hz (Tadrist et al., J. R. Soc.
// Interface 15:20180010, 2018). Length and radius are typical proportions, not measured ones.
// Clump. Several leaves stand on their shoot. The shoot tapers as the leaves that it bears grow fewer. Its section at its foot is a share 1.5e-4 of
// their area (Huber value; 1e-4 to 5e-4 in temperate broadleaved trees), and its modulus is 3 GPa, as of green shoots. A force at its middle bends it
// by 0.0569 length^3 / (E I) at the foot's I, so K = 0.25 / 0.0569 E I / length; twist has half that. A clump of 30 cm sways at 4 Hz, one of 50 cm at
// 3 Hz. Narrow clumps are stiffer: held out level, none droops by more than 0.25 rad. zeta is 0.2, since the leaves brush against one another.
// Fruit. It hangs from its joint on a stalk that reaches to its skin and is at least half the fruit's radius long. The stalk is a round rod with a
// radius of 0.04 fruit radii and the same modulus and ratio.
// Damping. beta = 2 zeta / omega. omega is the first bending frequency of the joint's own branch (branch_mode.h), or of the leaf or fruit on its own
// joint; zeta is the material's for the kind. omega = 0 (no stiffness) gives beta = 0.
// All functions read and write Tree, in which kind, size, parent and branch must be set. O(bodies).
#pragma once
#include "tree.h"
#include "wood.h"

namespace bough {

// Integral of ds / r^4 over a length in which the radius goes linearly from a to b [1/m^3]:
//   l (a^2 + a b + b^2) / (3 a^3 b^3). Infinite for a radius of 0.
double integral_r4(double length, double a, double b);

// Returns the stiffness [N m/rad] of the joint between two pieces given as Tree::size (length, radius at base and tip). parent: nullptr at the ground
// and for a side branch.
Vec3 branch_stiffness(const Material&, const Vec3& piece, const Vec3* parent);
Vec3 leaf_stiffness(const Material&, double length);
Vec3 clump_stiffness(const Material&, const Vec3& size); // size: length, width, thickness
Vec3 fruit_stiffness(const Material&, double joint_to_center, double radius);

void set_mass(Tree&, const Material&);      // mass, com, inertia from kind and size
void set_stiffness(Tree&, const Material&); // stiffness
void set_damping(Tree&, const Material&);   // damping; mass and stiffness must stand

} // namespace bough
