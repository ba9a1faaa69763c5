#include "baked_sinks.h"
#include "exits.h"
#include "formats/documents/document_parts.h"
#include "formats/exports/gltf_parts.h"
#include "formats/exports/usda.h"
#include "made_with.h"
#include <filesystem>

namespace bough {
namespace {

OwnLooks looks_of_skin(const Skin& skin) {
    OwnLooks looks;
    for (const SkinPart& part : skin.part) looks.part.push_back(look_of(gltf_material(part.name, part.color)));
    return looks;
}

class UsdaSink : public FrameSink {
public:
    UsdaSink(const std::string& file, const Tree& tree, Skin skin, std::optional<OwnMesh> own, const GltfChoice& choice,
             const UsdaOptions& options, const std::vector<NamedFile>& read, std::vector<std::string>& notes)
        : file_(file), tree_(tree), notes_(notes), output_(file), skin_(std::move(skin)), own_(std::move(own)),
          looks_(own_ ? looks_of(*own_, file) : looks_of_skin(skin_)), groups_(chosen_joints(tree, choice)),
          writer_(output_, skin_, own_ ? &*own_ : nullptr, looks_.part, tree, groups_, options) {
        if (file == "-" && !looks_.image.empty())
            throw UsageError("-o is '-': the mesh has " + std::to_string(looks_.image.size()) +
                             " images, which stand beside a file; --textures none does without those of a species");
        std::vector<std::string> files;
        for (const ImageFile& image : looks_.image) files.push_back(place_of(image));
        refuse_overwriting_by_images(read, files);
        if (groups_.size() < tree.size_bodies()) error_.emplace(tree, groups_);
    }
    void write(const MotionFrame& frame) override {
        writer_.write(frame);
        if (error_) error_->add(frame.rotation, frame.position);
    }
    void finish() override {
        for (const ImageFile& image : looks_.image) write_image(place_of(image), *image.bytes);
        writer_.finish();
        output_.finish();
        if (error_) notes_.push_back(merge_note(tree_, groups_, *error_, height_of(skin_)));
    }
    std::uint64_t bytes() const override { return output_.bytes() > 0 ? output_.bytes() : writer_.waiting(); }

private:
    std::string place_of(const ImageFile& image) const {
        return (std::filesystem::path(file_).parent_path() / image.name).string();
    }
    static void write_image(const std::string& file, const std::string& bytes) {
        const std::filesystem::path folder = std::filesystem::path(file).parent_path();
        std::error_code error;
        std::filesystem::create_directories(folder, error);
        if (error) throw OutputError(folder.string(), "cannot be made: " + error.message());
        Output output(file);
        output.write(bytes);
        output.finish();
    }

    const std::string file_;
    const Tree& tree_;
    std::vector<std::string>& notes_;
    Output output_;
    const Skin skin_;
    const std::optional<OwnMesh> own_;
    const OwnLooks looks_;
    const JointGroups groups_;
    UsdaWriter writer_;
    std::optional<MergeError> error_;
};

} // namespace

std::unique_ptr<FrameSink> usda_sink(const std::string& file, const Tree& tree, Skin skin, std::optional<OwnMesh> own,
                                     double fps, const GltfChoice& choice, const std::string& source,
                                     const std::vector<NamedFile>& read, std::vector<std::string>& notes) {
    UsdaOptions options;
    options.fps = fps;
    options.generator = std::string("bough ") + bough_version();
    options.source = source;
    return std::make_unique<UsdaSink>(file, tree, std::move(skin), std::move(own), choice, options, read, notes);
}

} // namespace bough
