// Statistics of motions whose figures are known in closed form.
#include "lib/study/motion_statistics.h"
#include "lib/model/drawn_pose.h"
#include "tests/support/make_tree.h"
#include <catch2/catch.hpp>
#include <functional>
#include <numbers>

using namespace bough;

namespace {

using std::numbers::pi;
constexpr double fps = 30;

// An upright pole of two pieces of half a metre with a branch of level 1 and two leaves.
struct Stand {
    Tree tree;
    std::size_t top = 1, branch = 2, leaf = 3;
    Stand() {
        using namespace make_tree;
        add_piece(tree, -1, Vec3::Zero(), upright(), 0.5, 0.03, 0.03, 0, 0, 0);
        add_piece(tree, 0, {0, 0, 0.5}, Quat::Identity(), 0.5, 0.03, 0.03, 0, 0, 0.5);
        add_piece(tree, 0, {0, 0, 0.5}, turn(1, Vec3::UnitX()), 0.4, 0.01, 0.01, 1, 1, 0);
        for (int k = 0; k < 2; ++k) add_leaf(tree, 2, {0, 0, 0.3}, Quat::Identity(), 0.1, 0.05, 2e-4, 1, 1, 0.8);
    }
};

struct Frame {
    std::vector<Vec3> x, theta;
    std::vector<Mat3> R;
};

// Frames 0 to n, each changed from the drawn pose by `move` at its time.
MotionSummary motion_of(const Tree& tree, int n, const std::function<void(double, Frame&)>& move, double rate = fps) {
    const DrawnPose drawn = drawn_pose(tree);
    MotionStatistics statistics(tree, rate);
    for (int k = 0; k <= n; ++k) {
        Frame f{drawn.x_w, std::vector<Vec3>(drawn.x_w.size(), Vec3::Zero()), drawn.R_wb};
        move(k / rate, f);
        statistics.add(f.x, f.R, f.theta);
    }
    return statistics.result();
}

Mat3 turned(double angle, const Vec3& axis) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

} // namespace

TEST_CASE("the trunk's top: mean lean, standard deviation and peak of a leaning, swaying pole") {
    const Stand s;
    REQUIRE(trunk_top(s.tree) == s.top);
    // Whole periods: 2 Hz over 2 s. The start is upright.
    const MotionSummary m = motion_of(s.tree, 60, [&](double t, Frame& f) {
        if (t > 0) f.x[s.top] += Vec3(0.3 + 0.05 * std::sin(4 * pi * t), 0, 0.4);
    });
    CHECK(m.frames == 60);
    CHECK(m.top.lean == Approx(0.5));
    CHECK(m.top.spread == Approx(0.05 / std::sqrt(2.0)));
    // The nearest frames to the crest, of 15 a period, lie 6 degrees off it.
    CHECK(m.top.peak == Approx(std::hypot(0.3 + 0.05 * std::cos(pi / 30), 0.4)));
    // Level 0 has two bodies, of which one moves; level 1 one, which does not.
    REQUIRE(m.level_spread.size() == 2);
    CHECK(m.level_spread[0] == Approx(0.05 / std::sqrt(2.0) / std::sqrt(2.0)));
    CHECK(m.level_spread[1] == Approx(0).margin(1e-12));
}

TEST_CASE("leaves: standard deviations of the three angles, RMS over the leaves") {
    const Stand s;
    const MotionSummary m = motion_of(s.tree, 60, [&](double t, Frame& f) {
        f.theta[s.leaf] = Vec3(1 + 0.3 * std::sin(2 * pi * 3 * t), 0.2 * std::cos(2 * pi * 2 * t), 0.7);
        f.theta[s.leaf + 1] = Vec3(-2, 0, 0.1 * std::sin(2 * pi * t));
    });
    CHECK(m.leaves.spread.x() == Approx(0.3 / 2));
    CHECK(m.leaves.spread.y() == Approx(0.2 / 2));
    CHECK(m.leaves.spread.z() == Approx(0.1 / 2));
}

TEST_CASE("a spectrum has a flapping leaf's power in the band of its frequency") {
    const Stand s;
    const double a = 0.02;
    for (const double frequency : {0.5, 3.4, 9.5, 14.3}) {
        CAPTURE(frequency);
        const MotionSummary m = motion_of(s.tree, 120, [&](double t, Frame& f) {
            const Mat3 flap = turned(a * std::sin(2 * pi * frequency * t), Vec3::UnitX());
            for (int k = 0; k < 2; ++k) f.R[s.leaf + std::size_t(k)] *= flap;
        });
        REQUIRE(m.leaves.spectrum.size() == 15);
        double sum = 0;
        for (const double power : m.leaves.spectrum) sum += power;
        CHECK(sum == Approx(a * a / 2).epsilon(0.01));
        CHECK(m.leaves.spectrum[std::size_t(frequency)] > 0.97 * sum);
    }
}

TEST_CASE("bands end at half the frame rate, and at 15 Hz") {
    const Stand s;
    const auto still = [](double, Frame&) {};
    CHECK(motion_of(s.tree, 24, still, 24).leaves.spectrum.size() == 12);
    CHECK(motion_of(s.tree, 120, still, 120).leaves.spectrum.size() == 15);
    // 20 Hz at 120 frames a second is above the bands, not in the last one.
    const MotionSummary m = motion_of(
        s.tree, 240,
        [&](double t, Frame& f) { f.R[s.leaf] *= turned(0.02 * std::sin(2 * pi * 20 * t), Vec3::UnitX()); }, 120);
    for (const double power : m.leaves.spectrum) CHECK(power < 1e-8);
}

TEST_CASE("spectra differ by the share of the power that lies elsewhere") {
    LeafMotion a, b;
    a.spectrum = {1, 3, 0};
    b.spectrum = {1, 2, 2};
    CHECK(spectrum_difference(a, a) == 0);
    CHECK(spectrum_difference(a, b) == Approx(3.0 / 5));
    CHECK(spectrum_difference(b, a) == Approx(3.0 / 4));
    LeafMotion still;
    still.spectrum = {0, 0, 0};
    CHECK(spectrum_difference(still, a) == 1);
    CHECK(std::isnan(spectrum_difference(a, still)));
    CHECK(std::isnan(spectrum_difference(LeafMotion(), a)));
}

TEST_CASE("a leaf's turn a frame is the angle between its directions, and those above 30 degrees are counted") {
    const Stand s;
    // One leaf turns by 20 degrees a frame, the other by 40 about another axis.
    const Vec3 axis = Vec3(1, 2, 2) / 3;
    const MotionSummary m = motion_of(s.tree, 50, [&](double t, Frame& f) {
        f.R[s.leaf] = turned(t * fps * pi / 9, Vec3::UnitY()) * f.R[s.leaf];
        f.R[s.leaf + 1] = turned(t * fps * 2 * pi / 9, axis) * f.R[s.leaf + 1];
    });
    CHECK(m.leaves.turn == Approx(pi / 6));
    CHECK(m.leaves.fast == Approx(0.5));
    CHECK(m.last_rate == Approx(2 * pi / 9 * fps));
    // Small turns are known to their last digits.
    const MotionSummary slow =
        motion_of(s.tree, 10, [&](double t, Frame& f) { f.R[s.leaf] = turned(t * fps * 1e-7, axis) * f.R[s.leaf]; });
    CHECK(slow.last_rate == Approx(1e-7 * fps).epsilon(1e-6));
    CHECK(slow.leaves.fast == 0);
}

TEST_CASE("a frame is still when every end moves slower than a millimetre a second") {
    const Stand s;
    // Frames 1 to 10 move by 0.9 mm/s, 11 to 20 by 1.1 mm/s, and 21 to 30 a leaf's end by its turning alone.
    const MotionSummary m = motion_of(s.tree, 30, [&](double t, Frame& f) {
        const double slow = std::min(t, 10 / fps), quick = std::clamp(t - 10 / fps, 0.0, 10 / fps);
        for (Vec3& x : f.x) x.x() += 9e-4 * slow + 1.1e-3 * quick;
        const double last = std::max(0.0, t - 20 / fps);
        f.R[s.leaf] = turned(last * 0.02, Vec3::UnitX()) * f.R[s.leaf]; // up to 2 mm/s at its end of 0.1 m
    });
    CHECK(m.still == 10);
}

TEST_CASE("a frame is still by velocities where they are given: one that stops at each frame's end is") {
    const Stand s;
    const DrawnPose drawn = drawn_pose(s.tree);
    const std::vector<Vec3> theta(drawn.x_w.size(), Vec3::Zero());
    MotionStatistics statistics(s.tree, fps);
    for (int k = 0; k <= 10; ++k) {
        std::vector<Vec3> x = drawn.x_w, v(x.size(), Vec3(0, 9e-4, 0));
        x[s.top].x() += k % 2; // far and back
        if (k == 4) v[s.leaf] = Vec3(8e-4, 8e-4, 0);
        statistics.add(x, drawn.R_wb, theta, v);
    }
    CHECK(statistics.result().still == 9);
}

TEST_CASE("what is not there has no figure") {
    const Tree pole = make_tree::chain(3, 2, 0.03, 0.03);
    const MotionSummary m = motion_of(pole, 4, [](double, Frame&) {});
    CHECK(m.still == 4);
    CHECK(m.top.spread == 0);
    CHECK(std::isnan(m.leaves.turn));
    CHECK(m.leaves.spectrum.empty());
    const MotionSummary none = motion_of(pole, 0, [](double, Frame&) {});
    CHECK(none.frames == 0);
    CHECK(std::isnan(none.top.spread));
    CHECK(std::isnan(none.last_rate));
}

TEST_CASE("the trunk's top is the highest end of level 0, of a branch's last piece") {
    const Tree low = make_tree::chain(3, 2, 0.03, 0.03), high = make_tree::chain(4, 5, 0.03, 0.03);
    const Tree both = make_tree::forest({low, high});
    CHECK(trunk_top(both) == both.size_bodies() - 1);
}
