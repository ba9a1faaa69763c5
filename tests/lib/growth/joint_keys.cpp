#include "lib/growth/joint_keys.h"
#include "lib/base/parallel.h"
#include "tests/support/make_tree.h"
#include <catch2/catch.hpp>

using namespace bough;
using make_tree::degree;
using make_tree::Dice;
using make_tree::turn;

namespace {

// Parents of a random forest, and each joint's rotation from its parent over the frames: sums of slow and quick swings.
struct Motion {
    std::vector<std::int32_t> parent;
    std::vector<Quat> drawn;
    std::vector<std::vector<Quat>> world; // [frame][joint]
};

Motion swinging(std::size_t joints, std::size_t frames, unsigned seed, double amplitude) {
    Dice dice{std::mt19937(seed)};
    Motion motion;
    struct Swing {
        Vec3 axis;
        double amplitude, frequency, phase;
    };
    std::vector<Swing> swings;
    for (std::size_t j = 0; j < joints; ++j) {
        motion.parent.push_back(
            j == 0 || dice(0, 1) < 0.02 ? -1 : std::int32_t(dice(std::max(0.0, double(j) - 5), double(j))));
        motion.drawn.push_back(turn(dice(0, 3), Vec3(dice(-1, 1), dice(-1, 1), dice(0.1, 1))));
        const bool still = j % 7 == 3;
        swings.push_back({Vec3(dice(-1, 1), dice(-1, 1), 0.1).normalized(), still ? 0 : dice(0, amplitude),
                          dice(0.1, 3), dice(0, 6)});
    }
    for (std::size_t f = 0; f < frames; ++f) {
        std::vector<Quat> world;
        for (std::size_t j = 0; j < joints; ++j) {
            const Swing& s = swings[j];
            const double angle = s.amplitude * std::sin(s.phase + s.frequency * double(f) / 5);
            const Quat local = motion.drawn[j] * turn(angle, s.axis);
            world.push_back(motion.parent[j] < 0 ? local : Quat(world[std::size_t(motion.parent[j])] * local));
        }
        motion.world.push_back(world);
    }
    return motion;
}

JointKeys keys_of(const Motion& motion, double tolerance, bool shorts = false) {
    JointKeys keys(motion.parent, motion.drawn);
    for (const auto& frame : motion.world) keys.add(frame);
    keys.thin(tolerance, shorts);
    return keys;
}

// What a file holds of a joint's keys, in the order of their frames.
Eigen::Quaterniond short_key(const JointKeys& keys, std::size_t joint, std::size_t number) {
    const ShortRotation& q = keys.short_keys(joint)[number];
    return Eigen::Quaterniond(q[3] / 32767.0, q[0] / 32767.0, q[1] / 32767.0, q[2] / 32767.0);
}

// A player of our own: slerp by axis and angle between the neighbouring keys, the drawn rotation where there are none.
std::vector<std::vector<Quat>> played(const JointKeys& keys, const Motion& motion) {
    std::vector<std::vector<Quat>> world(keys.frames(), std::vector<Quat>(keys.joints()));
    for (std::size_t j = 0; j < keys.joints(); ++j) {
        std::vector<std::size_t> at;
        for (std::size_t f = 0; f < keys.frames(); ++f)
            if (keys.has_key(j, f)) at.push_back(f);
        REQUIRE(at.size() == keys.count(j));
        std::size_t k = 0;
        for (std::size_t f = 0; f < keys.frames(); ++f) {
            Eigen::Quaterniond local(motion.drawn[j]);
            while (k + 1 < at.size() && at[k + 1] <= f) ++k;
            const auto key = [&](std::size_t number) {
                return keys.in_shorts() ? short_key(keys, j, number).normalized()
                                        : Eigen::Quaterniond(keys.key(j, at[number]).cast<double>());
            };
            if (!at.empty()) local = key(k);
            if (k + 1 < at.size() && f > at[k]) {
                const Eigen::Quaterniond to = key(k + 1);
                Eigen::AngleAxisd between(local.conjugate() * to);
                if (between.angle() > std::numbers::pi)
                    between = Eigen::AngleAxisd(between.angle() - 2 * std::numbers::pi, between.axis());
                between.angle() *= double(f - at[k]) / double(at[k + 1] - at[k]);
                local = local * between;
            }
            const std::int32_t p = motion.parent[j];
            world[f][j] = p < 0 ? Quat(local) : Quat(world[f][std::size_t(p)] * Quat(local));
        }
    }
    return world;
}

double angle_between(const Quat& a, const Quat& b) {
    return vector_from_quaternion(Quat(a.conjugate() * b)).norm();
}

double largest_error(const JointKeys& keys, const Motion& motion) {
    const auto world = played(keys, motion);
    double most = 0;
    for (std::size_t f = 0; f < world.size(); ++f)
        for (std::size_t j = 0; j < keys.joints(); ++j)
            most = std::max(most, angle_between(world[f][j], motion.world[f][j]));
    return most;
}

} // namespace

TEST_CASE("without a tolerance every frame is a key") {
    const Motion motion = swinging(60, 37, 1, 0.5);
    const JointKeys keys = keys_of(motion, 0);
    CHECK(keys.count() == 60 * 37);
    CHECK(largest_error(keys, motion) < 1e-5); // floats, along paths of up to 60 joints
}

TEST_CASE("no joint's world rotation is off by more than the tolerance, however long its path") {
    const Motion motion = swinging(150, 90, 2, 0.3);
    std::size_t before = 150 * 90;
    for (const double tolerance : {0.01 * degree, 0.1 * degree, 1 * degree, 5 * degree}) {
        const JointKeys keys = keys_of(motion, tolerance);
        const double off = largest_error(keys, motion);
        CHECK(off <= tolerance + 1e-5);
        CHECK(off > 0.5 * tolerance); // it is made use of
        CHECK(keys.count() < before);
        before = keys.count();
    }
    CHECK(before < 150 * 90 / 5);
}

TEST_CASE("keys in shorts keep the tolerance along paths, and the length of a rotation") {
    const Motion motion = swinging(150, 90, 2, 0.3);
    for (const double tolerance : {8 * short_turning, 0.1 * degree, 1 * degree}) {
        const JointKeys keys = keys_of(motion, tolerance, true);
        REQUIRE(keys.in_shorts());
        CHECK(largest_error(keys, motion) <= tolerance + 1e-5);
        CHECK(double(keys.count()) < 1.1 * double(keys_of(motion, tolerance).count()));
        double longest = 0, farthest = 0;
        for (std::size_t j = 0; j < keys.joints(); ++j) {
            REQUIRE(keys.short_keys(j).size() == keys.count(j));
            std::size_t number = 0;
            for (std::size_t f = 0; f < keys.frames(); ++f) {
                if (!keys.has_key(j, f)) continue;
                const Eigen::Quaterniond q = short_key(keys, j, number++);
                longest = std::max(longest, std::abs(q.norm() - 1));
                farthest = std::max(farthest, angle_between(Quat(q.normalized()), Quat(keys.key(j, f).cast<double>())));
            }
        }
        CHECK(longest < 1.6e-5); // half a step, of rotations near an axis; a number rounded down alone is off by a step
        CHECK(farthest < 1e-6);  // key() gives what was rounded, but for floats
    }
    CHECK_FALSE(keys_of(motion, 7.9 * short_turning, true).in_shorts());
    CHECK_FALSE(keys_of(motion, 0, true).in_shorts());
}

TEST_CASE("rotations on an axis, and those with a number of one, fit in shorts") {
    Motion motion;
    motion.parent = {-1, 0, 1};
    motion.drawn = {Quat::Identity(), Quat(0, 1, 0, 0), Quat(0, 0, 0, -1)};
    for (int f = 0; f < 20; ++f) {
        const Quat a(turn(0.1 * f, Vec3::UnitX())), b = a * Quat(0, 1, 0, 0), c = b * turn(-0.3 * f, Vec3::UnitZ());
        motion.world.push_back({a, b, c});
    }
    const JointKeys keys = keys_of(motion, 0.1 * degree, true);
    REQUIRE(keys.in_shorts());
    CHECK(keys.count(1) == 0);
    CHECK(largest_error(keys, motion) <= 0.1 * degree + 1e-6);
}

TEST_CASE("a turn at a constant rate needs its two ends, on to a turn more than half around") {
    for (const double rate : {0.001, 0.02, 0.1}) {
        Motion motion;
        motion.parent = {-1};
        motion.drawn = {Quat::Identity()};
        const std::size_t frames = 31; // up to 3 rad, of which 0.1 rad a frame still is less than half a turn
        for (std::size_t f = 0; f < frames; ++f) motion.world.push_back({turn(rate * double(f), {1, 2, 3})});
        const JointKeys keys = keys_of(motion, 1e-3 * degree);
        CHECK(keys.count(0) == 2);
        CHECK(keys.has_key(0, 0));
        CHECK(keys.has_key(0, frames - 1));
    }
}

TEST_CASE("a still joint has no key, one that is still elsewhere has one, joint 0 has its ends") {
    Motion motion;
    motion.parent = {-1, 0, 0};
    motion.drawn = {turn(0.3, Vec3::UnitX()), turn(0.4, Vec3::UnitY()), turn(0.5, Vec3::UnitZ())};
    const Quat moved = motion.drawn[2] * turn(0.2, Vec3::UnitX());
    for (int f = 0; f < 20; ++f)
        motion.world.push_back({motion.drawn[0], motion.drawn[0] * motion.drawn[1], motion.drawn[0] * moved});
    const JointKeys keys = keys_of(motion, 0.1 * degree);
    CHECK(keys.count(0) == 2);
    CHECK(keys.count(1) == 0);
    CHECK(keys.count(2) == 1);
    CHECK(largest_error(keys, motion) < 1e-6);
}

TEST_CASE("one frame, no frame, no motion at all") {
    Motion motion = swinging(10, 1, 3, 0.5);
    CHECK(keys_of(motion, 0).count() == 10);
    CHECK(largest_error(keys_of(motion, 0.1 * degree), motion) <= 0.1 * degree + 1e-6);
    motion.world.clear();
    CHECK(keys_of(motion, 0.1 * degree).count() == 0);
    CHECK(keys_of(motion, 0).count() == 0);
}

TEST_CASE("keys do not depend on the number of threads") {
    const Motion motion = swinging(400, 40, 4, 0.4);
    const ThreadLimit alone(1);
    const JointKeys one = keys_of(motion, 0.2 * degree), shorts = keys_of(motion, 0.2 * degree, true);
    CHECK(one.count() < 400 * 40);
    for (const int threads : {2, 3, 8}) {
        const ThreadLimit limit(threads);
        const JointKeys many = keys_of(motion, 0.2 * degree), also = keys_of(motion, 0.2 * degree, true);
        for (std::size_t j = 0; j < one.joints(); ++j) CHECK(shorts.short_keys(j) == also.short_keys(j));
        std::size_t differing = 0;
        for (std::size_t j = 0; j < one.joints(); ++j) {
            if (one.key_bits(j) != many.key_bits(j)) {
                ++differing;
                continue;
            }
            for (std::size_t f = 0; f < one.frames(); ++f)
                if (one.has_key(j, f)) differing += one.key(j, f).coeffs() != many.key(j, f).coeffs();
        }
        CHECK(differing == 0);
    }
}
