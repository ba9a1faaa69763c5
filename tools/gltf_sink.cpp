#include "exits.h"
#include "frame_sink.h"
#include "lib/base/counted.h"
#include "lib/growth/skin.h"
#include "made_with.h"
#include <algorithm>
#include <numbers>
#include <sstream>

namespace bough {
namespace {

constexpr std::size_t joints_default = 1000; // some viewers fail beyond 1020
constexpr std::size_t joints_most = 65536;   // what JOINTS_0 can number
constexpr double tolerance_default = 0.1;    // [deg]

class GltfSink : public FrameSink {
public:
    GltfSink(const std::string& file, const Tree& tree, int sides, const RustleMaker& rustle, const GltfChoice& choice,
             const GltfOptions& options, std::vector<std::string>& notes)
        : GltfSink(std::make_unique<Output>(file), tree, choice, notes) {
        skin_ = chosen_skin(tree, sides, choice);
        rustle_ = rustle(skin_, true);
        writer_ = std::make_unique<GltfWriter>(*output_, skin_, tree, groups_, options, rustle_.get());
        for (const Vec3& p : skin_.position) reach(p.y());
    }
    // memory: where the bytes go in place of the output; null: nowhere else.
    GltfSink(std::unique_ptr<Output> output, std::string* memory, const Tree& tree, OwnMesh own,
             const GltfChoice& choice, const GltfOptions& options, std::vector<std::string>& notes)
        : GltfSink(std::move(output), tree, choice, notes) {
        memory_ = memory;
        own_ = std::move(own);
        writer_ = std::make_unique<GltfWriter>(*output_, own_, tree, groups_, options);
        for (const OwnPart& part : own_.part)
            each_vertex(own_, part, [this](const OwnSurface& from, std::size_t v, const OwnPlace* place) {
                reach(double(position_of(from, v, place).y()));
            });
    }
    void write(const MotionFrame& frame) override {
        writer_->write(frame);
        if (error_) error_->add(frame.rotation, frame.position);
    }
    void finish() override {
        if (memory_) {
            *memory_ = writer_->finish_in_memory();
        } else {
            writer_->finish();
            output_->finish();
        }
        note();
    }

private:
    GltfSink(std::unique_ptr<Output> output, const Tree& tree, const GltfChoice& choice,
             std::vector<std::string>& notes)
        : output_(std::move(output)), tree_(tree), choice_(choice), notes_(notes),
          groups_(chosen_joints(tree, choice)) {
        if (groups_.size() < tree.size_bodies()) error_.emplace(tree, groups_);
    }
    void reach(double y) { low_ = std::min(low_, y), high_ = std::max(high_, y); }
    void note() {
        std::ostringstream text;
        if (error_) notes_.push_back(merge_note(tree_, groups_, *error_, high_ - low_, choice_.instances()));
        if (const std::string lost = leaves_note(tree_, choice_); !lost.empty()) notes_.push_back(lost);
        const std::size_t all = writer_->keys().joints() * writer_->keys().frames(), kept = writer_->keys().count();
        if (kept == all) return;
        text << kept << " of " << all
             << " animation keys are written, as the others would not show (--key-tolerance 0 writes all)";
        notes_.push_back(text.str());
    }

    std::unique_ptr<Output> output_;
    std::string* memory_ = nullptr; // in place of it
    const Tree& tree_;
    const GltfChoice choice_;
    std::vector<std::string>& notes_;
    Skin skin_; // or
    OwnMesh own_;
    double low_ = INFINITY, high_ = -INFINITY; // [m]
    JointGroups groups_;
    std::unique_ptr<Rustle> rustle_;
    std::unique_ptr<GltfWriter> writer_;
    std::optional<MergeError> error_;
};

} // namespace

void add_max_joints(OptionList& list, GltfChoice& choice) {
    const ValueCheck number = whole_number(1, joints_most);
    list.add("--max-joints", choice.max_joints,
             "Joints of a .glb: deepest levels are merged first until at most N are left (1000); all: none merged")
        .takes("N|all")
        .check([number](const std::string& text) {
            const std::string wrong = number(text);
            return text == "all" || wrong.empty() ? std::string() : wrong + ", or all";
        });
}

void add_leaves_as(OptionList& list, GltfChoice& choice) {
    list.add("--leaves-as", choice.leaves_as,
             "Leaves and petals of a .glb: skin, part of the skinned mesh, each moved by its own joint where "
             "--max-joints leaves it one (default); instances: one mesh drawn at each leaf's place "
             "(EXT_mesh_gpu_instancing), fixed to the joint that bears it: far smaller, but leaves do not flutter")
        .takes("NAME")
        .one_of({"skin", "instances"});
}

void add_key_tolerance(OptionList& list, GltfChoice& choice) {
    list.add("--key-tolerance", choice.key_tolerance,
             "Keys of a .glb are left out while no joint's world direction is off by more [deg] (0.1); 0: keep all")
        .takes("DEG")
        .check(not_negative_number());
}

namespace {

// Leaves and petals that something bears.
std::size_t joined_leaves(const Tree& tree) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) count += is_flat(tree.kind[i]) && tree.parent[i] >= 0;
    return count;
}

} // namespace

JointGroups chosen_joints(const Tree& tree, const GltfChoice& choice) {
    const bool all = choice.max_joints == "all";
    const std::size_t leaves = choice.instances() ? joined_leaves(tree) : 0, bodies = tree.size_bodies() - leaves;
    if (all && bodies > joints_most)
        throw UsageError("--max-joints is 'all', which are " + std::to_string(bodies) +
                         " here, but a .glb can number " + std::to_string(joints_most));
    const std::size_t most = all                         ? bodies
                             : choice.max_joints.empty() ? std::min(joints_default + choice.loose, joints_most)
                                                         : std::stoull(choice.max_joints);
    try {
        return merge_joints(tree, most, !choice.instances());
    } catch (const std::invalid_argument& error) {
        throw UsageError("--max-joints " + std::string(error.what()));
    }
}

GltfOptions gltf_options(const GltfChoice& choice, const std::string& source) {
    GltfOptions options;
    options.key_tolerance = choice.key_tolerance.value_or(tolerance_default) * std::numbers::pi / 180;
    options.generator = std::string("bough ") + bough_version();
    options.source = source;
    options.leaf_instances = choice.instances();
    return options;
}

std::string merge_note(const Tree& tree, const JointGroups& groups, const MergeError& error, double height,
                       bool instances) {
    std::ostringstream text;
    text.precision(3);
    text << tree.size_bodies() << " bodies merged to " << groups.size() << " joints ("
         << (instances ? "--max-joints, --leaves-as instances" : "--max-joints") << "): ends of bodies are off by "
         << error.rms() << " m RMS, " << error.largest() << " m at most (" << 100 * error.rms() / height << " and "
         << 100 * error.largest() / height << " % of the height); more joints move truer, where the viewer takes them";
    return text.str();
}

Skin chosen_skin(const Tree& tree, int sides, const GltfChoice& choice) {
    Skin skin = build_skin(tree, {sides, !choice.instances()});
    if (skin.triangle.empty())
        throw UsageError("--leaves-as instances: the tree holds leaves alone, which leaves no mesh with joints");
    return skin;
}

std::string leaves_note(const Tree& tree, const GltfChoice& choice) {
    const std::size_t leaves = choice.instances() ? joined_leaves(tree) : 0;
    if (leaves == 0) return choice.instances() ? "--leaves-as instances: the tree has no leaves" : "";
    return counted(leaves,
                   "leaf or petal is an instance, fixed to the joint that bears it: its own motion is left out "
                   "(--leaves-as skin keeps it)",
                   "leaves and petals are instances, fixed to the joints that bear them: their own motion is left out "
                   "(--leaves-as skin keeps it)");
}

std::unique_ptr<FrameSink> gltf_sink(const std::string& file, const Tree& tree, int sides, const RustleMaker& rustle,
                                     double fps, const GltfChoice& choice, const std::string& source,
                                     std::vector<std::string>& notes) {
    GltfOptions options = gltf_options(choice, source);
    options.fps = fps;
    return std::make_unique<GltfSink>(file, tree, sides, rustle, choice, options, notes);
}

std::unique_ptr<FrameSink> own_sink(const std::string& file, const Tree& tree, OwnMesh own, double fps,
                                    const GltfChoice& choice, const std::string& source,
                                    std::vector<std::string>& notes) {
    GltfOptions options = gltf_options(choice, source);
    options.fps = fps;
    return std::make_unique<GltfSink>(std::make_unique<Output>(file), nullptr, tree, std::move(own), choice, options,
                                      notes);
}

std::unique_ptr<FrameSink> own_sink_into(std::string& glb, const Tree& tree, OwnMesh own, double fps,
                                         const GltfChoice& choice, const std::string& source,
                                         std::vector<std::string>& notes) {
    GltfOptions options = gltf_options(choice, source);
    options.fps = fps;
    return std::make_unique<GltfSink>(std::make_unique<Output>(nullptr, 0, "the .glb"), &glb, tree, std::move(own),
                                      choice, options, notes);
}

} // namespace bough
