#include "run_options.h"
#include "exits.h"
#include "made_with.h"
#include "reader_options.h"
#include "set_option.h"
#include <array>
#include <cmath>
#include <sstream>

namespace bough {
namespace {

constexpr std::int64_t most_frames = 9'000'000'000'000'000; // a frame's number is a double where its time is worked out

// A line of help: what each solver is for, the default marked.
std::string solver_help() {
    constexpr std::array<std::pair<Solver, const char*>, all_solvers.size()> uses{{
        {Solver::coupled, "the full dynamics by one linear solve (--scheme), true at one step a frame"},
        {Solver::analytic, "the paper's, each joint by itself: lively at any stiffness, not true at any step"},
        {Solver::articulated_explicit, "Euler, for comparison: unstable but at tiny steps"},
        {Solver::articulated_implicit, "linearly implicit Euler, for comparison: damps what a step does not resolve"},
        {Solver::articulated_reference, "high order, adaptive, slow: the truth to hold others against"},
    }};
    std::string text = "How a step is made:";
    for (const auto& [solver, use] : uses)
        text += std::string(solver == uses.front().first ? " " : "; ") + solver_name(solver) +
                (solver == default_solver ? " (default): " : ": ") + use;
    return text;
}

} // namespace

Solver chosen_solver(const RunOptions& o) {
    for (const Solver solver : all_solvers)
        if (o.solver == solver_name(solver)) return solver;
    throw UsageError("--solver is '" + o.solver + "', which is unknown");
}

std::string wind_file(const std::string& wind) {
    return wind_preset(wind) ? std::string() : wind;
}

std::string rate_text(double rate) {
    std::ostringstream text;
    text << rate;
    return text.str();
}

void add_simd_option(OptionList& list, RunOptions& o) {
    list.group("Numerics");
    list.add("--simd", o.simd,
             "Which SIMD code coupled and analytic step with: auto (default): the widest of avx512, avx2 and "
             "baseline that this machine has; off: the plain step, body by body")
        .takes("NAME")
        .one_of({"auto", "off", "baseline", "avx2", "avx512"});
}

void add_sleep_option(OptionList& list, RunOptions& o) {
    list.group("Numerics");
    list.add("--sleep", o.sleep,
             "Leave out subtrees at rest: whose bodies, and what carries them, have turned by less than RATE "
             "[rad/s] for a second, until they are moved again; or off (" +
                 (o.sleep_default > 0 ? rate_text(o.sleep_default) : "off") + ")")
        .takes("RATE|off");
}

void add_wind_option(OptionList& list, RunOptions& o) {
    list.group("Wind");
    list.add("--wind", o.wind, "Wind: calm, breeze, gusty, storm, or a bough-wind file")
        .takes("NAME|FILE")
        .suggests({"calm", "breeze", "gusty", "storm"});
}

void add_run_options(OptionList& list, RunOptions& o, double seconds_default) {
    const std::string seconds_text = std::to_string(int(seconds_default));
    list.group("Input");
    list.add("INPUT", o.input,
             "A tree, any file that treeconvert takes (converted with its defaults), or a scene; - for stdin");
    add_set_option(list, o.set);
    list.add("--gravity", o.gravity, "Gravity [m/s2] (0,-9.81,0)").takes("X,Y,Z");
    add_reader_options(list);
    add_wind_option(list, o);
    list.add("--seed", o.seed, "Seed of the wind's turbulence").takes("N").check(whole_number(0));
    list.group("Length");
    OptionEntry seconds = list.add("--seconds", o.seconds, "Length of the run [s] (" + seconds_text + ")")
                              .takes("S")
                              .check(not_negative_number());
    list.add("--frames", o.frames, "Length of the run in frames, the start included")
        .takes("N")
        .check(whole_number(1, most_frames))
        .excludes(seconds);
    list.add("--fps", o.fps, "Frames a second (30)").takes("F").check(positive_number());
    list.group("Numerics");
    list.add("--substeps", o.substeps, "Steps a frame (1)").takes("N").check(whole_number(1, 1000000));
    std::vector<std::string> solvers;
    for (const Solver solver : all_solvers) solvers.push_back(solver_name(solver));
    list.add("--solver", o.solver, solver_help()).takes("NAME").one_of(solvers);
    std::vector<std::string> schemes;
    for (const Scheme scheme : all_schemes) schemes.push_back(scheme_of(scheme).name);
    list.add("--scheme", o.scheme,
             "Which rational function coupled steps with: " + std::string(scheme_of(Scheme()).name) +
                 " (default): robust; P.25, P.5: damp less, stiff joints lag more; P34: true to higher "
                 "frequencies, two solves a step; LIE, for comparison: first order")
        .takes("NAME")
        .one_of_any_case(schemes); // and then in the table's spelling
    add_simd_option(list, o);
    list.add("--tolerance", o.tolerance, "Error allowed in a step of articulated-reference [rad] (1e-8)")
        .takes("RAD")
        .check(positive_number());
    list.add("--precision", o.precision, "float or double (double)").takes("NAME").one_of({"float", "double"});
    // What only repeats a field of the scene.
    list.renamed("--pose", "--set pose=NAME");
    list.renamed("--stiffness-scale", "--set stiffness_scale=X");
    list.renamed("--damping-scale", "--set damping_scale=X");
    list.renamed("--joint-limit", "--set joint_limit=DEG");
    name_treeconverts_options(list);
    list.elsewhere("--stiffness", "there is --set stiffness_scale=X");
    list.elsewhere("--damping", "there is --set damping_scale=X");
    list.elsewhere("--speed", "there is --set wind.velocity=[X,0,0], a steady wind in m/s");
    list.elsewhere("--leaves", "trees grow them by treegen --leaves; an imported tree keeps the leaves of its file");
}

void name_treeconverts_options(OptionList& list) {
    for (const char* name : {"--units", "--up", "--trunk-diameter", "--scan-radii", "--material", "--segment-length",
                             "--max-bodies", "--keep-place", "--radii"})
        list.elsewhere(name,
                       std::string("is treeconvert's: treeconvert FILE ") + name +
                           " ... -o TREE.json, then this tool with TREE.json (treesim --skin FILE shows FILE's own "
                           "mesh)");
    list.elsewhere("--root-stiffness", "there is --set material.root_stiffness=K, and treeconvert's --root-stiffness");
}

std::int64_t frames_of(const RunOptions& o, double seconds_default) {
    if (o.frames) return *o.frames;
    const double frames = std::round(o.seconds.value_or(seconds_default) * o.fps) + 1;
    if (!(frames <= double(most_frames)))
        throw UsageError("--seconds: is more than " + std::to_string(most_frames) + " frames, which times are told by");
    return std::int64_t(frames);
}

Scheme chosen_scheme(const RunOptions& o) {
    if (o.scheme.empty()) return Scheme();
    for (const Scheme scheme : all_schemes)
        if (o.scheme == scheme_of(scheme).name) return scheme;
    throw UsageError("--scheme is '" + o.scheme + "', which is unknown");
}

std::optional<fast::Target> chosen_simd(const RunOptions& o) {
    if (o.simd == "off") return std::nullopt;
    if (o.simd == "auto") return fast::best_target();
    const std::optional<fast::Target> target = fast::target_named(o.simd);
    if (!target || !fast::available(*target))
        throw UsageError("--simd " + o.simd + ": this machine or build does not have it; auto is " + simd_target() +
                         " here");
    return target;
}

double chosen_sleep(const RunOptions& o) {
    if (o.sleep.empty()) return o.simd == "off" ? 0 : o.sleep_default;
    if (o.sleep == "off") return 0;
    if (!o.shard.empty())
        throw UsageError("--sleep " + o.sleep +
                         ": not with --shard; trees sleep by blocks, which those of the whole share");
    const std::optional<double> rate = parse_number(o.sleep);
    if (!rate || !(*rate > 0))
        throw UsageError("--sleep is '" + o.sleep + "', expected a rate above 0 [rad/s], or off");
    if (o.simd == "off") throw UsageError("--sleep: not with --simd off, the plain step, in which nothing sleeps");
    if (chosen_solver(o) != Solver::coupled) throw UsageError("--sleep: only with --solver coupled");
    return *rate;
}

std::string scheme_name(const RunOptions& o) {
    return chosen_solver(o) == Solver::coupled ? scheme_of(chosen_scheme(o)).name : "";
}

} // namespace bough
