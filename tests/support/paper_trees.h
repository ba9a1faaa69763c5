// paper_trees.h: the two small trees that solvers are compared on, each with Young's modulus E [Pa] and beta [s] given.
//
// chain(E, beta)      20 solid cylinders of 0.2 m, radius 30 mm falling geometrically to 3 mm, tilted 45 degrees from the
//                     vertical towards +x, the first joint on the ground
// branched(E, beta)   21 bodies: a trunk of 6 rods of 0.3 m, radius 30 mm less 2.5 mm a rod, tilted 0.1 rad; three branches
//                     of 5 rods (0.1 m and 0.02 m more a rod, radius 12 mm falling geometrically to 3 mm), the first two on
//                     the tip of the trunk's last rod, the third on that of its fourth; branch b leaves at 0.7 + 0.2 b rad
//                     and azimuth 2.1 b, each further rod is tilted 0.1 rad at azimuth 0.5
// Both of density 800 kg/m^3, with K = E pi r^4 / (4 l) on all three axes. A tilt by a at azimuth p is a turn by p about z,
// then by a about the new y. tips() are the bodies whose far ends are compared.
#pragma once
#include "tests/support/make_tree.h"

namespace paper_trees {

using bough::Quat;
using bough::Tree;
using bough::Vec3;

inline make_tree::Wood wood(double E, double beta) {
    return {800, E, E / 2, beta}; // the shear modulus that makes add_piece's twist equal to its bend
}

inline Quat tilt(double angle, double azimuth) {
    return make_tree::turn(azimuth, Vec3::UnitZ()) * make_tree::turn(angle, Vec3::UnitY());
}

// z up, then tilted from there.
inline Quat standing(double angle) {
    return make_tree::upright() * tilt(angle, 0);
}

inline Tree chain(double E, double beta, int rods = 20) {
    Tree t;
    t.name = "chain of rods";
    for (int i = 0; i < rods; ++i) {
        const double r = 0.03 * std::pow(0.1, i / 19.0);
        make_tree::add_piece(t, i - 1, i == 0 ? Vec3(0, 0, 0) : Vec3(0, 0, 0.2),
                             i == 0 ? standing(std::numbers::pi / 4) : Quat(Quat::Identity()), 0.2, r, r, 0, 0,
                             double(i) / rods, wood(E, beta));
    }
    return t;
}

inline Tree branched(double E, double beta) {
    Tree t;
    t.name = "trunk and three branches";
    for (int i = 0; i < 6; ++i) {
        const double r = 0.03 - 0.0025 * i;
        make_tree::add_piece(t, i - 1, i == 0 ? Vec3(0, 0, 0) : Vec3(0, 0, 0.3),
                             i == 0 ? standing(0.1) : Quat(Quat::Identity()), 0.3, r, r, 0, 0, i / 6.0, wood(E, beta));
    }
    const std::int32_t on[] = {5, 5, 3};
    for (int b = 0; b < 3; ++b) {
        std::int32_t parent = on[b];
        double s = 0;
        for (int i = 0; i < 5; ++i) {
            const double l = 0.1 + 0.02 * i, r = 0.012 * std::pow(0.25, i / 4.0);
            const Vec3 at(0, 0, t.size[std::size_t(parent)].x());
            parent =
                std::int32_t(make_tree::add_piece(t, parent, at, i == 0 ? tilt(0.7 + 0.2 * b, 2.1 * b) : tilt(0.1, 0.5),
                                                  l, r, r, b + 1, 1, s, wood(E, beta)));
            s += l / 0.7;
        }
    }
    return t;
}

// Branch bodies on which no other stands.
inline std::vector<std::size_t> tips(const Tree& tree) {
    std::vector<bool> bears(tree.size_bodies(), false);
    for (const std::int32_t p : tree.parent)
        if (p >= 0) bears[std::size_t(p)] = true;
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (!bears[i] && tree.kind[i] == bough::Kind::branch) found.push_back(i);
    return found;
}

} // namespace paper_trees
