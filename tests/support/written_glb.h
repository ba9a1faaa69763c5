// written_glb.h: trees that swing, written as .glb and read again by gltf_reader.h.
#pragma once
#include "formats/exports/gltf.h"
#include "gltf_reader.h"
#include "skin_checks.h"
#include <filesystem>
#include <unistd.h>

namespace written_glb {

using namespace bough;
using namespace skin_checks;
using gltf_reader::Glb;

inline constexpr double fps = 30;

// A file of the temporary folder, gone with this.
struct GlbFile {
    std::string path =
        (std::filesystem::temp_directory_path() / ("bough_test_" + std::to_string(getpid()) + ".glb")).string();
    ~GlbFile() { std::filesystem::remove(path); }
};

// Every joint swings, at a rate and with a phase of its own.
inline SkinPose swinging(const Tree& tree, std::size_t frame) {
    return posed(tree, [&](std::size_t i) {
        const double t = double(frame) / fps, a = 0.15 * std::sin(2 + double(i) + t * (1 + double(i % 5)));
        return Vec3(a, 0.5 * a * std::cos(double(i)), 0.2 * a);
    });
}

inline MotionFrame frame_of(const SkinPose& pose, std::size_t number) {
    MotionFrame frame;
    frame.frame = std::int64_t(number);
    frame.time = double(number) / fps;
    frame.position = pose.x_w;
    for (const Mat3& R : pose.R_wb) frame.rotation.emplace_back(R);
    return frame;
}

// A tree and what was written of it, read again.
struct Written {
    Tree tree;
    Skin skin;
    JointGroups groups;
    Glb glb;
    std::size_t keys = 0;
    double height() const {
        double low = INFINITY, high = -INFINITY;
        for (const Vec3& p : skin.position) low = std::min(low, p.y()), high = std::max(high, p.y());
        return high - low;
    }
};

// The tree swinging, without leaf instances.
inline Written written(const Tree& tree, std::size_t frames, std::size_t joints = 100000, double tolerance = 0,
                       const GlbFile& file = {}) {
    Written w{tree, build_skin(tree, {}), merge_joints(tree, joints), {}};
    GltfOptions options;
    options.fps = fps;
    options.key_tolerance = tolerance;
    options.generator = "bough 1.2.3";
    options.source = "treegen \"a\"\ntreesim -";
    Output output(file.path);
    GltfWriter writer(output, w.skin, w.tree, w.groups, options);
    for (std::size_t f = 0; f < frames; ++f) writer.write(frame_of(swinging(tree, f), f));
    writer.finish();
    output.finish();
    w.keys = writer.keys().count();
    w.glb = gltf_reader::parse(read_input(file.path));
    return w;
}

} // namespace written_glb
