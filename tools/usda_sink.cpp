#include "baked_sinks.h"
#include "exits.h"
#include "formats/exports/usda.h"
#include "lib/base/counted.h"
#include "made_with.h"
#include <filesystem>

namespace bough {
namespace {

class UsdaSink : public FrameSink {
public:
    UsdaSink(const std::string& file, const std::string& name, RiggedMesh shown, const UsdaOptions& options,
             const std::vector<NamedFile>& read)
        : file_(file), output_(file), shown_(std::move(shown)), root_(join_roots(shown_.rig)),
          looks_(looks_of(shown_.look, file)), writer_(output_, name, shown_.rig, looks_.part, options) {
        if (file == "-" && !looks_.image.empty())
            throw UsageError("-o is '-': the mesh has " + counted(looks_.image.size(), "image", "images") +
                             ", which stand beside a file: expected one; --textures none leaves out a species' images");
        std::vector<std::string> files;
        for (const ImageFile& image : looks_.image) files.push_back(place_of(image));
        refuse_overwriting_by_images(read, files);
    }
    void write(const MotionFrame& frame) override {
        RigPose pose = shown_.pose(frame);
        if (root_) join_roots(pose, *root_);
        writer_.write(pose);
    }
    void finish() override {
        for (const ImageFile& image : looks_.image) write_image(place_of(image), *image.bytes);
        writer_.finish();
        output_.finish();
        shown_.note();
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
    Output output_;
    RiggedMesh shown_;
    const std::optional<Vec3> root_; // of several
    const OwnLooks looks_;
    UsdaWriter writer_;
};

} // namespace

std::unique_ptr<FrameSink> usda_sink(const std::string& file, const std::string& name, RiggedMesh shown, double fps,
                                     const std::string& source, const std::vector<NamedFile>& read) {
    UsdaOptions options;
    options.fps = fps;
    options.generator = std::string("bough ") + bough_version();
    options.source = source;
    return std::make_unique<UsdaSink>(file, name, std::move(shown), options, read);
}

} // namespace bough
