#include "lib/free/leaf_flight.h"
#include "lib/model/body_shape.h"
#include <catch2/catch.hpp>
#include <numbers>
#include <random>

using namespace bough;

namespace {

constexpr double frame = 1.0 / 30, air = 1.2;
const Vec3 gravity(0, -9.81, 0);

// A leaf 5 cm long and wide of 0.1 kg/m^2: an eighth of a gram.
LeafCard leaf(double length = 0.05, double width = 0.05, double per_area = 0.1) {
    const double thickness = 2e-4;
    const MassProperties body = leaf_prism(length, width, thickness, per_area / thickness);
    return {body.mass, body.inertia.diagonal(), leaf_area(length, width)};
}

LeafAir with(double kappa, double air_resistance, double drag_ratio, double offset = 0) {
    return {kappa, air_resistance, drag_ratio, offset};
}

// The parameters by which this leaf shows each regime; formats/documents/README.md gives them to people.
const LeafAir steady_fall = with(0.6, 24, 5), flutter = with(0.1, 7, 10), tumble = with(0.6, 4, 5),
              spiral = with(0.3, 24, 10, 30);

Vec3 normal(const FreeMotion& m) {
    return m.q.toRotationMatrix().col(1);
}

FreeMotion tilted(double angle, double direction) {
    FreeMotion m;
    m.q = quaternion_from_vector(Vec3(angle * std::cos(direction), 0, angle * std::sin(direction)));
    return m;
}

// (24) without nu I w by matrices, in the card's own axes.
Vec3 torque(const LeafAir& by, const LeafCard& card, const Mat3& R, const Vec3& u) {
    const Vec3 b = R.transpose() * u;
    const Mat3 n = cross_matrix(Vec3(0, 1, 0));
    const double phi = by.offset / 180 * std::acos(-1.0), k = by.kappa * air * card.area / 2;
    return R * (k * std::sqrt(card.area / std::acos(-1.0)) * b.y() * n * (std::cos(phi) * b + std::sin(phi) * n * b));
}

Mat3 inertia(const LeafCard& card, const Mat3& R) {
    return R * card.inertia.asDiagonal() * R.transpose();
}

} // namespace

TEST_CASE(
    "A leaf that falls broadside reaches its terminal velocity, whatever it weighs and however long the step is") {
    for (const double per_area : {1e-6, 1e-3, 0.1, 10.0})
        for (const double kappa : {0.0, 0.1, 0.6})
            for (const double nu : {0.0, 4.0, 24.0})
                for (const double h : {1e-2, frame, 0.1, 1.0}) {
                    if (kappa == 0 && nu == 0) continue;
                    const LeafCard card = leaf(0.05, 0.05, per_area);
                    const LeafAir by = with(kappa, nu, 5);
                    FreeMotion m;
                    for (double t = 0; t < 60; t += h) fly_leaf(by, card, Vec3::Zero(), gravity, air, h, m);
                    // kappa rho A v^2 + nu m v = m g
                    const double a = kappa * air * card.area, b = nu * card.mass, c = card.mass * 9.81;
                    const double v = 2 * c / (b + std::sqrt(b * b + 4 * a * c));
                    CAPTURE(per_area, kappa, nu, h);
                    CHECK(m.v.y() == Approx(-v).epsilon(1e-9));
                    CHECK(std::abs(m.v.x()) + std::abs(m.v.z()) + m.omega.norm() == 0);
                    CHECK(normal(m).y() == Approx(1).epsilon(1e-12));
                }
}

TEST_CASE("Without pressure the air's resistance alone stops a leaf: exponentials, nu across, nu / xi along") {
    const LeafCard card = leaf();
    const LeafAir by = with(0, 3, 4);
    FreeMotion m;
    m.q = quaternion_from_vector(Vec3(0.3, 0.2, -0.5));
    m.v = Vec3(1, 2, -0.7);
    const Vec3 n = normal(m), v = m.v, wind(0.4, 0, 0.1);
    for (int i = 0; i < 45; ++i) fly_leaf(by, card, wind, gravity, air, frame, m);
    const auto after = [&](double from, double nu, double u, double g) {
        const double end = u + g / nu;
        return end + (from - end) * std::exp(-nu * 1.5);
    };
    const double across = after(v.dot(n), 3, wind.dot(n), gravity.dot(n));
    CHECK(m.v.dot(n) == Approx(across).epsilon(1e-6));
    for (const Vec3& t : {Vec3(n.unitOrthogonal()), Vec3(n.cross(n.unitOrthogonal()))})
        CHECK(m.v.dot(t) == Approx(after(v.dot(t), 0.75, wind.dot(t), gravity.dot(t))).epsilon(1e-6));
    // Spin about the normal: exp(-nu t).
    FreeMotion spun;
    spun.omega = Vec3(0, 20, 0);
    for (int i = 0; i < 30; ++i) fly_leaf(by, card, Vec3::Zero(), Vec3::Zero(), air, frame, spun);
    CHECK(spun.omega.y() == Approx(20 * std::exp(-3.0)).epsilon(1e-5));
    // In a single step of a second, too long for its parts.
    spun.omega = Vec3(0, 20, 0);
    fly_leaf(by, card, Vec3::Zero(), Vec3::Zero(), air, 1, spun);
    CHECK(spun.omega.y() == Approx(20 * std::exp(-3.0)).epsilon(0.2));
}

TEST_CASE("Force and torque are (23) and (24)") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto vector = [&](double scale) {
        return Vec3(scale * any(random), scale * any(random), scale * any(random));
    };
    for (int i = 0; i < 50; ++i) {
        const LeafCard card = leaf(0.02 + 0.08 * std::abs(any(random)), 0.02 + 0.08 * std::abs(any(random)));
        const LeafAir by =
            with(0.1 + std::abs(any(random)), 5 + 4 * any(random), 3 + 2 * any(random), 180 * any(random));
        FreeMotion m;
        m.q = quaternion_from_vector(vector(2));
        m.v = vector(3);
        m.omega = vector(10);
        const Vec3 wind = vector(5), u = wind - m.v;
        const Mat3 R = m.q.toRotationMatrix(), I = inertia(card, R);
        const Vec3 n = R.col(1), along = u.dot(n) * n;
        const Vec3 f = by.kappa * air * card.area * u.norm() * along +
                       by.air_resistance * card.mass * (along + (u - along) / by.drag_ratio);
        const Vec3 tau = torque(by, card, R, u) - by.air_resistance * I * m.omega;
        const Vec3 v = m.v, w = m.omega, momentum = I * w;
        const double h = 1e-6;
        fly_leaf(by, card, wind, gravity, air, h, m);
        const Vec3 gained = inertia(card, m.q.toRotationMatrix()) * m.omega - momentum;
        CHECK(((m.v - v) / h - f / card.mass - gravity).norm() <= 1e-3 * (f.norm() / card.mass + 9.81));
        CHECK((gained / h - tau).norm() <= 1e-2 * tau.norm());
    }
}

TEST_CASE("In a void a leaf keeps its momentum and its energy while it spins") {
    const LeafCard card = leaf(0.08, 0.03);
    FreeMotion m;
    m.omega = Vec3(9, 2, -4);
    m.v = Vec3(1, 0, 0);
    const Vec3 before = inertia(card, m.q.toRotationMatrix()) * m.omega;
    const double energy = m.omega.dot(before);
    for (int i = 0; i < 90; ++i) fly_leaf(with(0.6, 0, 5), card, Vec3::Zero(), Vec3::Zero(), 0, frame, m);
    const Vec3 after = inertia(card, m.q.toRotationMatrix()) * m.omega;
    CHECK((after - before).norm() <= 2e-2 * before.norm());
    CHECK(m.omega.dot(after) == Approx(energy).epsilon(2e-2));
    CHECK((m.x - Vec3(3, 0, 0)).norm() <= 1e-12);
}

TEST_CASE("Still air only takes from a leaf: the energy with what the torque has in store never grows") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto vector = [&](double scale) {
        return Vec3(scale * any(random), scale * any(random), scale * any(random));
    };
    for (const double per_area : {1e-4, 1e-2, 0.1, 1.0})
        for (const double h : {1.0 / 240, frame, 0.1, 1.0})
            for (const double speed : {1.0, 20.0, 50.0})
                for (int i = 0; i < 10; ++i) {
                    const LeafCard card = leaf(0.05, 0.03, per_area);
                    const LeafAir by = with(0.6, i % 2 == 0 ? 0 : 4, 5);
                    const double k = 0.3 * air * card.area * std::sqrt(card.area / std::numbers::pi);
                    FreeMotion m;
                    m.q = quaternion_from_vector(vector(3));
                    m.v = vector(speed);
                    m.omega = vector(20);
                    const auto stored = [&] {
                        const double across = m.v.squaredNorm() - std::pow(m.v.dot(normal(m)), 2);
                        const Mat3 I = inertia(card, m.q.toRotationMatrix());
                        return card.mass * m.v.squaredNorm() / 2 + m.omega.dot(I * m.omega) / 2 + k * across / 2;
                    };
                    const double start = stored();
                    double had = start;
                    for (int step = 0; step < 200; ++step) {
                        fly_leaf(by, card, Vec3::Zero(), Vec3::Zero(), air, h, m);
                        const double has = stored();
                        CAPTURE(per_area, h, speed, i, step, start);
                        REQUIRE(has <= 1.05 * had);
                        REQUIRE(has <= 1.01 * start);
                        had = has;
                    }
                }
}

TEST_CASE("Let go in a storm a leaf goes with it, at one step a frame and at longer ones") {
    for (const double per_area : {1e-6, 1e-3, 0.02, 0.1, 1.0})
        for (const double h : {frame, 0.1, 1.0})
            for (const double speed : {1.0, 5.0, 20.0, 50.0})
                for (const LeafAir& by : {steady_fall, flutter, tumble, spiral})
                    for (const double tilt : {0.0, 0.7, 1.5, 1.57079}) {
                        const LeafCard card = leaf(0.05, 0.05, per_area);
                        const Vec3 wind(speed, 0, 0);
                        FreeMotion m = tilted(tilt, 0.4);
                        double fastest = 0, spin = 0;
                        for (int step = 0; step < 300; ++step) {
                            fly_leaf(by, card, wind, gravity, air, h, m);
                            fastest = std::max(fastest, (m.v - wind).norm());
                            spin = std::max(spin, m.omega.norm());
                        }
                        CAPTURE(per_area, h, speed, by.air_resistance, by.offset, tilt);
                        // Dragged along its surface alone it falls no faster than at g xi / nu.
                        const double falls = 9.81 * by.drag_ratio / by.air_resistance;
                        CHECK(fastest <= speed + falls);
                        CHECK((m.v - wind).norm() <= 1.05 * falls);
                        // The torque turns it by its own potential, k u^2 / 2, and phi's part of it against nu.
                        const double k = by.kappa * air * card.area / 2 * std::sqrt(card.area / std::numbers::pi);
                        const double rate = std::sqrt(k / std::min(card.inertia.x(), card.inertia.z()));
                        CHECK(spin <= 3 * rate * (speed + falls));
                        CHECK(std::abs(m.q.norm() - 1) < 1e-12);
                    }
}

TEST_CASE("Flight in a wind is flight in still air, carried along") {
    const LeafCard card = leaf();
    const Vec3 wind(3, -1, 2);
    FreeMotion still = tilted(0.4, 1), carried = still;
    carried.v = wind;
    for (int i = 0; i < 60; ++i) {
        fly_leaf(tumble, card, Vec3::Zero(), gravity, air, frame, still);
        fly_leaf(tumble, card, wind, gravity, air, frame, carried);
    }
    CHECK((carried.x - still.x - 2 * wind).norm() < 1e-9);
    CHECK(std::abs(carried.q.dot(still.q)) == Approx(1).epsilon(1e-9));
}

namespace {

// What a fall looks like from outside, over its second half.
struct Fall {
    double most_tilt = 0;    // [deg] of the normal from the vertical
    double swings = 0;       // [1] how often the horizontal velocity turned about
    double end_over_end = 0; // [1] of all turning about horizontal axes, what added up
    double turns = 0;        // [1] end over end
    double circles = 0;      // [1] rounds of the track, signed
    double even = 0;         // [1] of all the track's turning to the side, what added up
    double radius = 0;       // [m] of the track
    double speed = 0;        // [m/s] downward
};

Fall watch(const LeafAir& by, double tilt, double direction, double h, double seconds = 20) {
    FreeMotion m = tilted(tilt, direction);
    const LeafCard card = leaf();
    const int steps = int(std::lround(seconds / h)), a_frame = int(std::lround(frame / h));
    Fall fall;
    Vec3 turned = Vec3::Zero(), last = Vec3::Zero(), from = Vec3::Zero();
    double turning = 0, sideways = 0, sideways_all = 0, track = 0;
    for (int i = 0; i < steps; ++i) {
        fly_leaf(by, card, Vec3::Zero(), gravity, air, h, m);
        if (i == steps / 2) from = m.x;
        if (i <= steps / 2) continue;
        const Vec3 level(m.omega.x(), 0, m.omega.z());
        turned += h * level;
        turning += h * level.norm();
        fall.most_tilt = std::max(fall.most_tilt, std::acos(std::clamp(normal(m).y(), -1.0, 1.0)));
        if ((i + 1) % a_frame != 0) continue;
        const Vec3 v(m.v.x(), 0, m.v.z());
        if (last.norm() > 0) {
            const double aside = std::atan2(last.cross(v).y(), last.dot(v));
            sideways += aside;
            sideways_all += std::abs(aside);
            fall.swings += last.dot(v) < 0;
            track += v.norm() * frame;
        }
        last = v;
    }
    constexpr double round = 2 * std::numbers::pi;
    fall.most_tilt *= 360 / round;
    fall.end_over_end = turned.norm() / std::max(turning, 1e-12);
    fall.turns = turned.norm() / round;
    fall.circles = sideways / round;
    fall.even = std::abs(sideways) / std::max(sideways_all, 1e-12);
    fall.radius = track / std::max(sideways_all, 1e-12);
    fall.speed = -(m.x - from).y() / (seconds / 2);
    return fall;
}

const char* regime(const Fall& fall) {
    if (fall.most_tilt < 2) return "steady";
    if (fall.most_tilt < 85 && fall.even > 0.95 && std::abs(fall.circles) >= 3) return "spiral";
    if (fall.most_tilt > 15 && fall.most_tilt < 85 && fall.swings >= 10) return "flutter";
    if (fall.most_tilt > 150 && fall.end_over_end > 0.8 && fall.turns >= 10) return "tumble";
    return "mixed";
}

} // namespace

TEST_CASE("A leaf falls steadily, flutters, tumbles or spirals by its parameters, at 30 steps a second as at 3000") {
    // As published: a fluttering card swings from side to side and never turns over, its track turning about at each swing; a
    // tumbling one turns end over end, always the same way (Tanabe, Kaneko 1994; Belmonte, Eisenberg, Moses 1998; Andersen, Pesavento,
    // Wang 2005); a spiralling one turns about the vertical while its track goes round in a circle (Zhong, Chen, Lee 2011).
    struct Case {
        const char* name;
        const LeafAir& by;
    };
    for (const Case& wanted :
         {Case{"steady", steady_fall}, {"flutter", flutter}, {"tumble", tumble}, {"spiral", spiral}})
        for (const double tilt : {0.2, 0.5, 1.2})
            for (const double direction : {0.0, 1.0, std::numbers::pi / 2}) {
                const Fall coarse = watch(wanted.by, tilt, direction, frame);
                CAPTURE(wanted.name, tilt, direction, coarse.most_tilt, coarse.swings, coarse.end_over_end,
                        coarse.turns, coarse.circles, coarse.even, coarse.radius);
                CHECK(std::string(regime(coarse)) == wanted.name);
                if (direction == 1.0) {
                    const Fall fine = watch(wanted.by, tilt, direction, 1.0 / 3000);
                    CHECK(std::string(regime(fine)) == wanted.name);
                    CHECK(coarse.speed == Approx(fine.speed).epsilon(0.03));
                }
            }
}

TEST_CASE("A spiral goes the other way round when phi does, and a tumbling leaf drifts to the side it turns to") {
    LeafAir mirrored = spiral;
    mirrored.offset = -spiral.offset;
    const Fall one = watch(spiral, 0.3, 0, frame), other = watch(mirrored, 0.3, 0, frame);
    CHECK(one.circles * other.circles < 0);
    CHECK(one.radius == Approx(other.radius).epsilon(0.01));
    CHECK(one.radius > 0.02);
    // About the width alone: the motion stays in a plane, as the published ones do.
    for (const double tilt : {0.5, -0.5}) {
        FreeMotion m = tilted(tilt, 0);
        for (int i = 0; i < 300; ++i) fly_leaf(tumble, leaf(), Vec3::Zero(), gravity, air, frame, m);
        const FreeMotion middle = m;
        double turned = 0;
        for (int i = 0; i < 300; ++i) {
            fly_leaf(tumble, leaf(), Vec3::Zero(), gravity, air, frame, m);
            turned += frame * m.omega.x();
        }
        CAPTURE(tilt, turned, (m.x - middle.x).transpose());
        CHECK(std::abs(m.x.x()) < 1e-9);
        CHECK(std::abs(turned) > 20 * std::numbers::pi);
        CHECK(std::abs((m.x - middle.x).z()) > 0.1 * std::abs((m.x - middle.x).y()));
    }
}
