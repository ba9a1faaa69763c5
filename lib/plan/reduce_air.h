// reduce_air.h: the part of reduce.h that the air asks for: where groups have their centre of mass, and as which shape they meet the wind.
#pragma once
#include "reduced.h"

namespace bough {

// Calls visit(body, group) for the bodies of groups of more than one.
template <class Visit> void each_joined(const Reduced& r, const std::vector<std::uint8_t>& joined, Visit&& visit) {
    for (std::size_t i = 0; i < r.body.size(); ++i)
        if (r.body[i] >= 0 && joined[std::size_t(r.body[i])]) visit(i, std::size_t(r.body[i]));
}

// joined: 1 for groups of more than one body. The others stay as they are, except for mass that groups on them give away. Both functions read the
// places of bodies and write r.tree: the first mass, com and inertia, the second size and rigid.
void center_on_pressure(const Tree& whole, Reduced&, const std::vector<std::uint8_t>& joined, double plate_kappa);
void fit_air(const Tree& whole, Reduced&, const std::vector<std::uint8_t>& joined, double plate_kappa,
             const Vec3& toward);

} // namespace bough
