#include "rustle.h"
#include "../base/parallel.h"
#include "random.h"
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace bough {
namespace {

using std::numbers::pi;

enum class RustleDraw : std::uint8_t {
    rustle = 220,
    axis,
    rate,
    phase,
    psi
}; // apart from the draws of growth (stem.h)

constexpr double kMost = 20 * pi / 180, kSpeed = 6; // of A(U)
constexpr double kFrequency = 1.45, kHighest = 4.2; // of f(U)
constexpr double kSecond = 0.62;
constexpr double kSlowest = 0.8, kFastest = 1.05; // c

// The axis of a leaf about which it turns, from the places of its upper face's corners.
struct PlacedBlade {
    Vec3 foot, axis;
};
PlacedBlade blade_of(const std::vector<Vec3>& position, std::size_t first, double off_width) {
    const Vec3* const p = position.data() + first;
    const Vec3 width = (p[2] - p[1]).normalized(), length = (p[3] - p[0]).normalized();
    return {(p[0] + p[leaf_vertices / 2]) / 2, std::cos(off_width) * width + std::sin(off_width) * length};
}

// The rate nearest to this one that comes to whole turns, at least one, where the path's phase comes to `phase`.
double closing(double rate, double phase) {
    if (!(phase > 0)) return rate;
    return std::max(1.0, std::round(rate * phase / (2 * pi))) * 2 * pi / phase;
}

} // namespace

double rustle_amplitude(double wind) {
    return -kMost * std::expm1(-wind * wind / (kSpeed * kSpeed));
}

double rustle_frequency(double wind) {
    return std::min(kFrequency * std::sqrt(std::max(wind, 0.0)), kHighest);
}

std::vector<std::int32_t> clumps_of(const Skin& skin) {
    std::vector<std::int32_t> clumps;
    for (const std::int32_t v : skin.clump_leaf)
        if (const std::int32_t body = skin.joint[std::size_t(v)][0]; clumps.empty() || clumps.back() != body)
            clumps.push_back(body);
    return clumps;
}

Rustle::Rustle(const Skin& skin, ClumpWind wind, const RustleOptions& options)
    : skin_(skin), wind_(std::move(wind)), fps_(options.fps), together_(options.together), clumps_(clumps_of(skin)) {
    std::int32_t clump = -1, number = 0;
    for (const std::int32_t v : skin.clump_leaf) {
        const std::int32_t body = skin.joint[std::size_t(v)][0];
        const bool next = clump < 0 || clumps_[std::size_t(clump)] != body;
        if (next) ++clump, number = 0;
        const RandomKey key = random_key(random_key(RandomKey{0}, RustleDraw::rustle, std::uint64_t(body)),
                                         RustleDraw::rustle, std::uint64_t(number++));
        const double c = together_ ? 1 : kSlowest + (kFastest - kSlowest) * random_unit(key, RustleDraw::rate);
        leaves_.push_back({together_ ? 0 : clump, pi / 4 * random_sign(key, RustleDraw::axis), c, kSecond * c,
                           2 * pi * random_unit(key, RustleDraw::phase), 2 * pi * random_unit(key, RustleDraw::psi)});
    }
    if (clumps_.empty()) return;
    amplitude_.resize(paths());
    rate_.resize(paths());
    phase_.assign(paths(), 0.0);
    advance();
    const double frames = options.period.value_or(0) * fps_;
    if (std::round(frames) < 1 || std::abs(frames - std::round(frames)) > 1e-6 * frames) return;
    go_to(std::llround(frames));
    for (Leaf& leaf : leaves_) {
        leaf.rate = closing(leaf.rate, phase_[std::size_t(leaf.clump)]);
        leaf.second = closing(leaf.second, phase_[std::size_t(leaf.clump)]);
    }
    frame_ = 0;
    phase_.assign(paths(), 0.0);
    advance();
}

// Speeds, and what goes with them, of frame_.
void Rustle::advance() {
    speed_.resize(clumps_.size());
    wind_(double(frame_) / fps_, speed_);
    if (together_) {
        double sum = 0;
        for (const double u : speed_) sum += u;
        speed_[0] = sum / double(speed_.size());
    }
    for (std::size_t k = 0; k < paths(); ++k) {
        amplitude_[k] = rustle_amplitude(speed_[k]);
        rate_[k] = 2 * pi * rustle_frequency(speed_[k]);
    }
}

void Rustle::go_to(std::int64_t frame) {
    if (clumps_.empty()) return;
    assert(frame >= frame_);
    while (frame_ < frame) {
        ++frame_;
        for (std::size_t k = 0; k < paths(); ++k) phase_[k] += rate_[k] / (2 * fps_);
        advance();
        for (std::size_t k = 0; k < paths(); ++k) phase_[k] += rate_[k] / (2 * fps_);
    }
}

void Rustle::turn(std::vector<Vec3>& position, std::vector<Vec3>& normal) const {
    constexpr double leaf_ns = 150;
    parallel_for(leaves_.size(), leaf_ns, [&](std::size_t k) {
        const Leaf& leaf = leaves_[k];
        const auto path = std::size_t(leaf.clump), first = std::size_t(skin_.clump_leaf[k]);
        const double theta = amplitude_[path] * (std::sin(leaf.rate * phase_[path] + leaf.phase) +
                                                 std::sin(leaf.second * phase_[path] + leaf.psi));
        if (theta == 0) return;
        const PlacedBlade blade = blade_of(position, first, leaf.off_width);
        const Mat3 R = Eigen::AngleAxisd(theta, blade.axis).toRotationMatrix();
        for (std::size_t v = first; v < first + leaf_vertices; ++v) {
            position[v] = blade.foot + R * (position[v] - blade.foot);
            normal[v] = R * normal[v];
        }
    });
}

std::array<double, Rustle::targets> Rustle::weights() const {
    assert(together_);
    if (clumps_.empty()) return {};
    const double phi = phase_[0] * leaves_[0].rate, psi = phase_[0] * leaves_[0].second, A = amplitude_[0];
    return {A * std::sin(phi), A * std::cos(phi), A * std::sin(psi), A * std::cos(psi)};
}

Vec3 Rustle::target(std::size_t leaf, std::size_t m) const {
    const Leaf& l = leaves_[leaf];
    const double phase = m < 2 ? l.phase : l.psi;
    const Vec3 axis = blade_of(skin_.position, std::size_t(skin_.clump_leaf[leaf]), l.off_width).axis;
    return (m % 2 == 0 ? std::cos(phase) : std::sin(phase)) * axis;
}

Vec3 Rustle::foot(std::size_t leaf) const {
    return blade_of(skin_.position, std::size_t(skin_.clump_leaf[leaf]), leaves_[leaf].off_width).foot;
}

} // namespace bough
