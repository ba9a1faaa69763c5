// joint_keys.h: rotations of joints over the frames of a motion, and which of them an animation needs.
//
// A joint's key at a frame is its rotation from its parent joint's frame. Between keys a player turns at a constant rate
// (slerp). thin() keeps the first and last frame of a joint and, in between, as few keys as a greedy search needs, so that
// at every frame **the joint's world rotation**, as a player works it out from the keys of the whole path, is within
// `tolerance` of the true one, but for the float keys' own rounding, 1e-7 rad a joint of the path. A joint's keys are chosen against what
// the keys already chosen make of its parent; so the angles' errors do not add up along a path, and what stands at the end of a path of
// length l is misplaced by at most 2 sin(tolerance / 2) l. A joint that one constant rotation serves has one key, or none where the drawn
// rotation does; only joint 0 always keeps its first and last, which say how long the motion lasts.
// Keys may be rounded to shorts, 8 bytes a key: an integer over 32767 each of x, y, z, w, the nearest one below or above, such that the length
// differs least from 1. That turns a joint by less than short_turning, which is within the tolerance as all else: it does not add up along a path.
// Rotations are kept in float, 16 bytes a joint and frame. thin() is O(joints * frames), times the logarithm of the distance of keys;
// joints of one depth are worked out at once, each alone, so that the thread count cannot change the result.
#pragma once
#include "../base/math.h"
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace bough {

using ShortRotation = std::array<std::int16_t, 4>; // x y z w, over 32767
inline constexpr double short_turning = 1.3e-4; // [rad] is more than 2 sqrt(4) / 32767, by a share for floats' rounding

class JointKeys {
public:
    // parent[j] < j or -1; drawn: parent joint's frame (roots: world) from own.
    JointKeys(std::vector<std::int32_t> parent, std::vector<Quat> drawn);

    // One frame: world from joint frame.
    void add(const std::vector<Quat>& world);
    std::size_t joints() const { return parent_.size(); }
    std::size_t frames() const { return frames_; }

    // After the last frame, once. tolerance [rad]; 0 keeps every key. Keys are rounded to shorts where `shorts` and the tolerance is 8 times what
    // that turns a joint by, or more.
    void thin(double tolerance, bool shorts = false);

    // After thin(). Frames where the joint has a key, rising: a bit each in whole bytes, from the lowest bit up; joints with
    // keys at the same frames have the same bytes.
    std::string_view key_bits(std::size_t joint) const;
    bool has_key(std::size_t joint, std::size_t frame) const { return key_bits(joint)[frame / 8] >> (frame % 8) & 1; }
    std::size_t count(std::size_t joint) const;
    std::size_t count() const; // of all joints
    // Parent joint's frame (roots: world) from own, at a frame where it has a key.
    Quaternion<float> key(std::size_t joint, std::size_t frame) const;
    // Whether keys were rounded; then those of a joint, in the order of its frames.
    bool in_shorts() const { return !shorts_.empty(); }
    const std::vector<ShortRotation>& short_keys(std::size_t joint) const { return shorts_[joint]; }

private:
    using Rotation = Quaternion<float>;
    // 16 frames of a joint stand together: written frame by frame, read joint by joint.
    static constexpr std::size_t tile = 16;
    Rotation& world(std::size_t joint, std::size_t frame) { return tiles_[frame / tile][joint * tile + frame % tile]; }
    const Rotation& world(std::size_t joint, std::size_t frame) const {
        return tiles_[frame / tile][joint * tile + frame % tile];
    }
    Eigen::Quaterniond local(std::size_t joint, std::size_t frame) const;
    void thin_joint(std::size_t joint, double tolerance);
    void set_key(std::size_t joint, std::size_t frame);

    std::vector<std::int32_t> parent_;
    std::vector<Quat> drawn_;
    std::vector<std::vector<Rotation>> tiles_; // after thin(): what the keys make of them
    std::size_t frames_ = 0;
    std::string bits_;
    std::vector<std::vector<ShortRotation>> shorts_; // of each joint; empty: keys are floats
};

} // namespace bough
