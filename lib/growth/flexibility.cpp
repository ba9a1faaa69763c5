#include "flexibility.h"
#include "carry.h"
#include <Eigen/LU>
#include <algorithm>

namespace bough {
namespace {

constexpr double of_sway = 0.95; // omega squared, over the estimate of the lowest frequency's
constexpr double of_a_rod = 1.5; // omega squared of a rod on a joint, over m / S
constexpr double lower = 0.93;   // what is tried next where a part of the tree is slower
constexpr int most_slower = 40;

// By its leading minors.
bool positive_definite(const Mat3& W) {
    return W(0, 0) > 0 && W(0, 0) * W(1, 1) - W(0, 1) * W(1, 0) > 0 && W.determinant() > 0;
}

// Behind it no body has children: leaves, which are most of a tree's bodies.
std::size_t bodies_with_children(const Tree& tree) {
    std::int32_t last = -1;
    for (const std::int32_t p : tree.parent) last = std::max(last, p);
    return std::size_t(last + 1);
}

// All of f but `slow`, from its pose. Returns whether every joint stands; where all are to, it ends at the first that does not.
bool fill(const Tree& tree, double omega2, bool all_stand, Flexibility& f) {
    const std::size_t n = tree.size_bodies();
    f.omega2 = omega2;
    f.stands = true;
    f.mass = tree.mass;
    f.first.resize(n);
    f.upright.assign(n, 1);
    f.give.resize(n);
    f.turn.resize(n);
    f.follow.resize(n);
    f.slide.resize(n);
    std::vector<Borne> on(bodies_with_children(tree));
    for (std::size_t i = 0; i < n; ++i) {
        f.first[i] = f.pose.R_wb[i] * (tree.mass[i] * tree.com[i]);
        if (i < on.size()) on[i] = own_part(tree, i, f.pose.R_wb[i], omega2);
    }
    for (std::size_t i = n; i-- > 0;) {
        const std::int32_t parent = tree.parent[i];
        const auto p = std::size_t(parent < 0 ? 0 : parent);
        const Vec3 arm = parent < 0 ? Vec3(Vec3::Zero()) : Vec3(f.pose.x_w[i] - f.pose.x_w[p]);
        const Yielding y = yielding(stiffness_w(tree, i, f.pose.R_wb[i]), f.first[i],
                                    i < on.size() ? on[i] : own_part(tree, i, f.pose.R_wb[i], omega2), arm);
        f.stands &= y.stands;
        if (all_stand && !f.stands) return false;
        f.upright[i] &= y.stands;
        f.give[i] = y.give;
        f.turn[i] = y.turn;
        f.follow[i] = y.follow;
        f.slide[i] = y.slide;
        if (parent < 0) continue;
        f.mass[p] += f.mass[i];
        f.first[p] += f.first[i] + f.mass[i] * arm;
        f.upright[p] &= f.upright[i];
        on[p] += y.passed;
    }
    f.whole = f.give;
    for (std::size_t i = n; i-- > 0;)
        if (tree.parent[i] >= 0) f.whole[std::size_t(tree.parent[i])] += f.whole[i];
    return f.stands;
}

} // namespace

Borne& Borne::operator+=(const Borne& more) {
    aa += more.aa;
    ad += more.ad;
    dd += more.dd;
    a += more.a;
    d += more.d;
    return *this;
}

Borne own_part(const Tree& tree, std::size_t i, const Mat3& R_wb, double omega2) {
    const double m = tree.mass[i];
    const Mat3 c = cross_matrix<double>(R_wb * tree.com[i]);
    Borne own;
    own.a = m * c;
    own.d = m * Mat3::Identity();
    if (!(omega2 > 0)) return own;
    own.aa = -omega2 * (R_wb * tree.inertia[i] * R_wb.transpose() - m * c * c);
    own.ad = -omega2 * m * c;
    own.dd = -omega2 * own.d;
    return own;
}

Mat3 stiffness_w(const Tree& tree, std::size_t i, const Mat3& R_wb) {
    constexpr double least = 1e-12; // [N m/rad] of a joint without stiffness
    return R_wb * tree.stiffness[i].cwiseMax(least).asDiagonal() * R_wb.transpose();
}

Yielding yielding(const Mat3& K, const Vec3& H, const Borne& on, const Vec3& arm) {
    const Vec3 g(0, -growing_gravity, 0);
    const Mat3 gH = g * H.transpose(), level = g.dot(H) * Mat3::Identity();
    Yielding y;
    Mat3 C = level - gH + on.aa, Y = on.ad;
    const Mat3 W = K + level - 0.5 * (gH + gH.transpose()) + on.aa;
    y.stands = positive_definite(W);
    if (!y.stands) {
        C.setZero();
        Y.setZero();
    }
    const Mat3 gives = (y.stands ? W : K).inverse();
    y.turn = gives * on.a;
    y.follow = gives * C;
    y.slide = gives * Y;
    y.give = on.a.cwiseProduct(y.turn).sum();
    Borne& p = y.passed;
    p.aa = on.aa - C.transpose() * y.follow;
    p.ad = on.ad - C.transpose() * y.slide;
    p.dd = on.dd - Y.transpose() * y.slide;
    p.a = on.a - C.transpose() * y.turn;
    p.d = on.d - Y.transpose() * y.turn;
    const Mat3 r = cross_matrix<double>(arm); // d = d_p - r phi_p
    p.aa += -r.transpose() * p.ad.transpose() - p.ad * r + r.transpose() * p.dd * r;
    p.ad -= r.transpose() * p.dd;
    p.a -= r.transpose() * p.d;
    return y;
}

Flexibility flexibility(const Tree& tree, double omega2) {
    Flexibility f;
    f.pose = drawn_pose(tree);
    fill(tree, omega2, false, f);
    return f;
}

void bends(const Tree& tree, const Flexibility& f, const std::vector<std::int32_t>& group,
           const std::function<void(std::size_t, const Bend&)>& take) {
    std::vector<Bend> kept(bodies_with_children(tree));
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        Bend b;
        b.turn = b.turned = f.turn[i];
        b.moved.setZero();
        if (tree.parent[i] >= 0 && group[std::size_t(tree.parent[i])] == group[i]) {
            const auto p = std::size_t(tree.parent[i]);
            const Bend& on = kept[p];
            b.moved = on.moved - cross_matrix<double>(f.pose.x_w[i] - f.pose.x_w[p]) * on.turned;
            b.turn -= f.follow[i] * on.turned + f.slide[i] * b.moved;
            b.turned = on.turned + b.turn;
        }
        b.center = b.moved - cross_matrix<double>(f.pose.R_wb[i] * tree.com[i]) * b.turned;
        if (i < kept.size()) kept[i] = b;
        take(i, b);
    }
}

// With r the part of the lowest mode in the bend, S = r / (omega_1^2 - omega^2) and, Q being twice the kinetic energy at 1 rad/s, Q = dS / d omega^2.
Flexibility flexibility_at_sway(const Tree& tree) {
    Flexibility f = flexibility(tree, 0);
    f.slow = f.whole;
    if (!f.stands) return f;
    double S = 0, Q = 0;
    bends(tree, f, std::vector<std::int32_t>(tree.size_bodies(), 0), [&](std::size_t i, const Bend& b) {
        const Mat3& R = f.pose.R_wb[i];
        S += f.give[i];
        Q += tree.mass[i] * b.center.squaredNorm() +
             b.turned.cwiseProduct(R * tree.inertia[i] * R.transpose() * b.turned).sum();
    });
    double omega2 = of_sway * S / Q;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == Kind::branch && !continues_parent(tree, i))
            omega2 = std::min(omega2, of_a_rod * f.mass[i] / f.whole[i]);
    for (int k = 0; k < most_slower; ++k, omega2 *= lower)
        if (fill(tree, omega2, true, f)) return f;
    fill(tree, 0, false, f);
    return f;
}

} // namespace bough
