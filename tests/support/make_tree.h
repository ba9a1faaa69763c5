// make_tree.h: small trees for tests, built body by body from the formulas of solids, independent of segment.cpp.
//
// chain(n, ...)          one branch of n frustums, straight up from the origin unless bent at each joint
// branched()             a trunk, side branches on and off its axis, a twig on a branch, leaves and fruit; 14 bodies
// random_tree(n, seed)   n bodies: curved branches of several levels, about 3 in 10 leaves, 1 in 20 fruit
// forest(trees...)       several roots: the trees one after another, as they stand
// All are in the order of tree.h (branch by branch, then leaves and fruit) and pass check(Tree).
#pragma once
#include "lib/model/tree.h"
#include <numbers>
#include <random>

namespace make_tree {

inline constexpr double degree = std::numbers::pi / 180; // [rad]

using bough::Kind;
using bough::Mat3;
using bough::Quat;
using bough::Tree;
using bough::Vec3;

struct Wood {
    double density = 900, youngs = 9e9, shear = 6e8, damping = 0.01; // [kg/m^3], [Pa], [Pa], [s]
};

Quat turn(double angle, const Vec3& axis);

// The frame of a trunk: body z along world Y.
Quat upright();

// What all bodies share. Returns the new body's index.
std::size_t add_body(Tree& t, std::int32_t parent, Kind kind, const Vec3& at, const Quat& rotation, const Vec3& size,
                     std::int32_t branch, std::int32_t level, double s);

// A frustum: r(z) = r0 + (r1 - r0) z / l, integrals of r^2, r^2 z, r^2 z^2, r^4 over z in closed form.
std::size_t add_piece(Tree& t, std::int32_t parent, const Vec3& at, const Quat& rotation, double l, double r0,
                      double r1, std::int32_t branch, std::int32_t level, double s, const Wood& wood = {});

// A thin triangular plate, base edge w along x, apex at z = l.
std::size_t add_leaf(Tree& t, std::int32_t parent, const Vec3& at, const Quat& rotation, double l, double w,
                     double thickness, std::int32_t branch, std::int32_t level, double s);

std::size_t add_fruit(Tree& t, std::int32_t parent, const Vec3& at, const Quat& rotation, double center, double radius,
                      std::int32_t branch, std::int32_t level, double s);

// n pieces over `length` [m], radius falling linearly from r0 to r1 [m]; each joint after the first turned by `bend`
// [rad] about its x axis.
Tree chain(int n, double length, double r0, double r1, double bend = 0, const Wood& wood = {});

Tree branched();

// Uniform numbers in [a, b) that are the same with every standard library.
struct Dice {
    std::mt19937 engine;
    double operator()(double a, double b) { return a + (b - a) * double(engine()) / 4294967296.0; }
};

Tree random_tree(int n, unsigned seed);

// The trees one after another where they stand (each with its own roots): body and branch numbers shifted.
Tree forest(const std::vector<Tree>& trees);

} // namespace make_tree
