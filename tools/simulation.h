// simulation.h: what treesim and treeprofile share: the options of a run, its trees and scene, and one run as frames.
#pragma once
#include "common.h"
#include "lib/free/world.h"
#include "lib/model/motion.h"
#include "lib/model/scene.h"
#include "lib/reference/advance.h"
#include "lib/stages/plan.h"
#include "lib/stages/reduce.h"
#include "lib/stages/state.h"
#include <memory>

namespace bough {

// What runs without --solver. Help, messages and tests follow it.
constexpr Solver default_solver = Solver::coupled;

struct RunOptions {
    std::string input;
    std::optional<double> seconds;
    std::optional<std::int64_t> frames;
    double fps = 30;
    int substeps = 1;
    std::string wind, gravity, solver = solver_name(default_solver), precision = "double", pose, joint_inertia;
    std::string scheme; // of the coupled solver; empty: its default
    std::string simd = "auto";
    std::string sleep;        // as given: a rate or off; empty: sleep_default
    double sleep_default = 0; // [rad/s] the tool's own
    std::string refresh;      // as given: a tolerance or always; empty: chosen_refresh
    std::optional<double> stiffness_scale, damping_scale, joint_limit, tolerance;
    std::optional<std::uint64_t> seed;
    std::vector<std::string> set; // as given: PATH=VALUE, set_option.h
    std::string shard;            // "i/n", of treesim; empty: all
};

// seconds_default: what runs without --seconds and --frames.
void add_run_options(CLI::App&, RunOptions&, double seconds_default);

void add_simd_option(CLI::App&, RunOptions&);
void add_refresh_option(CLI::App&, RunOptions&);
void add_sleep_option(CLI::App&, RunOptions&); // with sleep_default as it stands

// Frames that the options ask for: --frames as given, --seconds S as round(S fps) + 1, because frame 0 is the start.
std::int64_t frames_of(const RunOptions&, double seconds_default);

// The one that --scheme names, or the coupled solver's default; its name, empty for all other solvers.
Scheme chosen_scheme(const RunOptions&);
std::string scheme_name(const RunOptions&);

// The SIMD target that --simd names; none for the plain path. Throws UsageError for one that this machine lacks.
std::optional<fast::Target> chosen_simd(const RunOptions&);

// [rad/s] below which what has settled sleeps (lib/fast/sleep.h); 0: nothing does. Throws UsageError for what is no rate, and for
// one given with --simd off.
double chosen_sleep(const RunOptions&);
std::string rate_text(double rate); // "1e-05"

// Tolerance of frozen coefficients (lib/stages/frozen.h); 0: none are kept. Without --refresh: default_refresh with the analytic solver, but in wind, whose
// changes make too many anew, none. Throws UsageError for what is no tolerance, and for one given with another solver.
double chosen_refresh(const RunOptions&, const Scene&);
double analytic_refresh(const RunOptions&); // whatever the solver and the wind

// Which part of a scene's trees a run has (scene_trees.h), and what it must know of the whole.
struct Part {
    std::int32_t part = 1, parts = 1;
    std::int64_t first_body = 0;  // in the whole scene's order
    double top = 0, reach = 0;    // Wishes
    std::vector<double> clocks{}; // likewise
    std::uint64_t whole = 0;      // of all trees and the whole scene, as fingerprint()
    bool moved =
        false; // the ground of some tree moves, of this part or another: then what a still ground allows is left out
};

// What a run of a part of it is of (rigid_parts.h).
struct Whole {
    Tree tree; // all bodies, none held
    Scene scene;
    Reduced places; // where each body is on the tree that runs, which is not in here
};

// The trees of a run joined into one, and the scene with the options applied.
struct Setting {
    Tree tree;
    std::vector<TreeRange> ranges;
    Scene scene;
    std::string source; // command lines of the inputs
    Part part = {};
    std::vector<std::string>
        changes{}; // what of the scene is in the tree by now, and no longer in the scene: a line each, for --explain
    std::uint64_t fingerprint =
        0; // fingerprint(), where a state is saved or resumed: of the tree before it is handed over
    std::shared_ptr<const Whole> whole{}; // where joints are held; tree, ranges and scene are then of what moves
};
// Reads a tree, or a scene and its trees; /wood and /load are put into the tree, rigid parts joined (rigid_parts.h). Throws UsageError,
// InputError.
Setting read_setting(const RunOptions&);

// The files that read_setting reads: INPUT, the trees of a scene, the wind's. Throws as it does where the scene cannot be read.
std::vector<std::string> files_read(const RunOptions&);

// What the options make of an empty scene, without trees. Throws UsageError, InputError.
Scene chosen_scene(const RunOptions&);

// 64 bits of all that decides how a run goes on: the joined tree's numbers and the scene's.
std::uint64_t fingerprint(const Setting&);

// make_plan with its errors as the tool's. A setting that is handed over keeps of its tree what make_plan says, and memory low.
template <class T> Plan<T> plan_run(const Setting&, const Wishes&, const RunOptions&);
template <class T> Plan<T> plan_run(Setting&&, const Wishes&, const RunOptions&);

// A run: trees, and what is free (World::on).
template <class T> struct Run {
    Plan<T> plan;
    State<T> state;
    World<T> world;
};
// At the start. Keeps a reference to the setting's tree where the scene has something free.
template <class T> Run<T> start_run(Plan<T> plan, const Setting&, const RunOptions&);

// Takes the steps of one frame. A state that became non-finite throws PromiseError with frame, stage and body.
template <class T>
void advance_frame(Run<T>&, const Tree&, std::int64_t frame, int substeps, StageClock* clock = nullptr);

// Throws that PromiseError where theta or theta_dot is non-finite.
template <class T> void require_finite(const Plan<T>&, State<T>&, const Tree&, std::int64_t frame);

// The frame's arrays, as far as `fields` asks for them. Throws PromiseError where a pose is non-finite.
template <class T>
void fill_frame(const State<T>&, std::int64_t frame, double fps, const MotionFields& fields, MotionFrame&);

std::string hash_text(std::uint64_t hash); // 16 hex digits

} // namespace bough
