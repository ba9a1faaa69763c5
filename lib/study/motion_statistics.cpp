#include "motion_statistics.h"
#include "../model/drawn_pose.h"
#include <algorithm>
#include <numbers>

namespace bough {
namespace {

constexpr double still_speed = 1e-3;                     // [m/s]
constexpr double fast_turn = std::numbers::pi / 6;       // [rad] a frame
constexpr double highest_frequency = 15, band_width = 1; // [Hz]

// Angle of a turn from A to B, to rounding also where it is small; |A - B| = sqrt(8) |sin(angle / 2)|.
double turn_between(const Mat3& A, const Mat3& B) {
    return 2 * std::asin(std::min(1.0, (A - B).norm() / std::sqrt(8.0)));
}

// Periodogram of samples of unit vectors, in bands (motion_statistics.h).
class Periodogram {
public:
    Periodogram(std::size_t frames, double fps)
        : bands_(std::size_t(std::ceil(std::min(highest_frequency, fps / 2) / band_width))), fps_(fps), window_(frames),
          cosine_(frames), sine_(frames) {
        const double turn = 2 * std::numbers::pi / double(frames);
        for (std::size_t k = 0; k < frames; ++k) {
            cosine_[k] = std::cos(turn * double(k));
            sine_[k] = std::sin(turn * double(k));
            window_[k] = (1 - std::cos(turn * (double(k) + 0.5))) / 2; // half a sample in: no sample is weighed by 0
            weight_ += window_[k];
            power_ += window_[k] * window_[k];
        }
    }
    std::size_t bands() const { return bands_; }
    void add(const std::vector<std::vector<Vec3>>& frames, std::size_t leaf, std::vector<double>& spectrum) const {
        const std::size_t n = window_.size();
        Vec3 mean = Vec3::Zero();
        for (std::size_t k = 0; k < n; ++k) mean += window_[k] / weight_ * frames[k][leaf];
        std::vector<Vec3> x(n);
        for (std::size_t k = 0; k < n; ++k) x[k] = window_[k] * (frames[k][leaf] - mean);
        for (std::size_t f = 1; f <= n / 2; ++f) {
            const double frequency = double(f) * fps_ / double(n);
            if (frequency > highest_frequency) break;
            Vec3 re = Vec3::Zero(), im = Vec3::Zero();
            for (std::size_t k = 0, at = 0; k < n; ++k, at = at + f < n ? at + f : at + f - n) {
                re += cosine_[at] * x[k];
                im += sine_[at] * x[k];
            }
            const double both_sides = 2 * f == n ? 1 : 2;
            const auto band = std::min(bands_ - 1, std::size_t(frequency / band_width));
            spectrum[band] += both_sides * (re.squaredNorm() + im.squaredNorm()) / (double(n) * power_);
        }
    }

private:
    std::size_t bands_;
    double fps_, weight_ = 0, power_ = 0;
    std::vector<double> window_, cosine_, sine_;
};

} // namespace

double spectrum_difference(const LeafMotion& run, const LeafMotion& truth) {
    if (run.spectrum.size() != truth.spectrum.size()) return NAN;
    double off = 0, all = 0;
    for (std::size_t k = 0; k < truth.spectrum.size(); ++k) {
        off += std::abs(run.spectrum[k] - truth.spectrum[k]);
        all += truth.spectrum[k];
    }
    return all > 0 ? off / all : NAN;
}

std::vector<std::size_t> wood_bodies(const Tree& tree) {
    std::vector<std::size_t> wood;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] == Kind::branch) wood.push_back(i);
    return wood;
}

std::vector<std::size_t> leaf_bodies(const Tree& tree) {
    std::vector<std::size_t> leaves;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (is_flat(tree.kind[i])) leaves.push_back(i);
    return leaves;
}

std::optional<std::size_t> trunk_top(const Tree& tree) {
    const DrawnPose drawn = drawn_pose(tree);
    std::vector<bool> goes_on(tree.size_bodies(), false);
    for (std::size_t i = 0; i < goes_on.size(); ++i)
        if (continues_parent(tree, i)) goes_on[std::size_t(tree.parent[i])] = true;
    std::optional<std::size_t> top;
    double highest = -INFINITY;
    for (std::size_t i = 0; i < goes_on.size(); ++i) {
        if (goes_on[i] || tree.kind[i] != Kind::branch || tree.level[i] != 0) continue;
        const double y = drawn.x_w[i].y() + drawn.R_wb[i](1, 2) * tree.size[i][0];
        if (y > highest) highest = y, top = i;
    }
    return top;
}

void MotionStatistics::Spread::add(const Vec3& value) {
    sum += value - first;
    squares += (value - first).cwiseAbs2();
}

Vec3 MotionStatistics::Spread::variance(double count) const {
    return (squares / count - (sum / count).cwiseAbs2()).cwiseMax(0);
}

MotionStatistics::MotionStatistics(const Tree& tree, double fps)
    : tree_(tree), fps_(fps), wood_(wood_bodies(tree)), leaves_(leaf_bodies(tree)), top_(trunk_top(tree)),
      wood_spread_(wood_.size()), leaf_spread_(leaves_.size()) {}

void MotionStatistics::add(const std::vector<Vec3>& x, const std::vector<Mat3>& R, const std::vector<Vec3>& theta,
                           const std::vector<Vec3>& v) {
    std::vector<Vec3> end(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) end[i] = x[i] + R[i].col(2) * tree_.size[i][0];
    const bool start = added_++ == 0;
    if (start) {
        for (std::size_t k = 0; k < wood_.size(); ++k) wood_spread_[k].first = end[wood_[k]];
        for (std::size_t k = 0; k < leaves_.size(); ++k) leaf_spread_[k].first = theta[leaves_[k]];
        if (top_) top_spread_.first = top_start_ = end[*top_];
    } else {
        double fastest = 0, rate = 0;
        for (std::size_t i = 0; i < end.size(); ++i) {
            fastest = std::max(fastest, v.empty() ? fps_ * (end[i] - end_[i]).norm() : v[i].norm());
            rate = std::max(rate, turn_between(R_[i], R[i]));
        }
        still_ += fastest < still_speed;
        last_rate_ = rate * fps_;
        for (std::size_t k = 0; k < wood_.size(); ++k) wood_spread_[k].add(end[wood_[k]]);
        normals_.emplace_back(leaves_.size());
        for (std::size_t k = 0; k < leaves_.size(); ++k) {
            const std::size_t i = leaves_[k];
            const double turn = turn_between(R_[i], R[i]);
            turned_ += turn;
            fast_ += turn > fast_turn;
            leaf_spread_[k].add(theta[i]);
            normals_.back()[k] = R[i].col(1);
        }
        if (top_) {
            top_spread_.add(end[*top_]);
            peak_ = std::fmax(peak_, (end[*top_] - top_start_).norm());
        }
    }
    end_ = std::move(end);
    R_ = R;
}

MotionSummary MotionStatistics::result() const {
    MotionSummary m;
    m.frames = std::max<std::int64_t>(0, added_ - 1);
    m.still = still_;
    m.last_rate = last_rate_;
    if (m.frames == 0) return m;
    const auto count = double(m.frames);
    if (top_) {
        m.top.lean = (top_spread_.sum / count).norm();
        m.top.spread = std::sqrt(top_spread_.variance(count).sum());
        m.top.peak = peak_;
    }
    std::vector<double> bodies;
    for (std::size_t k = 0; k < wood_.size(); ++k) {
        const auto level = std::size_t(std::max(0, tree_.level[wood_[k]]));
        if (level >= bodies.size()) bodies.resize(level + 1, 0), m.level_spread.resize(level + 1, 0);
        bodies[level] += 1;
        m.level_spread[level] += wood_spread_[k].variance(count).sum();
    }
    for (std::size_t level = 0; level < bodies.size(); ++level)
        m.level_spread[level] = std::sqrt(m.level_spread[level] / bodies[level]);
    if (leaves_.empty()) return m;
    const auto all = double(leaves_.size());
    Vec3 variance = Vec3::Zero();
    for (const Spread& s : leaf_spread_) variance += s.variance(count) / all;
    m.leaves.spread = variance.cwiseSqrt();
    m.leaves.turn = turned_ / (all * count);
    m.leaves.fast = double(fast_) / (all * count);
    const Periodogram periodogram(normals_.size(), fps_);
    m.leaves.spectrum.assign(periodogram.bands(), 0);
    for (std::size_t k = 0; k < leaves_.size(); ++k) periodogram.add(normals_, k, m.leaves.spectrum);
    for (double& power : m.leaves.spectrum) power /= all;
    return m;
}

} // namespace bough
