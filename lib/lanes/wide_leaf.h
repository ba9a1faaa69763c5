// wide_leaf.h: leaf_air.h in lanes: all that the sweeps of both steps and of the energy guard take from it. It is called only for scenes with
// /leaves. What uses it is never inlined into a sweep, which is then the same code for all others. It is written a second time because registers have
// no Eigen, symmetric matrices are six numbers, and sums stand in the order that can be fused. tests/lib/coupled/lanes.cpp and
// tests/lib/analytic/lanes.cpp hold the two together.
#pragma once
#include "../laws/leaf_terms.h"
#include "wide_pair.h"

namespace bough::fast {
inline namespace BOUGH_TARGET {

// What the law takes of bodies.
template <class W> struct LeafBody { W mass, drag_area; };

// k
template <class T, class W> BOUGH_FORCE W leaf_lever(const LeafTerms<T>& terms, const LeafBody<W>& body) {
    return terms.torque * body.drag_area * root(body.drag_area);
}

// The torque without nu I w. n: the normal.
template <class T, class W>
BOUGH_FORCE V3<W> leaf_torque(const LeafTerms<T>& terms, const LeafBody<W>& body, const V3<W>& n, const V3<W>& u) {
    const V3<W> turning = cross(n, u);
    return W(leaf_lever(terms, body) * dot(u, n)) * (terms.cos_offset * turning + terms.sin_offset * cross(n, turning));
}

// The force's damping.
template <class T, class W>
BOUGH_FORCE Symmetric<W> leaf_damping(const LeafTerms<T>& terms, const LeafBody<W>& body, const M3<W>& R,
                                      const V3<W>& /*u*/) {
    const V3<W>& n = R.y;
    const W along = terms.along * body.mass, more = (terms.across - terms.along) * body.mass;
    const V3<W> m = more * n;
    return {along + m.x * n.x, m.x * n.y, m.x * n.z, along + m.y * n.y, m.y * n.z, along + m.z * n.z};
}

// The force with the drag of the velocity ahead. D: leaf_damping at the same u.
template <class T, class W>
BOUGH_FORCE V3<W> leaf_force(const LeafTerms<T>&, const LeafBody<W>&, const M3<W>&, const V3<W>& u, const V3<W>& ahead,
                             const Symmetric<W>& D) {
    return D * (u + ahead); // it is linear
}

// weight (1 - n n^T)
template <class W> BOUGH_FORCE Symmetric<W> across(const W& weight, const V3<W>& n) {
    const V3<W> m = weight * n;
    return {weight - m.x * n.x, -m.x * n.y, -m.x * n.z, weight - m.y * n.y, -m.y * n.z, weight - m.z * n.z};
}

// arm: |com|.
template <class T, class W>
BOUGH_FORCE Symmetric<W> leaf_turning(const LeafTerms<T>& terms, const LeafBody<W>& body, const W& arm, const M3<W>& R,
                                      const V3<W>& u) {
    const W speed2 = dot(u, u);
    return across(W(2 * leaf_lever(terms, body) * speed2), R.y) +
           across(W(2 * terms.most * body.mass * arm * root(speed2)), R.z);
}

// leaf_work. speed2: |U|^2. relative: u.
template <class T, class W>
BOUGH_FORCE W leaf_work(const LeafTerms<T>& terms, const LeafBody<W>& body, T h, const W& speed2,
                        const V3<W>& /*relative*/) {
    return T(0.25) * h * terms.most * body.mass * speed2;
}

// nu
template <class T> T leaf_spin(const LeafTerms<T>& terms) {
    return terms.across;
}

// The leaf's share of parted_air.h, in the body's own axes. arm: at which torques are taken.
template <class W> struct PartedLeaf {
    V3<W> force, taken;       // [N] on the body at rest, and minus what its motion changes of that
    V3<W> at_rest, in_motion; // [N m] about the centre of mass: of the body at rest, and as it goes
    W drag, wind, turn;
};
template <class T, class W>
BOUGH_FORCE PartedLeaf<W> parted_leaf(const LeafTerms<T>& terms, const LeafBody<W>& body, const W& per_arm,
                                      const V3<W>& still, const V3<W>& moving) {
    const V3<W> n{W{}, all(T(1)), W{}}, v = still - moving;
    const W along = terms.along * body.mass, across = terms.across * body.mass;
    PartedLeaf<W> leaf;
    leaf.force = {along * still.x, across * still.y, along * still.z};
    leaf.taken = {along * v.x, across * v.y, along * v.z};
    leaf.at_rest = leaf_torque(terms, body, n, still);
    leaf.in_motion = leaf_torque(terms, body, n, moving);
    const W speed = root(dot(still, still)), resisted = terms.most * body.mass,
            pressed = leaf_lever(terms, body) * per_arm;
    leaf.drag = resisted + pressed * (root(dot(moving, moving)) + speed);
    leaf.wind = resisted;
    leaf.turn = 2 * speed * (resisted + pressed * speed);
    return leaf;
}

// rate I. J: inertia about the joint. c: the centre of mass from there.
template <class W>
BOUGH_FORCE Symmetric<W> spin_damping(const W& rate, const W& mass, const Symmetric<W>& J, const V3<W>& c) {
    const V3<W> mc = mass * c;
    const W xx = mc.x * c.x, yy = mc.y * c.y, zz = mc.z * c.z;
    return rate * Symmetric<W>{J.xx - yy - zz, J.xy + mc.x * c.y, J.xz + mc.x * c.z,
                               J.yy - xx - zz, J.yz + mc.y * c.z, J.zz - xx - yy};
}

} // namespace BOUGH_TARGET
} // namespace bough::fast
