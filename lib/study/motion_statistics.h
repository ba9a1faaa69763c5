// motion_statistics.h: what one run's motion is like, from its frames: of the trunk's top, of the wood level by level, of the
// leaves. A chaotic leaf has no right place, but it has a right spread, rate and spectrum.
//
// The first frame is the start: displacements are from it, and it is not counted. Positions are of bodies' far ends (their
// length along z). Standard deviations are over the frames after the start.
//
// Spectrum of the leaves: of the leaf's normal (body y) in world axes, its three components summed, which a turn by a small
// angle moves by that angle, and which does not jump at half a turn. Mean removed, Hann window (Welch, P. D. 1967, The use of
// the fast Fourier transform for the estimation of power spectra, IEEE Trans. Audio Electroacoust. 15), one segment, one-sided,
// summed over bands of 1 Hz to 15 Hz or half the frame rate, whichever is less. The sum of the bands is the variance: a leaf
// that flaps as a sin(2 pi f t) has a^2 / 2 in the band of f. What is faster than half the frame rate is seen in the band
// that it is folded to.
#pragma once
#include "../model/tree.h"
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace bough {

struct TopMotion {
    double lean = NAN, spread = NAN, peak = NAN; // [m] mean displacement's length; standard deviation, of the three
                                                 // axes together; largest displacement
};

struct LeafMotion {
    // [rad] standard deviation of theta about x, y, z: flap, sway, twist; RMS over leaves
    Vec3 spread = Vec3::Constant(NAN);
    double turn = NAN;            // [rad] mean angle between a leaf's directions in successive frames
    double fast = NAN;            // [1] share of leaves and frames in which that is above 30 degrees
    std::vector<double> spectrum; // [1] band k: k to k + 1 Hz; mean over leaves
};

// A figure of what is not there (no trunk, no leaf, no frame after the start) is NAN.
struct MotionSummary {
    std::int64_t frames = 0; // after the start
    TopMotion top;
    std::vector<double> level_spread; // [m] of wood's ends by branch level, RMS over bodies; NAN: no wood of that level
    LeafMotion leaves;
    std::int64_t still = 0; // frames in which every body's end is slower than 1 mm/s
    double last_rate = NAN; // [rad/s] the fastest body's turn to the last frame
};

// Sum of the bands' differences over the sum of the truth's: 0 for the same, 1 for a leaf that does not move. NAN where
// either has none, or other bands.
double spectrum_difference(const LeafMotion&, const LeafMotion& truth);

// Wood: bodies of Kind::branch. Leaves: those of Kind::leaf and Kind::petal.
std::vector<std::size_t> wood_bodies(const Tree&);
std::vector<std::size_t> leaf_bodies(const Tree&);
// The end of the trunk that is highest where it is drawn; none: bodies without wood of level 0.
std::optional<std::size_t> trunk_top(const Tree&);

class MotionStatistics {
public:
    // Keeps a reference to the tree. fps: of the frames that will be added.
    MotionStatistics(const Tree&, double fps);

    // One frame: own joints [m] and world from body, theta [rad] in joint axes; of every body. v [m/s]: their ends' velocities,
    // by which a frame is still. Where they are left out, it is by how far the ends have come since the last frame. That does not see a
    // run that is stopped at each frame's end and thrown on from there.
    void add(const std::vector<Vec3>& x, const std::vector<Mat3>& R, const std::vector<Vec3>& theta,
             const std::vector<Vec3>& v = {});

    const Tree& tree() const { return tree_; }
    // O(leaves x frames^2). Memory: 24 bytes a leaf and frame.
    MotionSummary result() const;

private:
    // Of values about the first one added, so that large ones cost no digits.
    struct Spread {
        Vec3 first = Vec3::Zero(), sum = Vec3::Zero(), squares = Vec3::Zero();
        void add(const Vec3&);
        Vec3 variance(double count) const;
    };

    const Tree& tree_;
    double fps_;
    std::vector<std::size_t> wood_, leaves_;
    std::optional<std::size_t> top_;
    std::vector<Vec3> end_;                  // of the last frame
    std::vector<Mat3> R_;                    // of the last frame
    std::vector<Spread> wood_spread_;        // of each wood body's end
    std::vector<Spread> leaf_spread_;        // of each leaf's theta
    std::vector<std::vector<Vec3>> normals_; // frames x leaves
    std::int64_t added_ = 0, still_ = 0, fast_ = 0;
    double turned_ = 0, last_rate_ = NAN, peak_ = NAN; // [rad] sum, [rad/s], [m]
    Vec3 top_start_ = Vec3::Zero();
    Spread top_spread_;
};

} // namespace bough
