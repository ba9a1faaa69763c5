#include "formats/documents/document_parts.h"
#include "gltf_parts.h"
#include <memory>
#include <unordered_map>

namespace bough {
namespace {

// Times of keys, once for all joints with keys at the same frames.
struct KeyTimes {
    std::vector<std::size_t> joint; // one joint of each kind
    std::vector<int> accessor;
    std::unordered_map<std::string_view, std::size_t> kind;
};

float time_of(std::size_t frame, double fps) {
    return float(double(frame) / fps);
}

std::string time_bounds(const JointKeys& keys, std::size_t joint, double fps) {
    std::size_t first = 0, last = keys.frames() - 1;
    while (!keys.has_key(joint, first)) ++first;
    while (!keys.has_key(joint, last)) --last;
    std::string text = ",\"min\":[";
    append_number(text, time_of(first, fps));
    text += "],\"max\":[";
    append_number(text, time_of(last, fps));
    return text + "]";
}

KeyTimes add_times(GltfFile& file, const JointKeys& keys, double fps) {
    KeyTimes times;
    std::vector<std::uint64_t> offset;
    std::uint64_t bytes = 0;
    for (std::size_t j = 0; j < keys.joints(); ++j) {
        if (keys.count(j) == 0 || !times.kind.try_emplace(keys.key_bits(j), times.joint.size()).second) continue;
        times.joint.push_back(j);
        offset.push_back(bytes);
        bytes += 4 * keys.count(j);
    }
    const int view = file.add_view(bytes, GltfTarget::none, 0, [&keys, fps, joints = times.joint](GltfBytes& to) {
        for (const std::size_t j : joints)
            for (std::size_t f = 0; f < keys.frames(); ++f)
                if (keys.has_key(j, f)) to.add(time_of(f, fps));
    });
    for (std::size_t k = 0; k < times.joint.size(); ++k) {
        const std::size_t j = times.joint[k];
        times.accessor.push_back(
            file.add_accessor(view, offset[k], GltfType::f32, keys.count(j), "SCALAR", time_bounds(keys, j, fps)));
    }
    return times;
}

// A key's four numbers, or with all signs changed, so that neighbouring keys are less than a half turn apart as 4-vectors: programs that blend the
// four numbers need it.
class Neighbours {
public:
    // 1 or -1
    int sign(const Eigen::Vector4f& q) {
        if (q.dot(before_) < 0) sign_ = -sign_;
        before_ = q;
        return sign_;
    }

private:
    Eigen::Vector4f before_ = Eigen::Vector4f::Zero();
    int sign_ = 1;
};

void write_rotations(GltfBytes& to, const JointKeys& keys) {
    for (std::size_t j = 0; j < keys.joints(); ++j) {
        Neighbours neighbours;
        for (std::size_t f = 0; f < keys.frames(); ++f) {
            if (!keys.has_key(j, f)) continue;
            const Eigen::Vector4f key = keys.key(j, f).coeffs(), q = float(neighbours.sign(key)) * key;
            to.add_all(q[0], q[1], q[2], q[3]);
        }
    }
}

void write_short_rotations(GltfBytes& to, const JointKeys& keys) {
    for (std::size_t j = 0; j < keys.joints(); ++j) {
        Neighbours neighbours;
        for (const ShortRotation& q : keys.short_keys(j)) {
            const int sign = neighbours.sign({float(q[0]), float(q[1]), float(q[2]), float(q[3])});
            for (const std::int16_t number : q) to.add(std::int16_t(sign * number));
        }
    }
}

// Times of all frames, for the roots that leave their places and for morph targets.
int add_all_times(GltfFile& file, std::size_t frames, double fps) {
    const int view = file.add_view(4 * frames, GltfTarget::none, 0, [frames, fps](GltfBytes& to) {
        for (std::size_t f = 0; f < frames; ++f) to.add(time_of(f, fps));
    });
    std::string bounds = ",\"min\":[0],\"max\":[";
    append_number(bounds, time_of(frames - 1, fps));
    return file.add_accessor(view, 0, GltfType::f32, frames, "SCALAR", bounds + "]");
}

int add_places(GltfFile& file, const RootPath& path, const Vec3& origin) {
    const int view = file.add_view(12 * path.place.size(), GltfTarget::none, 0, [&path, origin](GltfBytes& to) {
        for (const Vec3& p : path.place)
            to.add_all(float(p.x() - origin.x()), float(p.y() - origin.y()), float(p.z() - origin.z()));
    });
    return file.add_accessor(view, 0, GltfType::f32, path.place.size(), "VEC3");
}

// Samplers and channels as they are added.
struct Channels {
    std::string samplers, channels;
    int count = 0;
    void add(int input, int output, int node, const char* path) {
        const char* const separator = count == 0 ? "" : ",\n";
        samplers += separator + ("{\"input\":" + std::to_string(input)) + ",\"output\":" + std::to_string(output) + "}";
        channels += separator + ("{\"sampler\":" + std::to_string(count)) +
                    ",\"target\":{\"node\":" + std::to_string(node) + ",\"path\":\"" + path + "\"}}";
        ++count;
    }
};

} // namespace

std::string gltf_animation(GltfFile& file, const JointKeys& keys, const std::vector<RootPath>& paths,
                           const Vec3& origin, double fps, int first_node, const std::vector<float>& weights,
                           int weights_node) {
    if (keys.frames() == 0) return "";
    const KeyTimes times = add_times(file, keys, fps);
    const std::uint64_t size = keys.in_shorts() ? sizeof(ShortRotation) : 4 * sizeof(float);
    const int view = file.add_view(size * keys.count(), GltfTarget::none, 0, [&keys](GltfBytes& to) {
        (keys.in_shorts() ? write_short_rotations : write_rotations)(to, keys);
    });
    Channels motion;
    std::uint64_t offset = 0;
    for (std::size_t j = 0; j < keys.joints(); ++j) {
        const std::size_t count = keys.count(j);
        if (count == 0) continue;
        const int output = keys.in_shorts()
                               ? file.add_accessor(view, offset, GltfType::s16, count, "VEC4", ",\"normalized\":true")
                               : file.add_accessor(view, offset, GltfType::f32, count, "VEC4");
        offset += size * count;
        motion.add(times.accessor[times.kind.at(keys.key_bits(j))], output, first_node + int(j), "rotation");
    }
    int all_times = -1;
    for (const RootPath& path : paths) {
        if (!path.leaves) continue;
        if (all_times < 0) all_times = add_all_times(file, keys.frames(), fps);
        motion.add(all_times, add_places(file, path, origin), first_node + int(path.joint), "translation");
    }
    if (!weights.empty()) {
        if (all_times < 0) all_times = add_all_times(file, keys.frames(), fps);
        const int weights_view = file.add_view(4 * weights.size(), GltfTarget::none, 0, [&weights](GltfBytes& to) {
            for (const float w : weights) to.add(w);
        });
        const int output = file.add_accessor(weights_view, 0, GltfType::f32, weights.size(), "SCALAR");
        motion.add(all_times, output, weights_node, "weights");
    }
    return "{\"name\":\"motion\",\"channels\":[\n" + motion.channels + "],\n\"samplers\":[\n" + motion.samplers + "]}";
}

} // namespace bough
