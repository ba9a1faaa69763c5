#include "sized_sink.h"
#include "formatted.h"
#include "treesim_options.h"
#include <utility>

namespace bough {
namespace {

class SizedSink : public FrameSink {
public:
    SizedSink(std::unique_ptr<FrameSink> to, std::string smaller, std::int64_t frames,
              std::function<void(const std::string&)> say, double large)
        : to_(std::move(to)), smaller_(std::move(smaller)), frames_(frames), say_(std::move(say)), large_(large) {}
    void write(const MotionFrame& frame) override {
        to_->write(frame);
        if (written_ == 2) return;
        ++written_;
        const std::uint64_t before = std::exchange(bytes_, to_->bytes());
        if (written_ == 2) tell(double(before), double(bytes_ - before));
    }
    void finish() override { to_->finish(); }
    std::uint64_t bytes() const override { return to_->bytes(); }

private:
    void tell(double first, double frame) const {
        const double all = first + frame * double(frames_ - 1);
        if (all <= large_) return;
        say_("the output will be about " + bytes_text(all) + ", " + bytes_text(frame) + " a frame" +
             (smaller_.empty() ? "" : "; " + smaller_));
    }

    std::unique_ptr<FrameSink> to_;
    std::string smaller_;
    std::int64_t frames_;
    std::function<void(const std::string&)> say_;
    double large_;
    int written_ = 0; // up to 2
    std::uint64_t bytes_ = 0;
};

} // namespace

std::string smaller_output(const std::string& format, bool short_numbers, bool several_fields) {
    if (format == "obj") return ".pc2 and .mdd hold a frame's vertices in 12 bytes each, .glb the joints' turns alone";
    if (format == "glb") return {};
    if (is_mesh(format)) return ".glb holds the joints' turns alone";
    std::string text;
    if (format != "safetensors")
        text = short_numbers ? ".safetensors takes less" : ".safetensors takes less than half, --digits 6 half";
    if (several_fields) text += (text.empty() ? "" : "; ") + std::string("--fields names what is wanted");
    return text;
}

std::unique_ptr<FrameSink> sized_sink(std::unique_ptr<FrameSink> to, std::string smaller, std::int64_t frames,
                                      std::function<void(const std::string&)> say, double large) {
    return std::make_unique<SizedSink>(std::move(to), std::move(smaller), frames, std::move(say), large);
}

} // namespace bough
