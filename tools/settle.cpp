#include "settle.h"
#include "exits.h"
#include "formatted.h"
#include "lib/base/counted.h"
#include "progress.h"
#include "signals.h"
#include <cmath>

namespace bough {

std::int64_t frames_before(const TreesimOptions& o, const Setting& setting) {
    double seconds = 0;
    if (o.settle)
        seconds = *o.settle;
    else if (o.resume.empty() && !o.loop.seconds && setting.scene.pose != Pose::rest && !setting.scene.fracture)
        seconds = settling_time(setting);
    const double frames = o.settle ? std::round(seconds * o.run.fps) : std::ceil(seconds * o.run.fps);
    constexpr double most = 1e9; // steps of Simulation::begin_before
    if (!(frames * o.run.substeps <= most))
        throw UsageError(formatted("--settle: is %g s, expected at most %g: that many steps", seconds,
                                   std::floor(most / o.run.fps / o.run.substeps)));
    return std::int64_t(frames);
}

void settle(Simulation& run, std::int64_t frames, const TreesimOptions& o) {
    if (frames == 0) return;
    run.begin_before(frames * o.run.substeps);
    Progress progress(o.common, "frame (before the first)", frames);
    for (std::int64_t f = -frames; f < 0; ++f) {
        if (interrupted()) throw Interrupted("interrupted before the first frame, while settling into the wind");
        advance_frame(run, f + 1, o.run.substeps);
        progress.at(frames + f + 1);
    }
}

std::string settled_note(std::int64_t frames, const TreesimOptions& o) {
    if (frames == 0) return {};
    return counted(std::uint64_t(frames), "frame", "frames") +
           formatted(" (%.3g s) of this wind were run before frame 0, so that the tree sways from the start (--settle "
                     "0: it begins at rest)",
                     double(frames) / o.run.fps);
}

} // namespace bough
