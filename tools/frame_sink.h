// frame_sink.h: where treesim's frames go: a motion document, an OBJ sequence, a point cache, or an animated glTF file.
#pragma once
#include "file_names.h"
#include "formats/exports/gltf.h"
#include "formats/models/driven_mesh.h"
#include "formats/models/driven_model.h"
#include "formats/text.h"
#include "lib/growth/rustle.h"
#include "lib/model/motion.h"
#include "lib/model/tree.h"
#include "option_list.h"
#include <memory>

namespace bough {

class FrameSink {
public:
    virtual ~FrameSink() = default;
    virtual void write(const MotionFrame&) = 0; // throws OutputError
    virtual void finish() = 0;                  // everything written so far is a valid output; throws OutputError
    // Returns those of the output so far, what waits for finish() too; 0 where it is not known. Called by the thread that writes.
    virtual std::uint64_t bytes() const { return 0; }
};

// `format`: jsonl, json or safetensors.
std::unique_ptr<FrameSink> motion_sink(const std::string& file, const std::string& format, const MotionHeader&,
                                       const Digits& = {});

struct MovedMesh; // skin_mover.h

// What makes the leaves of a skin's clumps rustle, nothing where they do not; `together` as in rustle.h. Called once, when a sink is made.
using RustleMaker = std::function<std::unique_ptr<Rustle>(const Skin&, bool together)>;

// One OBJ a frame, each whole or absent, and one mtl with the mesh's images. Throws UsageError where an image would replace a file of `read`. Keeps a
// reference to the notes, which name what an earlier, longer run has left behind the last frame.
std::unique_ptr<FrameSink> obj_sink(const std::string& pattern, MovedMesh, const std::vector<NamedFile>& read,
                                    std::vector<std::string>& notes);

// One point cache, `format` mdd or pc2: of `count` frames from number `first` on. Keeps a reference to the tree; what the
// user should know is added to the notes. Throws UsageError where the format cannot count so many.
struct CacheFrames {
    double fps = 30;
    std::int64_t first = 0, count = 0;
};
std::unique_ptr<FrameSink> cache_sink(const std::string& file, const std::string& format, const Tree&, Skin,
                                      const RustleMaker&, const CacheFrames&, std::vector<std::string>& notes);
// The same of a mesh that came with the tree, or stands for it: no skin is made of it.
std::unique_ptr<FrameSink> own_cache_sink(const std::string& file, const std::string& format, const Tree&, OwnMesh,
                                          const CacheFrames&, std::vector<std::string>& notes);

// The same of a model's own mesh, moved by its bones.
std::unique_ptr<FrameSink> driven_cache_sink(const std::string& file, const std::string& format, DrivenMesh,
                                             const CacheFrames&, std::vector<std::string>& notes);

// The same of one whose pieces move in ways of their own.
std::unique_ptr<FrameSink> moved_cache_sink(const std::string& file, const std::string& format, MovedMesh,
                                            const CacheFrames&, std::vector<std::string>& notes);

// --max-joints, --leaves-as and --key-tolerance (treesim alone).
struct GltfChoice {
    std::string max_joints;              // a number or "all"; empty: 1000
    std::optional<double> key_tolerance; // [deg]
    std::size_t loose = 0;               // roots beside the trees': balls, and what breaks off
    std::string leaves_as;               // "skin", "instances"; empty: skin
    bool instances() const { return leaves_as == "instances"; }
    // The first option that is given, or nullptr.
    const char* given() const {
        return !max_joints.empty()  ? "--max-joints"
               : !leaves_as.empty() ? "--leaves-as"
               : key_tolerance      ? "--key-tolerance"
                                    : nullptr;
    }
};
void add_max_joints(OptionList&, GltfChoice&);
void add_leaves_as(OptionList&, GltfChoice&);
void add_key_tolerance(OptionList&, GltfChoice&);
// The groups that --max-joints asks for. Throws UsageError: fewer than roots, more than a .glb can number.
JointGroups chosen_joints(const Tree&, const GltfChoice&);
GltfOptions gltf_options(const GltfChoice&, const std::string& source);
// The skin that goes with --leaves-as. Throws UsageError where instances leave nothing of it.
Skin chosen_skin(const Tree&, int sides, const GltfChoice&);
// What --leaves-as instances loses, "" without it.
std::string leaves_note(const Tree&, const GltfChoice&);

// What merging joints cost, beside the height of what is shown.
std::string merge_note(const Tree&, const JointGroups&, const MergeError&, double height, bool instances = false);

// One .glb, written by finish(), which also notes what merging joints and leaving out keys cost. Keeps a reference to
// the tree and the notes.
std::unique_ptr<FrameSink> gltf_sink(const std::string& file, const Tree&, int sides, const RustleMaker&, double fps,
                                     const GltfChoice&, const std::string& source, std::vector<std::string>& notes);

// The same of a mesh that came with the tree.
std::unique_ptr<FrameSink> own_sink(const std::string& file, const Tree&, OwnMesh, double fps, const GltfChoice&,
                                    const std::string& source, std::vector<std::string>& notes);

// The same into `glb`, which outlives it: whole once it is finished.
std::unique_ptr<FrameSink> own_sink_into(std::string& glb, const Tree&, OwnMesh, double fps, const GltfChoice&,
                                         const std::string& source, std::vector<std::string>& notes);

// How many bones of a model moved, and how many keys of all are written.
void note_driven(std::size_t bones, std::size_t keys, std::size_t written, std::vector<std::string>& notes);

// --skin: the user's own model with the motion added, written by finish(). Keeps references to the tree and the notes.
// The model is read before threads are started (user_model.h).
std::unique_ptr<FrameSink> driven_sink(const std::string& file, UserModel, const Tree&, const DrivenOptions&,
                                       std::vector<std::string>& notes);

} // namespace bough
