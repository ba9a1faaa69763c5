// wide_leaf.h: leaf_air.h in lanes. Called for scenes with /leaves alone; never inlined into a sweep, which is then the same code for all others.
// Written a second time: registers have no Eigen, symmetric matrices are six numbers, and sums stand in the order that can be fused.
// tests/lib/coupled/lanes.cpp and tests/lib/analytic/lanes.cpp hold the two together.
#pragma once
#include "../laws/leaf_terms.h"
#include "wide_pair.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

// k
template <class T, class W> BOUGH_FORCE W leaf_lever(const LeafTerms<T>& terms, const W& drag_area) {
    return terms.torque * drag_area * root(drag_area);
}

// The torque but for nu I w, n the normal.
template <class T, class W>
BOUGH_FORCE V3<W> leaf_torque(const LeafTerms<T>& terms, const W& lever, const V3<W>& n, const V3<W>& u) {
    const V3<W> turning = cross(n, u);
    return W(lever * dot(u, n)) * (terms.cos_offset * turning + terms.sin_offset * cross(n, turning));
}

// Of the resistance.
template <class T, class W>
BOUGH_FORCE Symmetric<W> leaf_damping(const LeafTerms<T>& terms, const W& mass, const V3<W>& n) {
    const W along = terms.along * mass, more = (terms.across - terms.along) * mass;
    const V3<W> m = more * n;
    return {along + m.x * n.x, m.x * n.y, m.x * n.z, along + m.y * n.y, m.y * n.z, along + m.z * n.z};
}

// weight (1 - n n^T)
template <class W> BOUGH_FORCE Symmetric<W> across(const W& weight, const V3<W>& n) {
    const V3<W> m = weight * n;
    return {weight - m.x * n.x, -m.x * n.y, -m.x * n.z, weight - m.y * n.y, -m.y * n.z, weight - m.z * n.z};
}

// rate I; J: inertia about the joint, c: the centre of mass from there.
template <class W>
BOUGH_FORCE Symmetric<W> spin_damping(const W& rate, const W& mass, const Symmetric<W>& J, const V3<W>& c) {
    const V3<W> mc = mass * c;
    const W xx = mc.x * c.x, yy = mc.y * c.y, zz = mc.z * c.z;
    return rate * Symmetric<W>{J.xx - yy - zz, J.xy + mc.x * c.y, J.xz + mc.x * c.z,
                               J.yy - xx - zz, J.yz + mc.y * c.z, J.zz - xx - yy};
}

} // namespace BOUGH_TARGET
} // namespace bough::fast
