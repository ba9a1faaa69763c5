#include "rigid_parts.h"
#include "exits.h"
#include "formats/open.h"
#include "formatted.h"
#include <chrono>

namespace bough {
namespace {

std::shared_ptr<Setting> whole_setting(const Setting& setting) {
    if (!setting.whole) throw UsageError("--report rigid: all joints move, there is nothing to compare with");
    auto whole = std::make_shared<Setting>();
    whole->tree = setting.whole->tree;
    whole->ranges = setting.whole->places.whole;
    whole->scene = setting.whole->scene;
    return whole;
}

} // namespace

RigidReport::RigidReport(const Setting& setting, const RunOptions& options, int threads)
    : whole_(setting.whole), options_(options),
      run_(started(whole_setting(setting), options, threads, {.poses = true, .trees = true})),
      comparison_(whole_->tree) {}

void RigidReport::follow(Simulation& run, std::int64_t frame) {
    using Time = std::chrono::steady_clock;
    const Time::time_point start = Time::now();
    advance_frame(run_, frame, options_.substeps);
    ms_ += std::chrono::duration<double, std::milli>(Time::now() - start).count();
    comparison_.tips_of(run_, there_);
    comparison_.tips_of(run, here_);
    comparison_.compare(there_, here_);
}

std::string RigidReport::line(double run_ms, std::int64_t frames) const {
    const RigidError e = comparison_.result();
    const std::string joints = std::to_string(whole_->places.leader.size()) + " of " +
                               std::to_string(whole_->tree.size_bodies()) + " joints move";
    if (e.frames == 0 || frames == 0) return "rigid " + joints + "; too few frames to compare";
    if (e.tips == 0) return "rigid " + joints + "; there is no branch whose tip could be compared";
    const double height = 100 / e.height;
    return "rigid " + joints +
           formatted("; tips off by %.3g m RMS, %.3g m at most (%.2g and %.2g %% of the height), of %.3g m that they "
                     "move RMS; %.4g ms a frame, with all joints %.4g",
                     e.rms, e.worst, height * e.rms, height * e.worst, e.deflection, run_ms / double(frames),
                     ms_ / double(frames));
}

} // namespace bough
