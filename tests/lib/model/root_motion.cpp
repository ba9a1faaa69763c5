// The moving ground: where it takes points, and that its velocities and accelerations are theirs.
#include "lib/model/root_motion.h"
#include "tests/support/make_tree.h"
#include <catch2/catch.hpp>
#include <numbers>

using namespace bough;
using make_tree::turn;

namespace {

using std::numbers::pi;

RootMotion wild() {
    RootMotion m;
    m.time = {0.2, 0.7, 1, 1.8, 2.5};
    m.position = {{0, 0, 0}, {0.4, -0.1, 0.2}, {1, 0, 0.3}, {0.2, 0.5, -0.6}, {0.1, 0, 0}};
    m.rotation = {turn(0.4, Vec3(1, 2, 0)), turn(1.1, Vec3(0, 1, 0.2)), turn(2.2, Vec3(0.3, 1, 0)),
                  turn(-2.5, Vec3(0.2, 1, 0.1)), turn(-1, Vec3(1, 0, 1))};
    return m;
}

Vec3 where(const Ground& g, const Vec3& X) {
    return g.x + g.R * X;
}

} // namespace

TEST_CASE("the keys are met exactly, about the tree's own place") {
    const RootMotion m = wild();
    const Vec3 pivot(3, 0.5, -2);
    const RootSpline s = make_root_spline(m, pivot);
    for (std::size_t k = 0; k < m.time.size(); ++k) {
        const Ground g = ground_at(s, m.time[k]);
        CHECK((where(g, pivot) - pivot - m.position[k]).norm() < 1e-14);
        CHECK((g.R - m.rotation[k].toRotationMatrix()).norm() < 1e-14);
    }
    const Ground before = ground_at(s, -1), after = ground_at(s, 9);
    for (const Ground& g : {before, after}) CHECK(g.v.norm() + g.a.norm() + g.omega.norm() + g.alpha.norm() == 0);
    CHECK((before.R - m.rotation.front().toRotationMatrix()).norm() < 1e-15);
}

TEST_CASE("velocities and accelerations are the derivatives of the pose, everywhere") {
    const RootSpline s = make_root_spline(wild(), Vec3(3, 0.5, -2));
    const double h = 1e-4;
    const std::vector<double> keys = wild().time;
    std::vector<double> at = keys; // continuous at keys and ends too
    for (double t = 0.1; t < 2.6; t += 0.0173) at.push_back(t);
    for (const double t : at) {
        const bool is_key = std::find(keys.begin(), keys.end(), t) != keys.end();
        const Ground g = ground_at(s, t), up = ground_at(s, t + h), down = ground_at(s, t - h);
        const double size = 1 + g.alpha.norm() + g.a.norm();
        const Mat3 rate = (up.R - down.R) / (2 * h);
        CHECK((rate - cross_matrix(g.omega) * g.R).norm() < (is_key ? 1e-4 : 1e-5) * size);
        CHECK(((up.omega - down.omega) / (2 * h) - g.alpha).norm() < (is_key ? 1e-1 : 1e-4) * size);
        const Vec3 X(0.3, 4, 1);
        const Vec3 rX = g.R * X;
        const Vec3 v = (where(up, X) - where(down, X)) / (2 * h);
        CHECK((v - g.v - g.omega.cross(rX)).norm() < 1e-4 * size);
        const Vec3 a = (where(up, X) - 2 * where(g, X) + where(down, X)) / (h * h);
        const Vec3 field = g.a + g.alpha.cross(rX) + g.omega.cross(g.omega.cross(rX));
        CHECK((a - field).norm() < (is_key ? 2e-1 : 1e-4) * size);
    }
}

TEST_CASE("alpha is the derivative of omega through many whole turns, small angles and none") {
    // A hand-built curve in phi alone, of one piece.
    for (const double size : {0.0, 1e-9, 1e-3, 0.05, 0.099, 0.101, 1.0, 6.2, 20.0}) {
        RootSpline s;
        const Vec3 a(size, 0.5 * size, -size), b(1, -0.3, 0.2);
        s.rotation = QuinticSpline{{0, 1}, {a, a + b}, {b, Vec3(0.1, 0, 2)}, {Vec3(0, 1, 0), b}};
        const double h = 1e-4;
        for (double t = 0.05; t < 1; t += 0.1) {
            const Vec3 alpha = ground_at(s, t).alpha;
            // Fourth-order differences.
            const Vec3 found = (8 * (ground_at(s, t + h).omega - ground_at(s, t - h).omega) -
                                (ground_at(s, t + 2 * h).omega - ground_at(s, t - 2 * h).omega)) /
                               (12 * h);
            CAPTURE(size, t);
            CHECK((alpha - found).norm() < 1e-9 * (1 + alpha.norm()));
        }
    }
}

TEST_CASE("keys of a steady turn keep turning, at the constant rate in the middle") {
    RootMotion m;
    const Vec3 axis = Vec3(0.2, 1, -0.1).normalized();
    const double rate = 2;
    for (int k = 0; k <= 40; ++k) {
        m.time.push_back(0.3 * k);
        Quat q = turn(rate * 0.3 * k, axis) * turn(0.7, Vec3::UnitX());
        if (k % 3 == 0) q.coeffs() *= -1; // the same rotation
        m.rotation.push_back(q);
    }
    const RootSpline s = make_root_spline(m, Vec3::Zero());
    CHECK((s.rotation->x.back() - rate * 12 * axis).norm() < 1e-12);
    for (double t = 5; t < 7; t += 0.07) {
        const Ground g = ground_at(s, t);
        CHECK((g.omega - rate * axis).norm() < 1e-5);
        CHECK(g.alpha.norm() < 1e-4);
        CHECK((g.R - (turn(rate * t, axis) * turn(0.7, Vec3::UnitX())).toRotationMatrix()).norm() < 1e-6);
    }
    // And back again: the turns are undone, not wound on.
    RootMotion back = m;
    for (std::size_t k = m.time.size() - 1; k-- > 0;) {
        back.time.push_back(back.time.back() + 0.3);
        back.rotation.push_back(m.rotation[k]);
    }
    CHECK(make_root_spline(back, Vec3::Zero()).rotation->x.back().norm() < 1e-12);
}

TEST_CASE("a key at a whole turn, as rounded quaternions give it, stays a whole turn") {
    RootMotion m;
    for (int k = 0; k <= 8; ++k) {
        m.time.push_back(k);
        Quat q = turn(pi / 2 * k, Vec3::UnitY());
        if (k == 4) q = Quat(-1, 1e-7, 0, 0); // its axis lost
        m.rotation.push_back(q);
    }
    const RootSpline s = make_root_spline(m, Vec3::Zero());
    for (int k = 0; k <= 8; ++k) CHECK((s.rotation->x[std::size_t(k)] - Vec3(0, pi / 2 * k, 0)).norm() < 1e-6);
}

TEST_CASE("equal keys are a ground at rest, to the bit") {
    RootMotion m;
    m.time = {0, 1, 3};
    m.position.assign(3, Vec3::Zero());
    m.rotation.assign(3, Quat::Identity());
    const RootSpline s = make_root_spline(m, Vec3(0.1, 0.2, 1e7));
    for (const double t : {-1.0, 0.0, 0.4, 1.0, 2.2, 3.0, 5.0}) {
        const Ground g = ground_at(s, t);
        CHECK(g.R == Mat3::Identity());
        CHECK(g.x == Vec3::Zero());
        CHECK(g.v.norm() + g.a.norm() + g.omega.norm() + g.alpha.norm() == 0);
    }
}

TEST_CASE("the highest place is a bound on where points go") {
    const Vec3 pivot(3, 0.5, -2);
    for (const bool turns : {false, true}) {
        RootMotion m = wild();
        if (!turns) m.rotation.clear();
        const RootSpline s = make_root_spline(m, pivot);
        for (const Vec3& X : {Vec3(3, 0.5, -2), Vec3(2.5, 0.4, -1), Vec3(0, 0, 0)}) {
            double most = -INFINITY;
            for (double t = 0; t < 3; t += 1e-3) most = std::max(most, where(ground_at(s, t), X).y());
            CHECK(highest(s, X) >= most);
            CHECK(highest(s, X) < most + 4);
        }
    }
}

TEST_CASE("which spline is under a body") {
    const std::vector<MovedTree> moved{{3, 2, 1}, {5, 4, 0}, {20, 1, 2}};
    const int expected[] = {-1, -1, -1, 1, 1, 0, 0, 0, 0, -1, -1};
    for (std::size_t i = 0; i < 11; ++i) CHECK(spline_under(moved, i) == expected[i]);
    CHECK(spline_under(moved, 19) == -1);
    CHECK(spline_under(moved, 20) == 2);
    CHECK(spline_under(moved, 21) == -1);
    CHECK(spline_under({}, 0) == -1);
}
