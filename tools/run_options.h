// run_options.h: the options that decide how trees move, the same for treesim and treeprofile, and what they choose.
#pragma once
#include "lib/model/scene.h"
#include "lib/study/solvers.h"
#include "option_list.h"

namespace bough {

// What runs without --solver. Help, messages and tests follow it.
constexpr Solver default_solver = Solver::coupled;

struct RunOptions {
    std::string input;
    std::optional<double> seconds;
    std::optional<std::int64_t> frames;
    double fps = 30;
    int substeps = 1;
    std::string wind, gravity, solver = solver_name(default_solver), precision = "double";
    std::string scheme; // of the coupled solver; empty: its default
    std::string simd = "auto";
    std::string sleep;        // as given: a rate or off; empty: sleep_default
    double sleep_default = 0; // [rad/s] the tool's own
    std::optional<double> tolerance;
    std::optional<std::uint64_t> seed;
    std::vector<std::string> set; // as given: PATH=VALUE, set_option.h
    std::string shard;            // "i/n", of treesim; empty: all
    bool asks_for_sleep() const { return !sleep.empty() && sleep != "off"; }
};

// seconds_default: what runs without --seconds and --frames.
void add_run_options(OptionList&, RunOptions&, double seconds_default);

// Who asks a tool that reads trees for what treeconvert does is told so.
void name_treeconverts_options(OptionList&);

void add_simd_option(OptionList&, RunOptions&);
void add_wind_option(OptionList&, RunOptions&);
void add_sleep_option(OptionList&, RunOptions&); // with sleep_default as it stands

// Frames that the options ask for: --frames as given, --seconds S as round(S fps) + 1, because frame 0 is the start.
std::int64_t frames_of(const RunOptions&, double seconds_default);

// The file that --wind names; empty for a preset and where no wind is named.
std::string wind_file(const std::string& wind);

// Throws UsageError for a name that is unknown.
Solver chosen_solver(const RunOptions&);

// The one that --scheme names, or the coupled solver's default; its name, empty for all other solvers.
Scheme chosen_scheme(const RunOptions&);
std::string scheme_name(const RunOptions&);

// The SIMD target that --simd names; none for the plain path. Throws UsageError for one that this machine lacks.
std::optional<fast::Target> chosen_simd(const RunOptions&);

// [rad/s] below which what has settled sleeps (lib/coupled/sleep.h); 0: nothing does. Throws UsageError for what is no rate, and for
// one given with --simd off.
double chosen_sleep(const RunOptions&);
std::string rate_text(double rate); // "1e-05"

} // namespace bough
