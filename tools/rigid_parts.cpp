#include "rigid_parts.h"
#include "exits.h"
#include "formats/open.h"
#include "formatted.h"
#include <chrono>

namespace bough {
namespace {

Setting whole_setting(const Setting& setting) {
    if (!setting.whole) throw UsageError("--report-rigid: all joints move, there is nothing to compare with");
    Setting whole;
    whole.tree = setting.whole->tree;
    whole.ranges = setting.whole->places.whole;
    whole.scene = setting.whole->scene;
    return whole;
}

} // namespace

template <class T>
RigidReport<T>::RigidReport(const Setting& setting, const RunOptions& options)
    : setting_(whole_setting(setting)), whole_(*setting.whole), options_(options),
      run_(started(planned<T>(setting_, {}, options), setting_, options)), comparison_(whole_.tree) {}

template <class T> void RigidReport<T>::follow(const Plan<T>& plan, const State<T>& state, std::int64_t frame) {
    using Time = std::chrono::steady_clock;
    const Time::time_point start = Time::now();
    advance_frame(run_, setting_.tree, frame, options_.substeps);
    ms_ += std::chrono::duration<double, std::milli>(Time::now() - start).count();
    present(run_.plan, run_.state);
    comparison_.tips_of(run_.state, there_);
    comparison_.tips_of(whole_.places, plan, state, here_);
    comparison_.compare(there_, here_);
}

template <class T> std::string RigidReport<T>::line(double run_ms, std::int64_t frames) const {
    const RigidError e = comparison_.result();
    const std::string joints = std::to_string(whole_.places.leader.size()) + " of " +
                               std::to_string(whole_.tree.size_bodies()) + " joints move";
    if (e.frames == 0 || frames == 0) return "rigid " + joints + "; too few frames to compare";
    if (e.tips == 0) return "rigid " + joints + "; there is no branch whose tip could be compared";
    const double height = 100 / e.height;
    return "rigid " + joints +
           formatted("; tips off by %.3g m RMS, %.3g m at most (%.2g and %.2g %% of the height), of %.3g m that they "
                     "move RMS; %.4g ms a frame, with all joints %.4g",
                     e.rms, e.worst, height * e.rms, height * e.worst, e.deflection, run_ms / double(frames),
                     ms_ / double(frames));
}

template class RigidReport<float>;
template class RigidReport<double>;

} // namespace bough
