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
        const std::size_t all = model_.keys().joints() * model_.keys().frames(), kept = model_.keys().count();
        notes_.push_back(counted(model_.bones(), "bone", "bones") + " of the model moved");
        if (kept < all)
            notes_.push_back(std::to_string(kept) + " of " + std::to_string(all) + " keys written (--key-tolerance)");
    }

private:
    Output output_;
    std::vector<std::string>& notes_;
    DrivenModel model_;
};

} // namespace

std::unique_ptr<FrameSink> driven_sink(const std::string& file, UserModel model, const Tree& tree,
                                       const DrivenOptions& options, std::vector<std::string>& notes) {
    return std::make_unique<DrivenSink>(file, std::move(model), tree, options, notes);
}

} // namespace bough
