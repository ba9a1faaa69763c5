#include "notes.h"
#include "lib/base/counted.h"
#include "lib/lanes/plan_lanes.h"
#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>

namespace bough {

// What turned too fast for the step to follow. Where that is a body in a thousand there is nothing to do about it.
template <class T>
void note_fast_turns(const Plan<T>& plan, const StepFlags& flags, std::int64_t steps, std::vector<std::string>& notes) {
    const double all = double(steps) * double(plan.bodies);
    const std::uint64_t most = std::max({flags.half_turns, flags.energy_guard, flags.fast_turns});
    if (!(double(most) > 1e-3 * all)) return;
    std::ostringstream text;
    const double share =
        std::min(100.0, 100 * double(most) / all); // a body's turn counts where it is its own and where it carries
    text << std::setprecision(share < 10 ? 2 : 3) << share << " % of the bodies' steps turned too fast for the step ("
         << flags.fast_turns << " by more than a radian, " << flags.half_turns << " past half a turn, "
         << flags.energy_guard << " held from gaining energy): smaller steps (--substeps) show whether it matters";
    notes.push_back(text.str());
}

template <class T>
void note_flags(const Plan<T>& plan, const StepFlags& flags, std::int64_t steps, std::vector<std::string>& notes) {
    if (flags.buckling > 0)
        notes.push_back(counted(flags.buckling, "time", "times") +
                        " a joint was softer than gravity's pull on it (buckling)");
    if (flags.bounded_lambda > 0)
        notes.push_back(counted(flags.bounded_lambda, "time", "times") + " a joint's growth in a step was bounded");
    note_fast_turns(plan, flags, steps, notes);
    if (flags.limited > 0)
        notes.push_back(counted(flags.limited, "time", "times") + " a joint was stopped at its limit, as asked");
    if (flags.asleep > 0)
        notes.push_back(std::to_string(flags.asleep) + " of " + std::to_string(std::uint64_t(steps) * plan.bodies) +
                        " steps of a body were left out: at rest below " +
                        rate_text(fast::planned_lanes(plan)->sleep.rate) + " rad/s (--sleep)");
    if (flags.unresolved > 0)
        notes.push_back(std::to_string(flags.unresolved) + " of " + std::to_string(flags.inner_steps) +
                        " inner steps missed the tolerance: this is no reference solution");
}

template <class T> void note_world(const World<T>& world, std::vector<std::string>& notes) {
    if (!world.on() || (!world.remaining.gone.size() && world.free.empty())) return;
    const WorldCounts& counts = world.counts;
    std::string broke;
    constexpr std::array<std::array<const char*, 2>, 4> kinds{
        {{"branch", "branches"}, {"leaf", "leaves"}, {"fruit", "fruit"}, {"petal", "petals"}}};
    static_assert(std::size_t(Kind::branch) == 0 && std::size_t(Kind::leaf) == 1 && std::size_t(Kind::fruit) == 2 &&
                  std::size_t(Kind::petal) == 3);
    std::uint64_t all = 0;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        all += counts.broke[k];
        if (counts.broke[k] > 0)
            broke += (broke.empty() ? "" : ", ") + counted(counts.broke[k], kinds[k][0], kinds[k][1]);
    }
    std::ostringstream text;
    text.precision(3);
    text << counted(all, "joint", "joints") << " broke" << (broke.empty() ? "" : " (" + broke + ")") << ", "
         << counted(counts.landed, "leaf or petal", "leaves and petals") << " landed, "
         << counted(counts.hits, "hit", "hits");
    notes.push_back(text.str());
    if (world.contact.model != ContactModel::penalty) return;
    text.str("");
    text << "the paper's pair of penalty and impulse left " << counts.imbalance
         << " N s of momentum out of balance (/contact/model)";
    notes.push_back(text.str());
}

template <class T> std::string cost_line(const Plan<T>& plan, const RunOptions& o, double ms, std::int64_t frames) {
    std::ostringstream text;
    text.precision(4);
    text << "cost " << plan.bodies << " bodies, " << o.substeps << (o.substeps == 1 ? " step" : " steps")
         << " a frame, ";
    if (frames > 0)
        text << ms / double(frames) << " ms a frame";
    else
        text << "no frame";
    text << "\n";
    return text.str();
}

template void note_flags(const Plan<float>&, const StepFlags&, std::int64_t, std::vector<std::string>&);
template void note_flags(const Plan<double>&, const StepFlags&, std::int64_t, std::vector<std::string>&);
template void note_world(const World<float>&, std::vector<std::string>&);
template void note_world(const World<double>&, std::vector<std::string>&);
template std::string cost_line(const Plan<float>&, const RunOptions&, double, std::int64_t);
template std::string cost_line(const Plan<double>&, const RunOptions&, double, std::int64_t);

} // namespace bough
