// frozen_rule.h: numbers of the rule by which frozen coefficients are refreshed (frozen.h). By themselves, so that the SIMD sweeps, which know
// nothing of Eigen, read the same.
#pragma once

namespace bough {

// The tolerance that the tools take, of the composite's turn [rad] and its like.
constexpr double default_refresh = 0.05;

// Of the tolerance: what h^2 times a change of stiffness, or h times one of damping, may be of 1 + |lambda| h^2 + b h.
constexpr double frozen_load_share = 3;

} // namespace bough
