#include "baked_sinks.h"
#include "exits.h"
#include "formats/exports/vat.h"
#include "formatted.h"
#include "lib/base/counted.h"
#include "made_with.h"
#include "skin_mover.h"
#include <filesystem>

namespace bough {
namespace {

class VatSink : public FrameSink {
public:
    VatSink(const std::string& folder, MovedMesh shown, ReducedSkin mesh, const VatOptions& options)
        : skin_(std::move(shown.skin)), own_(std::move(shown.own)), mesh_(std::move(mesh)),
          mover_(shown.mover(mesh_.skin, mesh_.vertex)), folder_(folder),
          writer_(folder_, vat_name(folder), mesh_, {&skin_, own_ ? &*own_ : nullptr}, options) {}
    void write(const MotionFrame& frame) override {
        mover_(frame, position_, normal_);
        writer_.write(position_, normal_);
    }
    void finish() override {
        writer_.finish();
        folder_.finish();
    }

private:
    const Skin skin_;
    const std::optional<OwnMesh> own_;
    const ReducedSkin mesh_;
    const Mover mover_;
    OutputFolder folder_;
    VatWriter writer_;
    std::vector<Vec3> position_, normal_;
};

// What would make fewer of them, where none are left out yet.
[[noreturn]] void refuse_vertices(const std::string& folder, std::size_t vertices, const VatChoice& choice,
                                  bool of_file) {
    const std::string fewer =
        of_file ? "; --mesh made --sides 3 (and no --skin) shows one that is made from the tree, of fewer"
                : "; treeconvert --max-bodies makes fewer, with leaves in clumps; --sides 3 gives wood fewer corners";
    if (!choice.vertices)
        throw UsageError("-o is '" + folder + "': the mesh has " + std::to_string(vertices) +
                         " vertices, and a texture holds " + std::to_string(vat_side) + "; --vat-vertices " +
                         std::to_string(vat_side) + " simplifies it" + fewer);
    throw UsageError("--vat-vertices is " + std::to_string(*choice.vertices) + ", but the simplifier leaves " +
                     std::to_string(vertices) + " of the largest piece of wood alone" + fewer);
}

// Throws UsageError for more frames than a texture holds.
VatOptions vat_options(const std::string& folder, const VatFrames& frames, const VatChoice& choice,
                       const std::string& source) {
    VatOptions options;
    options.fps = frames.fps;
    options.looping = frames.looping;
    options.png = choice.png();
    options.generator = std::string("bough ") + bough_version();
    options.source = source;
    if (frames.count > std::int64_t(options.most_frames()))
        throw UsageError("-o is '" + folder + "': " + std::to_string(frames.count) + " frames, and a texture holds " +
                         std::to_string(options.most_frames()) +
                         (options.png ? "" : " with their normals (--vat-image png: 8192)") +
                         "; take fewer seconds, or a lower --fps");
    return options;
}

// The skin, or with --vat-vertices fewer vertices of it.
ReducedSkin small_enough(const std::string& folder, const Skin& skin, const Tree& tree, const VatFrames& frames,
                         const VatChoice& choice, std::vector<std::string>& notes) {
    const std::size_t all = skin.position.size(), most = choice.vertices ? std::size_t(*choice.vertices) : vat_side;
    if (!choice.vertices && all > most) refuse_vertices(folder, all, choice, frames.of_file);
    ReducedSkin mesh = reduced_skin(skin, tree, most);
    if (mesh.vertex.empty())
        throw UsageError("--vat-vertices is " + std::to_string(most) + ", which leaves no triangle of the mesh");
    if (mesh.vertex.size() > most) refuse_vertices(folder, mesh.vertex.size(), choice, frames.of_file);
    if (mesh.vertex.size() < all)
        notes.push_back(
            "--vat-vertices: " + std::to_string(mesh.vertex.size()) + " of " + std::to_string(all) +
            " vertices are left: wood is off by " +
            formatted("%.2g m (%.2g %% of the height)", mesh.error, 100 * mesh.error / height_of(skin)) +
            " as the simplifier counts" +
            (mesh.wood_kept < mesh.wood_pieces ? ", the largest " + std::to_string(mesh.wood_kept) + " of " +
                                                     std::to_string(mesh.wood_pieces) + " pieces of wood are kept"
                                               : "") +
            (mesh.kept < mesh.pieces ? ", " + std::to_string(mesh.kept) + " of " + std::to_string(mesh.pieces) +
                                           formatted(" leaves are kept, %.2g times as long", mesh.growth)
                                     : ""));
    const std::filesystem::path other =
        std::filesystem::path(without_slash(folder)) / (vat_name(folder) + (choice.png() ? "_vat.exr" : "_vat.png"));
    if (std::error_code none; std::filesystem::exists(other, none))
        notes.push_back(folder + ": " + other.filename().string() + " of an earlier run stays there");
    return mesh;
}

} // namespace

void add_vat_options(OptionList& list, VatChoice& choice) {
    list.add("--vat-vertices", choice.vertices,
             "With -o NAME_vat/: simplify the mesh to at most N vertices, of which a texture holds 8192")
        .takes("N")
        .check(whole_number(3, vat_side));
    list.add("--vat-image", choice.image,
             "With -o NAME_vat/: exr, half floats, normals below the places (default); png, 16 bits, normals in a file "
             "of their own")
        .takes("NAME")
        .one_of({"exr", "png"});
}

std::string vat_name(const std::string& folder) {
    const std::string name = std::filesystem::path(without_slash(folder)).filename().string(), end = "_vat";
    if (name.size() <= end.size() || !name.ends_with(end))
        throw UsageError("-o is '" + folder + "', but the folder of an OpenVAT is called NAME_vat/");
    return name.substr(0, name.size() - end.size());
}

std::vector<std::string> vat_outputs(const std::string& folder, const VatChoice& choice) {
    std::vector<std::string> files = vat_files(vat_name(folder), choice.png());
    for (std::string& file : files) file = without_slash(folder) + "/" + file;
    return files;
}

std::unique_ptr<FrameSink> vat_sink(const std::string& folder, const Tree& tree, MovedMesh shown,
                                    const VatFrames& frames, const VatChoice& choice, const std::string& source,
                                    std::vector<std::string>& notes) {
    const VatOptions options = vat_options(folder, frames, choice, source);
    ReducedSkin mesh = small_enough(folder, shown.skin, tree, frames, choice, notes);
    return std::make_unique<VatSink>(folder, std::move(shown), std::move(mesh), options);
}

} // namespace bough
