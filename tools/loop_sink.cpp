#include "loop.h"
#include <functional>

namespace bough {
namespace {

// Rotation of each body in its parent's, or of a root in the world.
std::vector<Quat> in_parents(const Tree& tree, const std::vector<Quat>& world) {
    std::vector<Quat> own(world);
    for (std::size_t i = 0; i < own.size(); ++i)
        if (tree.parent[i] >= 0) own[i] = world[std::size_t(tree.parent[i])].conjugate() * world[i];
    return own;
}

// Rotations in parents of the run's frames, one after another.
template <class T> class Frames {
public:
    Frames(Run<T> run, const Tree& tree, int substeps) : run_(std::move(run)), tree_(tree), substeps_(substeps) {}
    std::vector<Quat> operator()() {
        if (frame_++ > 0) advance_frame(run_, tree_, frame_, substeps_);
        present(run_.plan, run_.state);
        fill_frame(run_.state, frame_, 1, MotionFields(), pose_);
        return in_parents(tree_, pose_.rotation);
    }

private:
    Run<T> run_;
    const Tree& tree_;
    int substeps_;
    std::int64_t frame_ = 0;
    MotionFrame pose_;
};

class LoopSink : public FrameSink {
public:
    // before: gives what is blended with, from the first frame that is on; empty: nothing is.
    LoopSink(std::unique_ptr<FrameSink> to, bool again, std::int64_t frames, double fps, const Tree& tree,
             std::function<std::vector<Quat>()> before)
        : to_(std::move(to)), again_(again), frames_(frames), fps_(fps), tree_(tree), before_(std::move(before)) {}

    void write(const MotionFrame& frame) override {
        const bool blends = before_ && frame.frame >= frames_ - blended_frames(frames_);
        const MotionFrame& shown = blends ? blended(frame) : frame;
        if (again_ && frame.frame == 0) first_ = shown;
        to_->write(shown);
        ++written_;
    }
    void finish() override {
        if (again_ && written_ == frames_) {
            first_.frame = frames_;
            first_.time = double(frames_) / fps_;
            to_->write(first_);
        }
        to_->finish();
    }
    std::uint64_t bytes() const override { return to_->bytes(); }

private:
    const MotionFrame& blended(const MotionFrame& frame) {
        const std::int64_t count = blended_frames(frames_);
        const double x = double(frame.frame - (frames_ - count)) / double(count), w = x * x * (3 - 2 * x);
        const std::vector<Quat> now = in_parents(tree_, frame.rotation), then = before_();
        frame_ = frame;
        for (std::size_t i = 0; i < now.size(); ++i) {
            const Quat q = now[i].slerp(w, then[i]);
            if (tree_.parent[i] < 0) {
                frame_.rotation[i] = q.normalized();
            } else {
                const auto p = std::size_t(tree_.parent[i]);
                frame_.rotation[i] = (frame_.rotation[p] * q).normalized();
                frame_.position[i] = frame_.position[p] + frame_.rotation[p] * tree_.joint_position[i];
            }
            if (frame_.rotation[i].w() < 0) frame_.rotation[i].coeffs() *= -1;
        }
        return frame_;
    }

    std::unique_ptr<FrameSink> to_;
    bool again_;
    std::int64_t frames_, written_ = 0;
    double fps_;
    const Tree& tree_;
    std::function<std::vector<Quat>()> before_;
    MotionFrame first_, frame_;
};

} // namespace

template <class T>
std::unique_ptr<FrameSink> loop_sink(std::unique_ptr<FrameSink> to, bool again, std::optional<Run<T>> before,
                                     const Tree& tree, const LoopChoice& o, const RunOptions& options) {
    std::function<std::vector<Quat>()> frames;
    if (before) frames = Frames<T>(std::move(*before), tree, options.substeps);
    return std::make_unique<LoopSink>(std::move(to), again, loop_frames(o, options), options.fps, tree,
                                      std::move(frames));
}

template std::unique_ptr<FrameSink> loop_sink(std::unique_ptr<FrameSink>, bool, std::optional<Run<float>>, const Tree&,
                                              const LoopChoice&, const RunOptions&);
template std::unique_ptr<FrameSink> loop_sink(std::unique_ptr<FrameSink>, bool, std::optional<Run<double>>, const Tree&,
                                              const LoopChoice&, const RunOptions&);

} // namespace bough
