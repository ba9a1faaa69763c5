#include "merge_trial.h"
#include "formatted.h"
#include "lib/study/merge_below.h"
#include "progress.h"
#include "signals.h"
#include "simulation.h"
#include <stdexcept>

namespace bough {
namespace {

constexpr double trial_seconds = 10;
constexpr const char* trial_wind = "gusty";

} // namespace

void add_merge_options(OptionList& list, MergeChoice& choice) {
    list.add("--merge-below", choice.below,
             "Make rigid the joints that hardly move in a trial run: as many as leave the tips of branches within "
             "ERROR [m] of where the whole tree has them, in every frame of that run (treesim then runs the rest)")
        .takes("ERROR")
        .check(positive_number());
    list.add("--wind", choice.wind, "With --merge-below or --wind-groups: the trial run's wind, as of treesim (gusty)")
        .takes("NAME|FILE");
    list.add("--seconds", choice.seconds, "With --merge-below or --wind-groups: the trial run's length [s] (10)")
        .takes("S")
        .check(positive_number());
}

std::string trial_wind_of(const MergeChoice& choice) {
    return choice.wind.empty() ? trial_wind : choice.wind;
}
double trial_seconds_of(const MergeChoice& choice) {
    return choice.seconds.value_or(trial_seconds);
}

void refuse_merge_contradictions(const MergeChoice& choice, bool wind_groups) {
    const bool trial = choice.below || wind_groups;
    if (!trial && !choice.wind.empty()) throw UsageError("--wind: only with --merge-below or --wind-groups");
    if (!trial && choice.seconds) throw UsageError("--seconds: only with --merge-below or --wind-groups");
    const MergeBelow how;
    if (choice.seconds && !(std::round(*choice.seconds * how.fps) >= 1 && *choice.seconds < 1e6))
        throw UsageError("--seconds: a trial of at least one frame is needed, of at most a million seconds");
}

std::string merge_by_trial(Tree& tree, const MergeChoice& choice, const CommonOptions& common,
                           const std::string& input) {
    RunOptions run;
    run.wind = trial_wind_of(choice);
    MergeBelow how;
    how.error = *choice.below;
    how.scene = chosen_scene(run);
    how.seconds = trial_seconds_of(choice);
    how.simd = chosen_simd(run);
    MergedBelow merged;
    {
        const auto frames = std::int64_t(std::round(how.seconds * how.fps));
        Progress progress(common, "frame (trial runs)", frames * (how.runs + 1));
        how.tick = [&](std::int64_t frame, std::int64_t) {
            if (interrupted()) throw Interrupted("interrupted: nothing is written");
            progress.at(frame);
        };
        interrupt_at_boundary();
        try {
            merged = merge_below(tree, {{0, tree.size_bodies(), 0}}, how);
        } catch (const std::domain_error& error) {
            throw InputError(input_name(input), std::string("--merge-below: ") + error.what());
        }
    }
    const RigidError& e = merged.found;
    std::string line = "rigid       " + std::to_string(merged.joints - merged.moving) + " of " +
                       std::to_string(merged.joints) + " joints, " + std::to_string(merged.moving) +
                       " left to move (--merge-below " + formatted("%g", how.error) + " m, " + run.wind +
                       formatted(", %g s, ", how.seconds) + std::to_string(merged.runs) + " runs of merged trees)";
    if (e.frames == 0) return line + ": no joint moves the tips by so little\n";
    return line + formatted(": tips off by %.3g m at most, %.3g m RMS (%.2g and %.2g %% of the height)\n", e.worst,
                            e.rms, 100 * e.worst / e.height, 100 * e.rms / e.height);
}

} // namespace bough
