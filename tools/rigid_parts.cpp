#include "rigid_parts.h"
#include "exits.h"
#include "formats/open.h"
#include "formatted.h"
#include "lib/stages/hold.h"
#include <chrono>
#include <stdexcept>

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

void join_rigid(Setting& setting, const std::string& input) {
    if (!setting.scene.simulate && setting.tree.rigid.empty()) return;
    try {
        const HeldJoints held = hold_rigid(setting.tree, setting.ranges, setting.scene);
        setting.changes.push_back((setting.scene.simulate ? "/simulate: " : "/rigid: ") + text_of(held));
        setting.scene.simulate.reset();
        if (!has_rigid(setting.tree)) return setting.tree.rigid.clear();
        const Scene& scene = setting.scene;
        if (const char* part = free_part(scene) ? free_part(scene) : setting.tree.load.empty() ? nullptr : "/load")
            throw InputError(input_name(input),
                             std::string(part) + ": not with rigid parts (/simulate, or /rigid of a tree), expected a "
                                                 "tree whose joints all move");
        auto whole = std::make_shared<Whole>();
        whole->places = reduce(setting.tree, setting.ranges, setting.scene);
        whole->scene = setting.scene;
        if (whole->places.leader.empty())
            throw InputError(input_name(input), "nothing is left that moves: " + text_of(held));
        setting.scene = scene_on(whole->places, setting.tree, setting.scene);
        whole->tree = std::move(setting.tree);
        whole->tree.rigid.clear();
        setting.tree = std::move(whole->places.tree);
        whole->places.tree = {};
        setting.ranges = whole->places.ranges;
        setting.whole = std::move(whole);
    } catch (const std::out_of_range& error) {
        throw InputError(input_name(input), error.what());
    } catch (const std::domain_error& error) {
        throw InputError(input_name(input), error.what());
    }
}

template <class T>
void show_whole(const Setting& setting, const Plan<T>& plan, const State<T>& state, MotionFrame& frame) {
    if (setting.whole) expand_frame(setting.whole->places, setting.whole->tree, plan, state, frame);
}

template <class T>
RigidReport<T>::RigidReport(const Setting& setting, const RunOptions& options)
    : setting_(whole_setting(setting)), whole_(*setting.whole), options_(options),
      run_(start_run(plan_run<T>(setting_, {}, options), setting_, options)), comparison_(whole_.tree) {}

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

template void show_whole(const Setting&, const Plan<float>&, const State<float>&, MotionFrame&);
template void show_whole(const Setting&, const Plan<double>&, const State<double>&, MotionFrame&);
template class RigidReport<float>;
template class RigidReport<double>;

} // namespace bough
