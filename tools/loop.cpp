#include "loop.h"
#include "formatted.h"
#include "long_run.h"
#include "progress.h"
#include "signals.h"
#include <cmath>
#include <iostream>

namespace bough {
namespace {

double tolerance_of(const LoopChoice& o) {
    return o.tolerance.value_or(LoopOptions().tolerance);
}

std::string apart(const LoopGap& gap, const LoopStart& start) {
    std::string text = formatted("%.3g m (%.2g of the height)", gap.largest(), gap.largest() / start.height);
    if (start.tips < start.end.size()) text += formatted(", branches by %.3g m", gap.branches);
    return text;
}

std::string not_closed(const std::string& what, double tolerance) {
    return what + ", more than " + formatted("%.2g", tolerance) +
           " (--loop-tolerance); --loop-blend makes the ends meet all the same, more "
           "periods (--loop-periods) or damping (--set damping_scale=2) may close it";
}

class LoopSink : public FrameSink {
public:
    LoopSink(std::unique_ptr<FrameSink> to, bool again, std::int64_t frames, double fps, std::optional<LoopBlend> blend)
        : to_(std::move(to)), again_(again), frames_(frames), fps_(fps), blend_(std::move(blend)) {}

    void write(const MotionFrame& frame) override {
        const bool blends = blend_ && frame.frame >= frames_ - blended_frames(frames_);
        if (blends) {
            frame_ = frame;
            blend_->blend(frame_);
        }
        const MotionFrame& shown = blends ? frame_ : frame;
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
    std::unique_ptr<FrameSink> to_;
    bool again_;
    std::int64_t frames_, written_ = 0;
    double fps_;
    std::optional<LoopBlend> blend_;
    MotionFrame first_, frame_;
};

} // namespace

void add_loop_options(OptionList& list, LoopChoice& o) {
    list.group("Length");
    list.add("--loop", o.seconds,
             "Write a loop of this length [s], in place of --seconds: the wind repeats after it, whole periods "
             "are run until the motion does too, and one is written, frames 0 to S fps - 1; the next would be "
             "frame 0 again. A .glb has that one too, so that players go on without a jump")
        .takes("S")
        .check(positive_number());
    list.add("--loop-tolerance", o.tolerance,
             "How far ends of branches and leaves may be, as a share of the tree's height, from where they were "
             "a period before (1e-4); else exit 3")
        .takes("X")
        .check(positive_number());
    list.add("--loop-periods", o.periods, "Periods to run at most until it repeats (20; with --loop-blend 5)")
        .takes("N")
        .check(whole_number(2, 1000000));
    list.add_flag("--loop-blend", o.blend,
                  "Let the motion pass, over the loop's last third, into that of a period before, joint by joint, so "
                  "that its ends meet also where it does not repeat: leaves that turn over in the wind never do");
}

void refuse_contradictions(const LoopChoice& o, const RunOptions& run) {
    if (!o.seconds) {
        if (o.tolerance || o.periods || o.blend)
            throw UsageError(std::string(o.tolerance ? "--loop-tolerance"
                                         : o.periods ? "--loop-periods"
                                                     : "--loop-blend") +
                             ": only with --loop");
        return;
    }
    if (run.seconds || run.frames)
        throw UsageError(std::string("--loop: not with ") + (run.seconds ? "--seconds" : "--frames") +
                         ", as --loop says how long the motion is; leave that out");
    loop_frames(o, run);
}

std::int64_t loop_frames(const LoopChoice& o, const RunOptions& run) {
    const double frames = *o.seconds * run.fps, whole = std::max(2.0, std::round(frames));
    if (!(whole < 1e9)) throw UsageError("--loop: more frames than can be counted");
    if (std::abs(frames - whole) > 1e-6 * whole)
        throw UsageError("--loop is " + formatted("%g s, which at %g frames a second is %g frames; the nearest whole "
                                                  "number is %.0f, --loop %.10g",
                                                  *o.seconds, run.fps, frames, whole, whole / run.fps));
    return std::int64_t(whole);
}

void make_periodic(const LoopChoice& o, Scene& scene) {
    try {
        make_periodic(*o.seconds, scene);
    } catch (const SceneError& error) {
        throw UsageError(std::string("--loop: ") + error.what() + (scene.wind ? "" : "; see --wind"));
    }
}

LoopStart close_loop(Simulation& run, const LoopChoice& o, const RunOptions& options, const CommonOptions& common) {
    LoopOptions loop;
    loop.frames = loop_frames(o, options);
    loop.tolerance = tolerance_of(o);
    loop.blend = o.blend;
    if (o.periods) loop.periods = *o.periods;
    const std::int64_t n = loop.frames;
    Progress progress(common, "frame (until it repeats)", n * most_periods(loop));
    LongRun told(
        n * most_periods(loop),
        [&](double left) {
            if (common.quiet) return;
            clear_progress();
            std::cerr << "treesim: --loop: the motion repeats after at most " << most_periods(loop) << " periods of "
                      << n << " frames; those take up to " << formatted("%.0f min", left / 60)
                      << " more; a shorter loop, or fewer --loop-periods, end sooner\n";
        },
        clock_seconds);
    LoopStart start = close_loop(run, loop, [&](Simulation& moved, std::int64_t f) {
        if (interrupted())
            throw Interrupted("interrupted in period " + std::to_string((f - 1) / n + 1) +
                              ", before the loop's first frame");
        advance_frame(moved, f, options.substeps);
        progress.at(f);
        told.at(f);
    });
    if (start.closed || o.blend) return start;
    throw PromiseError(not_closed("the motion does not repeat after " + std::to_string(start.periods) +
                                      " periods: from one to the next its ends are off by " + apart(start.gap, start),
                                  loop.tolerance));
}

std::unique_ptr<FrameSink> loop_sink(std::unique_ptr<FrameSink> to, bool again, LoopStart& start, const LoopChoice& o,
                                     const RunOptions& options) {
    const std::int64_t frames = loop_frames(o, options);
    std::optional<LoopBlend> blend;
    if (start.before)
        blend.emplace(std::move(*start.before), frames, [substeps = options.substeps](Simulation& run, std::int64_t f) {
            advance_frame(run, f, substeps);
        });
    return std::make_unique<LoopSink>(std::move(to), again, frames, options.fps, std::move(blend));
}

void measure_seam(Simulation& run, const LoopStart& start, const LoopChoice& o, const RunOptions& options,
                  std::vector<std::string>& notes) {
    advance_frame(run, loop_frames(o, options), options.substeps);
    const LoopGap gap = loop_seam(run, start);
    const std::string after = " after " + std::to_string(start.periods) + " periods";
    if (o.blend)
        notes.push_back("loop's ends were apart by " + apart(gap, start) + after + ": blended (--loop-blend)");
    else
        notes.push_back("loop closed to " + apart(gap, start) + after);
    if (!o.blend && gap.largest() > tolerance_of(o) * start.height)
        throw PromiseError(
            not_closed("the loop, written all the same, closes to " + apart(gap, start), tolerance_of(o)));
}

} // namespace bough
