#include "notes.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>

namespace bough {
namespace {

std::string percent(double share) {
    std::ostringstream text;
    share = std::min(100.0, 100 * share);
    text << std::setprecision(share < 10 ? 2 : 3) << share << " %";
    return text.str();
}

// What turned too fast for the step to follow. Where that is a body in a thousand there is nothing to do about it.
void note_fast_turns(const RunAccount& run, std::int64_t steps, std::vector<std::string>& notes) {
    const StepFlags& flags = run.flags;
    const double all = double(steps) * double(run.bodies);
    const std::uint64_t most = std::max({flags.half_turns, flags.energy_guard, flags.fast_turns});
    if (!(double(most) > 1e-3 * all)) return;
    // a body's turn counts where it is its own and where it carries
    notes.push_back(
        "leaves or twigs turn faster than the steps can follow (" + percent(double(most) / all) +
        " of the bodies by more than 60 degrees a step): the picture may flicker there; --substeps 2 follows "
        "them, --fps 60 shows them too, and in a .glb --leaves-as instances holds leaves still");
}

void note_flags(const RunAccount& run, std::int64_t steps, std::vector<std::string>& notes) {
    const StepFlags& flags = run.flags;
    if (flags.buckling > 0)
        notes.push_back("some wood is too soft for what it carries and buckles: stiffer wood (--set material.E=...) or "
                        "thicker radii hold it; treeconvert --stats names a branch");
    note_fast_turns(run, steps, notes);
    if (flags.unresolved > 0)
        notes.push_back(percent(double(flags.unresolved) / double(flags.inner_steps)) +
                        " of the inner steps missed the tolerance: this is no reference solution; a coarser "
                        "--tolerance, or more --substeps, can be kept");
}

void note_world(const RunAccount& run, const Scene& scene, std::vector<std::string>& notes) {
    if (!scene.fracture && scene.balls.empty()) return;
    std::string broke;
    constexpr std::array<std::array<const char*, 2>, 4> kinds{
        {{"branch", "branches"}, {"leaf", "leaves"}, {"fruit", "fruit"}, {"petal", "petals"}}};
    static_assert(std::size_t(Kind::branch) == 0 && std::size_t(Kind::leaf) == 1 && std::size_t(Kind::fruit) == 2 &&
                  std::size_t(Kind::petal) == 3);
    std::uint64_t all = 0;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        all += run.broke[k];
        if (run.broke[k] > 0) broke += (broke.empty() ? "" : ", ") + counted(run.broke[k], kinds[k][0], kinds[k][1]);
    }
    std::ostringstream text;
    text.precision(3);
    text << counted(all, "joint", "joints") << " broke" << (broke.empty() ? "" : " (" + broke + ")") << ", "
         << counted(run.landed, "leaf or petal", "leaves and petals") << " landed, "
         << counted(run.hits, "hit", "hits");
    notes.push_back(text.str());
    if (!scene.contact || scene.contact->model != ContactModel::penalty) return;
    text.str("");
    text << "the paper's pair of penalty and impulse left " << run.imbalance
         << " N s of momentum out of balance (/contact/model)";
    notes.push_back(text.str());
}

} // namespace

void note_run(const RunAccount& run, const Scene& scene, std::int64_t steps, std::vector<std::string>& notes) {
    note_flags(run, steps, notes);
    note_world(run, scene, notes);
}

std::string guards_lines(const RunAccount& run, std::int64_t steps) {
    const StepFlags& flags = run.flags;
    std::ostringstream text;
    const auto line = [&](const char* name, std::uint64_t count, const char* meaning) {
        text << "guards " << name << " " << count << " " << meaning << "\n";
    };
    text << "guards of " << std::uint64_t(steps) * run.bodies << " steps of a body\n";
    line("fast_turns", flags.fast_turns, "turns by more than a radian");
    line("half_turns", flags.half_turns, "joints turned past half a turn");
    line("energy", flags.energy_guard, "kept from gaining energy");
    line("buckling", flags.buckling, "joints softer than gravity's pull on them");
    line("growth", flags.bounded_lambda, "joints whose growth was bounded");
    line("limits", flags.limited, "joints stopped at their limit");
    line("asleep", flags.asleep, ("left out at rest below " + rate_text(run.sleep) + " rad/s").c_str());
    line("unresolved", flags.unresolved, "inner steps that missed the tolerance");
    return text.str();
}

std::string cost_line(const RunAccount& run, const RunOptions& o, double ms, std::int64_t frames) {
    std::ostringstream text;
    text.precision(4);
    text << "cost " << run.bodies << " bodies, " << o.substeps << (o.substeps == 1 ? " step" : " steps")
         << " a frame, ";
    if (frames > 0)
        text << ms / double(frames) << " ms a frame";
    else
        text << "no frame";
    text << "\n";
    return text.str();
}

} // namespace bough
