#include "loop.h"
#include "formatted.h"
#include "lib/study/trajectory.h"
#include "progress.h"
#include "signals.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

constexpr double tolerance_default = 1e-4;
constexpr std::int64_t periods_default = 20, blend_periods_default = 5; // these only let the start be forgotten

// Tips of branches, then leaves, petals and fruit.
std::vector<std::size_t> far_ends(const Tree& tree, std::size_t& tips) {
    std::vector<std::size_t> ends = tip_bodies(tree);
    tips = ends.size();
    for (std::size_t i = 0; i < tree.size_bodies(); ++i)
        if (tree.kind[i] != Kind::branch) ends.push_back(i);
    return ends;
}

template <class T>
void look(Run<T>& run, const Tree& tree, const std::vector<std::size_t>& ends, std::vector<Vec3>& place) {
    present(run.plan, run.state);
    place.resize(ends.size());
    for (std::size_t k = 0; k < ends.size(); ++k) place[k] = tip_position(run.plan, run.state, tree, ends[k]);
}

struct Distance {
    double branches = 0, others = 0; // [m] largest
    double largest() const { return std::max(branches, others); }
    void add(const std::vector<Vec3>& a, const std::vector<Vec3>& b, std::size_t tips) {
        for (std::size_t k = 0; k < a.size(); ++k) {
            double& most = k < tips ? branches : others;
            most = std::max(most, (a[k] - b[k]).norm());
        }
    }
};

template <class T> double height_of(Run<T>& run, const Tree& tree, const std::vector<std::size_t>& ends) {
    std::vector<Vec3> place;
    look(run, tree, ends, place);
    std::vector<std::size_t> root(tree.size_bodies());
    for (std::size_t i = 0; i < root.size(); ++i) root[i] = tree.parent[i] < 0 ? i : root[std::size_t(tree.parent[i])];
    double height = 0;
    for (std::size_t k = 0; k < ends.size(); ++k)
        height = std::max(height, (place[k] - tree.joint_position[root[ends[k]]]).norm());
    return height;
}

std::string apart(const Distance& distance, const LoopStart& start) {
    std::string text = formatted("%.3g m (%.2g of the height)", distance.largest(), distance.largest() / start.height);
    if (start.tips < start.end.size()) text += formatted(", branches by %.3g m", distance.branches);
    return text;
}

std::string not_closed(const std::string& what, double tolerance) {
    return what + ", more than " + formatted("%.2g", tolerance) +
           " (--loop-tolerance); --loop-blend makes the ends meet all the same, more "
           "periods (--loop-periods) or damping (--damping-scale) may close it";
}

} // namespace

void add_loop_options(OptionList& list, LoopChoice& o) {
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
                         ", it is the length itself");
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

void make_periodic(std::int64_t frames, double fps, Scene& scene) {
    const std::pair<bool, const char*> passing[] = {{!scene.pulls.empty(), "/pulls"},
                                                    {!scene.root_motion.empty(), "/root_motion"},
                                                    {!scene.balls.empty(), "/balls"},
                                                    {scene.fracture.has_value(), "/fracture"},
                                                    {!scene.walkers.empty(), "/walkers"}};
    for (const auto& [there, pointer] : passing)
        if (there)
            throw UsageError(std::string("--loop: not with the scene's ") + pointer +
                             ", which passes and does not come back");
    if (!scene.wind) throw UsageError("--loop: the scene has no /wind, so that nothing would move in it; see --wind");
    const double seconds = double(frames) / fps;
    if (scene.wind->period) {
        const double turns = seconds / *scene.wind->period;
        if (std::round(turns) >= 1 && std::abs(turns - std::round(turns)) <= 1e-6 * turns) return;
        throw UsageError("--loop is " + formatted("%.10g s, but the scene's /wind/period is %.10g s, which does not "
                                                  "go into it a whole number of times; leave it out",
                                                  seconds, *scene.wind->period));
    }
    scene.wind->period = seconds;
}

template <class T>
LoopStart close_loop(Run<T>& run, const Tree& tree, const LoopChoice& o, const RunOptions& options,
                     const CommonOptions& common, std::optional<Run<T>>& before_run) {
    const std::int64_t n = loop_frames(o, options),
                       most = o.periods.value_or(o.blend ? blend_periods_default : periods_default);
    LoopStart start;
    const std::vector<std::size_t> ends = far_ends(tree, start.tips);
    start.height = height_of(run, tree, ends);
    const double tolerance = o.tolerance.value_or(tolerance_default);
    std::vector<std::int64_t> looks{1, n / 4, n / 2, 3 * n / 4, n};
    looks.erase(std::remove(looks.begin(), looks.end(), 0), looks.end());
    std::sort(looks.begin(), looks.end());
    looks.erase(std::unique(looks.begin(), looks.end()), looks.end());
    std::vector<std::vector<Vec3>> before(looks.size());
    Distance distance;
    Progress progress(common, "frame (until it repeats)", n * most);
    while (!start.closed && start.periods < most) {
        distance = {};
        std::size_t next = 0;
        for (std::int64_t f = 1; f <= n; ++f) {
            if (interrupted())
                throw Interrupted("interrupted in period " + std::to_string(start.periods + 1) +
                                  ", before the loop's first frame");
            advance_frame(run, tree, start.periods * n + f, options.substeps);
            progress.at(start.periods * n + f);
            if (o.blend && f == n - blended_frames(n)) before_run.emplace(run);
            if (f != looks[next]) continue;
            look(run, tree, ends, start.end);
            if (start.periods > 0) distance.add(start.end, before[next], start.tips);
            before[next++] = start.end;
        }
        start.closed = ++start.periods > 1 && distance.largest() <= tolerance * start.height;
    }
    if (start.closed || o.blend) return start;
    throw PromiseError(not_closed("the motion does not repeat after " + std::to_string(start.periods) +
                                      " periods: from one to the next its ends are off by " + apart(distance, start),
                                  tolerance));
}

template <class T>
void measure_seam(Run<T>& run, const Tree& tree, const LoopStart& start, const LoopChoice& o, const RunOptions& options,
                  std::vector<std::string>& notes) {
    advance_frame(run, tree, loop_frames(o, options), options.substeps);
    std::size_t tips = 0;
    std::vector<Vec3> end;
    look(run, tree, far_ends(tree, tips), end);
    Distance distance;
    distance.add(start.end, end, tips);
    const std::string after = " after " + std::to_string(start.periods) + " periods";
    if (o.blend)
        notes.push_back("loop's ends were apart by " + apart(distance, start) + after + ": blended (--loop-blend)");
    else
        notes.push_back("loop closed to " + apart(distance, start) + after);
    const double tolerance = o.tolerance.value_or(tolerance_default);
    if (!o.blend && distance.largest() > tolerance * start.height)
        throw PromiseError(
            not_closed("the loop, written all the same, closes to " + apart(distance, start), tolerance));
}

template LoopStart close_loop(Run<float>&, const Tree&, const LoopChoice&, const RunOptions&, const CommonOptions&,
                              std::optional<Run<float>>&);
template LoopStart close_loop(Run<double>&, const Tree&, const LoopChoice&, const RunOptions&, const CommonOptions&,
                              std::optional<Run<double>>&);
template void measure_seam(Run<float>&, const Tree&, const LoopStart&, const LoopChoice&, const RunOptions&,
                           std::vector<std::string>&);
template void measure_seam(Run<double>&, const Tree&, const LoopStart&, const LoopChoice&, const RunOptions&,
                           std::vector<std::string>&);

} // namespace bough
