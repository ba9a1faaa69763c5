#include "joint_keys.h"
#include "../base/parallel.h"
#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <numbers>
#include <numeric>

namespace bough {
namespace {

using Vec4 = Eigen::Vector4d;
using Rotations = std::vector<Vec4>; // unit quaternions x y z w over frames, neighbours less than a half turn apart

// Turns within an angle of each other: 1 - |cos(angle / 2)| = 2 sin^2(angle / 4).
struct Closeness {
    double most;
    explicit Closeness(double angle) {
        const double s = std::sin(std::min(angle, std::numbers::pi) / 4); // turns are half a turn at most
        most = 2 * s * s;
    }
    bool operator()(const Vec4& a, const Vec4& b) const { return 1 - std::abs(a.dot(b)) <= most; }
};

// slerp from `from` to `to` over a number of frames, as a turn of unit 4-vectors in the plane that holds both.
class Slerp {
public:
    Slerp(const Vec4& from, const Vec4& to, std::size_t frames) : from_(from) {
        const Vec4 near = from.dot(to) < 0 ? Vec4(-to) : to;
        const double angle = 2 * std::atan2((near - from).norm(), (near + from).norm());
        across_ = near - from * from.dot(near);
        const double length = across_.norm();
        if (length > 0) across_ /= length;
        cos_ = std::cos(angle / double(frames));
        sin_ = std::sin(angle / double(frames));
    }
    Vec4 next() {
        const double c = c_ * cos_ - s_ * sin_;
        s_ = s_ * cos_ + c_ * sin_;
        c_ = c;
        return c_ * from_ + s_ * across_;
    }

private:
    Vec4 from_, across_;
    double cos_, sin_, c_ = 1, s_ = 0;
};

// keys: what a key at each frame would be.
bool reproduces(const Rotations& wanted, const Rotations& keys, std::size_t a, std::size_t b, const Closeness& close) {
    Slerp slerp(keys[a], keys[b], b - a);
    for (std::size_t f = a + 1; f < b; ++f)
        if (!close(slerp.next(), wanted[f])) return false;
    return true;
}

// The farthest frame that one slerp from frame `a` can reach: doubled while it can, then halved into the gap.
std::size_t farthest(const Rotations& wanted, const Rotations& keys, std::size_t a, const Closeness& close) {
    const std::size_t last = wanted.size() - 1;
    std::size_t reached = a + 1, step = 2, beyond = last + 1;
    while (reached < last) {
        const std::size_t next = std::min(a + step, last);
        if (!reproduces(wanted, keys, a, next, close)) {
            beyond = next;
            break;
        }
        reached = next;
        step *= 2;
    }
    while (beyond - reached > 1) {
        const std::size_t middle = (reached + beyond) / 2;
        (reproduces(wanted, keys, a, middle, close) ? reached : beyond) = middle;
    }
    return reached;
}

bool all_close(const Rotations& wanted, const Vec4& to, const Closeness& close) {
    return std::all_of(wanted.begin(), wanted.end(), [&](const Vec4& w) { return close(w, to); });
}

constexpr double short_one = 32767;

ShortRotation rounded(const Vec4& q) {
    const Vec4 below = (q * short_one).array().floor();
    Vec4 best = below;
    double least = std::numeric_limits<double>::infinity();
    for (unsigned above = 0; above < 16; ++above) {
        Vec4 corner = below;
        for (unsigned k = 0; k < 4; ++k) corner[k] += above >> k & 1;
        const double off = std::abs(corner.squaredNorm() - short_one * short_one);
        if (off >= least || corner.cwiseAbs().maxCoeff() > short_one) continue;
        best = corner;
        least = off;
    }
    ShortRotation shorts;
    for (unsigned k = 0; k < 4; ++k) shorts[k] = std::int16_t(best[k]);
    return shorts;
}

Vec4 numbers_of(const ShortRotation& q) {
    return Vec4(q[0], q[1], q[2], q[3]) / short_one;
}

// What is rounded to keys. A loop ends as it begins but for float, which must not become a step of shorts.
Rotations key_sources(const Rotations& wanted) {
    Rotations sources(wanted);
    const Closeness same(1e-5);
    if (same(wanted.front(), wanted.back()))
        sources.back() = wanted.front().dot(wanted.back()) < 0 ? Vec4(-wanted.front()) : wanted.front();
    return sources;
}

// Joints by depth: those of one depth depend on shallower ones only.
std::vector<std::vector<std::int32_t>> by_depth(const std::vector<std::int32_t>& parent) {
    std::vector<std::vector<std::int32_t>> depths;
    std::vector<std::size_t> depth(parent.size());
    for (std::size_t j = 0; j < parent.size(); ++j) {
        depth[j] = parent[j] < 0 ? 0 : depth[std::size_t(parent[j])] + 1;
        if (depth[j] == depths.size()) depths.emplace_back();
        depths[depth[j]].push_back(std::int32_t(j));
    }
    return depths;
}

} // namespace

JointKeys::JointKeys(std::vector<std::int32_t> parent, std::vector<Quat> drawn)
    : parent_(std::move(parent)), drawn_(std::move(drawn)) {}

void JointKeys::add(const std::vector<Quat>& rotations) {
    assert(rotations.size() == joints() && bits_.empty());
    if (frames_ % tile == 0) tiles_.emplace_back(joints() * tile);
    for (std::size_t j = 0; j < joints(); ++j) world(j, frames_) = rotations[j].cast<float>();
    ++frames_;
}

Eigen::Quaterniond JointKeys::local(std::size_t joint, std::size_t frame) const {
    const Eigen::Quaterniond own(world(joint, frame).cast<double>());
    if (parent_[joint] < 0) return own.normalized();
    const Eigen::Quaterniond above(world(std::size_t(parent_[joint]), frame).cast<double>());
    return (above.conjugate() * own).normalized();
}

void JointKeys::set_key(std::size_t joint, std::size_t frame) {
    char& byte = bits_[joint * ((frames_ + 7) / 8) + frame / 8];
    byte = char(byte | (1 << (frame % 8)));
}

void JointKeys::thin_joint(std::size_t joint, double tolerance) {
    const Closeness close(tolerance);
    const auto as_key = [&](const Vec4& q) { return in_shorts() ? Vec4(numbers_of(rounded(q)).normalized()) : q; };
    const auto add_key = [&](const Vec4& q, std::size_t frame) {
        set_key(joint, frame);
        if (in_shorts()) shorts_[joint].push_back(rounded(q));
    };
    Rotations wanted(frames_);
    Vec4 mean = Vec4::Zero();
    for (std::size_t f = 0; f < frames_; ++f) {
        wanted[f] = local(joint, f).coeffs();
        if (f > 0 && wanted[f].dot(wanted[f - 1]) < 0) wanted[f] = -wanted[f];
        mean += wanted[f];
    }
    mean.normalize();
    const Vec4 drawn = drawn_[joint].coeffs();
    const bool has_ends = joint == 0; // they say how long the motion lasts
    const Vec4 still = has_ends ? as_key(drawn) : drawn;
    const bool is_still = all_close(wanted, still, close);
    if (is_still || all_close(wanted, as_key(mean), close)) {
        const Vec4& at = is_still ? drawn : mean;
        if (has_ends || !is_still) add_key(at, 0);
        if (has_ends && frames_ > 1) add_key(at, frames_ - 1);
        std::fill(wanted.begin(), wanted.end(), is_still ? still : as_key(mean));
    } else {
        const Rotations sources = in_shorts() ? key_sources(wanted) : wanted;
        Rotations keys(sources);
        for (Vec4& key : keys) key = as_key(key);
        add_key(sources[0], 0);
        for (std::size_t a = 0; a + 1 < frames_;) {
            const std::size_t b = farthest(wanted, keys, a, close);
            add_key(sources[b], b);
            Slerp slerp(keys[a], keys[b], b - a);
            for (std::size_t f = a + 1; f < b; ++f) wanted[f] = slerp.next();
            a = b;
        }
        for (std::size_t f = 0; f < frames_; ++f)
            if (has_key(joint, f)) wanted[f] = keys[f];
    }
    for (std::size_t f = 0; f < frames_; ++f) {
        Eigen::Quaterniond made(wanted[f]);
        if (parent_[joint] >= 0) made = Eigen::Quaterniond(world(std::size_t(parent_[joint]), f).cast<double>()) * made;
        world(joint, f) = Rotation(made.normalized().cast<float>());
    }
}

void JointKeys::thin(double tolerance, bool shorts) {
    assert(bits_.empty());
    bits_.assign(joints() * ((frames_ + 7) / 8), '\0');
    if (frames_ == 0) return;
    if (!(tolerance > 0)) {
        for (std::size_t f = 0; f < frames_; ++f) set_key(0, f);
        const std::size_t row = (frames_ + 7) / 8;
        for (std::size_t j = 1; j < joints(); ++j)
            std::copy_n(bits_.begin(), row, bits_.begin() + std::ptrdiff_t(j * row));
        return;
    }
    if (shorts && tolerance >= 8 * short_turning) shorts_.resize(joints());
    for (const std::vector<std::int32_t>& level : by_depth(parent_)) {
        constexpr double frame_ns = 100;
        parallel_for(level.size(), frame_ns * double(frames_),
                     [&](std::size_t k) { thin_joint(std::size_t(level[k]), tolerance); });
    }
}

std::string_view JointKeys::key_bits(std::size_t joint) const {
    const std::size_t row = (frames_ + 7) / 8;
    return std::string_view(bits_).substr(joint * row, row);
}

std::size_t JointKeys::count(std::size_t joint) const {
    std::size_t keys = 0;
    for (const char byte : key_bits(joint)) keys += std::size_t(std::popcount(static_cast<unsigned char>(byte)));
    return keys;
}

std::size_t JointKeys::count() const {
    std::size_t keys = 0;
    for (std::size_t j = 0; j < joints(); ++j) keys += count(j);
    return keys;
}

Quaternion<float> JointKeys::key(std::size_t joint, std::size_t frame) const {
    return Rotation(local(joint, frame).cast<float>());
}

} // namespace bough
