// branch_mode.h: the first bending and twisting mode of each branch by Rayleigh's quotient, and what the analytic step
// takes from it: a frequency per branch, an inertia factor and a weight per joint.
//
// A branch is taken straightened along its arc and clamped where it leaves its parent. Its pieces rigidly carry the side branches, leaves and fruit
// that grow on them. Piece k with what it carries is a lump about its own joint: mass m_k, first moment h_k along the branch, inertia j_k across it
// and t_k about it. When the joints k turn at rates kappa_k, joint j feels the angular momentum sum_k M_jk kappa_k, with M the branch's joint-space
// mass matrix. The trial shape is the static one: kappa_k = (moment at k under a sideways acceleration) / K_k, which is H_k / K_k with H_k the first
// moment of all that is outboard. For twist it is (inertia about the branch of all that is outboard) / K_z.
//
//   omega^2 = sum_k K_k kappa_k^2 / sum_jk kappa_j M_jk kappa_k            (Rayleigh's quotient, an upper bound)
//   f_j     = sum_k M_jk kappa_k / (M_jj kappa_j)                          >= 1, as every M_jk is positive here
//
// A joint that turns by itself with the inertia f_j M_jj rings at the branch's first frequency wherever kappa is the first mode. So cutting a branch
// into more pieces does not raise its frequency; with M_jj alone it rises as the root of their number. M and both sums take one forward and one
// backward sweep of scalars. O(n). A branch with a free joint (K = 0) has omega 0 and the trial shape kappa = 1. A leaf or fruit is a branch of one
// joint: its factor is 1, its frequency that of its softer bending axis.
// Reads Tree (drawn pose). Writes one entry per body. Errors none.
#pragma once
#include "tree.h"
#include <vector>

namespace bough {

struct BranchModes {
    std::vector<double> omega_bend;   // [rad/s] first bending frequency of the body's branch
    std::vector<double> omega_twist;  // [rad/s] first twisting frequency, likewise
    std::vector<double> factor_bend;  // [1] f_j for bending
    std::vector<double> factor_twist; // [1] f_j for twist about the branch
    std::vector<double> weight; // [rad/m] u_j = kappa_j over the deflection of the branch's tip in its trial shape
};

BranchModes branch_modes(const Tree&);

} // namespace bough
