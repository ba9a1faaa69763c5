#include "frame_sink.h"
#include "lib/base/counted.h"

namespace bough {
namespace {

class DrivenSink : public FrameSink {
public:
    DrivenSink(const std::string& file, UserModel model, const Tree& tree, const DrivenOptions& options,
               std::vector<std::string>& notes)
        : output_(file), notes_(notes), model_(std::move(model), tree, options, notes) {}
    void write(const MotionFrame& frame) override { model_.write(frame); }
    void finish() override {
        output_.write(model_.finish(output_.name()));
        output_.finish();
        note_driven(model_.bones(), model_.keys().joints() * model_.keys().frames(), model_.keys().count(), notes_);
    }

private:
    Output output_;
    std::vector<std::string>& notes_;
    DrivenModel model_;
};

} // namespace

void note_driven(std::size_t bones, std::size_t keys, std::size_t written, std::vector<std::string>& notes) {
    notes.push_back(counted(bones, "bone", "bones") + " of the model moved");
    if (written < keys)
        notes.push_back(std::to_string(written) + " of " + std::to_string(keys) + " keys written (--key-tolerance)");
}

std::unique_ptr<FrameSink> driven_sink(const std::string& file, UserModel model, const Tree& tree,
                                       const DrivenOptions& options, std::vector<std::string>& notes) {
    return std::make_unique<DrivenSink>(file, std::move(model), tree, options, notes);
}

} // namespace bough
