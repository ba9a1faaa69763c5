#include "wind_trial.h"
#include "formatted.h"
#include "progress.h"
#include "signals.h"
#include "simulation.h"
#include <numbers>

namespace bough {

WindFit wind_by_trial(const Tree& tree, const JointGroups& groups, const MergeChoice& choice,
                      const CommonOptions& common, const std::string& input) {
    RunOptions run;
    run.input = input;
    run.wind = trial_wind_of(choice);
    const auto setting = std::make_shared<Setting>();
    setting->scene = chosen_scene(run);
    stand(*setting, tree, {});
    apply_scene(*setting, input);
    RunWishes wishes;
    wishes.poses = true;
    Simulation simulation = started(setting, run, common.threads, wishes);
    const auto frames = std::int64_t(std::round(trial_seconds_of(choice) * run.fps));
    interrupt_at_boundary();
    Progress progress(common, "frame (trial run)", frames);
    simulation.settle(simulation.settling_time());
    WindMotion motion(tree, groups);
    for (std::int64_t f = 1; f <= frames; ++f) {
        if (interrupted()) throw Interrupted("interrupted: nothing is written");
        advance_frame(simulation, f, run.substeps);
        motion.add(simulation.rotations());
        progress.at(f);
    }
    return motion.fit();
}

std::string wind_note(const WindFit& fit, const MergeChoice& choice) {
    std::string text = "--wind-groups: influences of";
    for (std::size_t g = 0; g < fit.group.size(); ++g) {
        const WindInfluence& of = fit.group[g];
        text += (g > 0 ? ", " : " ") +
                (of.dual ? formatted("%.2g to %.2g", of.least, of.most) : formatted("%.2g", of.influence));
        if (of.dual && of.shift > 0) text += formatted(" from %.2g of the branch on", of.shift);
    }
    const double degrees = 180 / std::numbers::pi;
    return text +
           formatted(
               " (trunk first, 1 is %.2g degrees) fit %g s of %s wind: joints turn by %.2g degrees RMS, off by %.2g; "
               "%.0f %% of the turns' variance",
               fit.unit * degrees, trial_seconds_of(choice), trial_wind_of(choice).c_str(), fit.rms * degrees,
               fit.off * degrees, 100 * fit.explained);
}

} // namespace bough
