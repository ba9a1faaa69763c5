#include "frame_sink.h"
#include "formats/documents/motion.h"
#include "formats/exports/own_maps.h"
#include "lib/base/counted.h"
#include "skin_mover.h"
#include <filesystem>
#include <optional>

namespace bough {
namespace {

class MotionSink : public FrameSink {
public:
    MotionSink(const std::string& file, MotionForm form, const MotionHeader& header, const Digits& digits)
        : output_(file), writer_(output_, header, form, digits) {}
    void write(const MotionFrame& frame) override { writer_.write(frame); }
    void finish() override {
        writer_.finish();
        output_.finish();
    }
    std::uint64_t bytes() const override { return output_.bytes() + writer_.waiting(); }

private:
    Output output_;
    MotionWriter writer_;
};

class ObjSink : public FrameSink {
public:
    ObjSink(const std::string& pattern, MovedMesh mesh, const std::vector<NamedFile>& read,
            std::vector<std::string>& notes)
        : pattern_(pattern), notes_(notes), skin_(std::move(mesh.skin)), mover_(mesh.mover(skin_, {})),
          mtl_(std::filesystem::path(sequence_mtl(pattern)).filename().string()) {
        const OwnMaps maps = mesh.own ? maps_of(*mesh.own, mtl_) : OwnMaps{};
        refuse_overwriting_by_images(read, places_of(maps.image));
        mtl_waiting_.emplace(sequence_mtl(pattern));
        write_mtl(*mtl_waiting_, skin_, maps.part);
        own_ = std::move(mesh.own); // with the images' bytes
    }
    void write(const MotionFrame& frame) override {
        mover_(frame, position_, normal_);
        try {
            Output output(sequence_name(pattern_, frame.frame));
            write_obj(output, skin_, position_, normal_, mtl_);
            output.flush(); // a full disk shows before anything else is there
            finish_materials();
            output.finish();
            bytes_ += output.bytes();
        } catch (const OutputError& error) {
            throw OutputError(pattern_, "stopped after " + counted(written_, "frame", "frames") + ": " + error.what());
        }
        ++written_;
        last_ = frame.frame;
    }
    void finish() override {
        if (std::string note = left_behind(pattern_, last_, "frame", "frames"); !note.empty())
            notes_.push_back(std::move(note));
    }
    std::uint64_t bytes() const override { return bytes_; }

private:
    // In a folder of their own beside the .mtl, which is made.
    std::vector<std::string> places_of(const std::vector<ImageFile>& images) const {
        const std::filesystem::path folder = std::filesystem::path(sequence_mtl(pattern_)).parent_path();
        std::vector<std::string> files;
        for (const ImageFile& image : images) files.push_back((folder / image.name).string());
        return files;
    }
    // Without a frame there are none either.
    void finish_materials() {
        if (!mtl_waiting_) return;
        const std::vector<ImageFile> images = own_ ? maps_of(*own_, mtl_).image : std::vector<ImageFile>();
        const std::vector<std::string> files = places_of(images);
        for (std::size_t k = 0; k < files.size(); ++k) {
            const std::filesystem::path folder = std::filesystem::path(files[k]).parent_path();
            std::error_code error;
            std::filesystem::create_directories(folder, error);
            if (error) throw OutputError(folder.string(), "cannot be made: " + error.message());
            Output output(files[k]);
            output.write(*images[k].bytes);
            output.finish();
            bytes_ += output.bytes();
        }
        own_.reset();
        mtl_waiting_->finish();
        mtl_waiting_.reset();
    }

    std::string pattern_;
    std::vector<std::string>& notes_;
    Skin skin_;
    Mover mover_;
    std::string mtl_;
    // For the first frame:
    std::optional<OwnMesh> own_;
    std::optional<Output> mtl_waiting_;
    std::vector<Vec3> position_, normal_;
    std::int64_t written_ = 0, last_ = -1;
    std::uint64_t bytes_ = 0;
};

} // namespace

std::unique_ptr<FrameSink> motion_sink(const std::string& file, const std::string& format, const MotionHeader& header,
                                       const Digits& digits) {
    const MotionForm form = format == "json"          ? MotionForm::json
                            : format == "safetensors" ? MotionForm::safetensors
                                                      : MotionForm::jsonl;
    return std::make_unique<MotionSink>(file, form, header, digits);
}

std::unique_ptr<FrameSink> obj_sink(const std::string& pattern, MovedMesh mesh, const std::vector<NamedFile>& read,
                                    std::vector<std::string>& notes) {
    return std::make_unique<ObjSink>(pattern, std::move(mesh), read, notes);
}

} // namespace bough
