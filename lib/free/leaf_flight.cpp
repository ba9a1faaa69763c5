#include "leaf_flight.h"
#include <algorithm>

namespace bough {
namespace {

constexpr int most_parts = 16;
constexpr double resolved = 1; // [1] a part's rates times its length, up to which it is taken as it is

struct Flight {
    Vec3 wind, gravity, inertia;
    CardAir air;
};

struct Change {
    Vec3 v, omega; // [m/s^2], [rad/s^2]
};

Change change(const Flight& f, const Quat& q, const Vec3& v, const Vec3& omega) {
    const Mat3 R = q.normalized().toRotationMatrix();
    const Vec3 n = R.col(1), u = f.wind - v;
    const Vec3 w = R.transpose() * omega, turning = R.transpose() * card_torque(f.air, n, u);
    const Vec3 spin = (turning - w.cross(f.inertia.cwiseProduct(w))).cwiseQuotient(f.inertia);
    return {card_acceleration(f.air, f.gravity, n, u), R * spin - card_spin(f.air) * omega};
}

Quat rate(const Quat& q, const Vec3& omega) {
    Quat dq = Quat(0, omega.x(), omega.y(), omega.z()) * q;
    dq.coeffs() *= 0.5;
    return dq;
}

Quat moved(const Quat& q, double h, const Quat& dq) {
    Quat to;
    to.coeffs() = q.coeffs() + h * dq.coeffs();
    return to;
}

void resolved_part(const Flight& f, double h, FreeMotion& m) {
    const Change k1 = change(f, m.q, m.v, m.omega);
    const Quat d1 = rate(m.q, m.omega);
    const Vec3 v2 = m.v + h / 2 * k1.v, w2 = m.omega + h / 2 * k1.omega;
    const Quat q2 = moved(m.q, h / 2, d1);
    const Change k2 = change(f, q2, v2, w2);
    const Quat d2 = rate(q2, w2);
    const Vec3 v3 = m.v + h / 2 * k2.v, w3 = m.omega + h / 2 * k2.omega;
    const Quat q3 = moved(m.q, h / 2, d2);
    const Change k3 = change(f, q3, v3, w3);
    const Quat d3 = rate(q3, w3);
    const Vec3 v4 = m.v + h * k3.v, w4 = m.omega + h * k3.omega;
    const Quat q4 = moved(m.q, h, d3);
    const Change k4 = change(f, q4, v4, w4);
    const Quat d4 = rate(q4, w4);
    m.x += h / 6 * (m.v + 2 * v2 + 2 * v3 + v4);
    m.q.coeffs() += h / 6 * (d1.coeffs() + 2 * d2.coeffs() + 2 * d3.coeffs() + d4.coeffs());
    m.q.normalize();
    m.v += h / 6 * (k1.v + 2 * k2.v + 2 * k3.v + k4.v);
    m.omega += h / 6 * (k1.omega + 2 * k2.omega + 2 * k3.omega + k4.omega);
}

// w after h of -w x I w, which has the energy that it had.
Vec3 turned_freely(const Vec3& inertia, const Vec3& w, double h) {
    const Vec3 Iw = inertia.cwiseProduct(w);
    const Vec3 to = w - h * w.cross(Iw).cwiseQuotient(inertia);
    const double had = w.dot(Iw), has = to.dot(inertia.cwiseProduct(to));
    return has > had ? Vec3(std::sqrt(had / has) * to) : to;
}

void implicit_part(const Flight& f, double h, FreeMotion& m) {
    const Mat3 R = m.q.toRotationMatrix();
    const Vec3 n = R.col(1), u = f.wind - m.v;
    Vec3 resistance = (1 + h * card_spin(f.air)) * f.inertia;
    for (const int k : {0, 2}) resistance[k] += card_turning(f.air, u.norm(), h * h);
    const Vec3 w = turned_freely(f.inertia, R.transpose() * m.omega, h);
    const Vec3 turning = R.transpose() * card_torque(f.air, n, u);
    m.omega = R * (f.inertia.cwiseProduct(w) + h * turning).cwiseQuotient(resistance);
    m.q = (quaternion_from_vector(Vec3(h * m.omega)) * m.q).normalized();

    const Vec3 a = card_acceleration(f.air, f.gravity, n, u);
    const CardDamping damping = card_damping(f.air, n, u);
    const double a_n = a.dot(n);
    m.v += h / (1 + h * damping.surface) * (a - a_n * n) + h / (1 + h * damping.normal) * a_n * n;
    m.x += h * m.v;
}

// [1/s] What turns, swings and is dragged in the next h, together. What the card may gain of speed on the way is what gravity gives it, at
// the most the speed at which it falls.
double fastest(const Flight& f, double h, const FreeMotion& m) {
    const double g = f.gravity.norm();
    const double speed = (f.wind - m.v).norm() + std::min(g * h, std::sqrt(g / f.air.drag));
    const double lightest = std::min(f.inertia.x(), f.inertia.z());
    return card_rates(f.air, m.omega.norm(), lightest, speed);
}

} // namespace

void fly_leaf(const LeafAir& air, const LeafCard& card, const Vec3& wind, const Vec3& gravity, double air_density,
              double h, FreeMotion& m) {
    const Flight f{wind, gravity, card.inertia, card_air(air, card, air_density)};
    double rest = h;
    for (int left = most_parts; left > 0; --left) {
        const double rates = fastest(f, rest, m), wanted = std::ceil(rates * rest / resolved);
        const double parts = wanted <= left ? std::max(1.0, wanted) : left; // and where it is not a number
        if (wanted <= left)
            resolved_part(f, rest / parts, m);
        else
            implicit_part(f, rest / parts, m);
        if (parts == 1) return;
        rest -= rest / parts;
    }
}

} // namespace bough
