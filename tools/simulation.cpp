#include "simulation.h"
#include "formats/scene.h"
#include "formats/tree.h"
#include "lib/model/static_load.h"
#include "lib/model/wood_overrides.h"
#include "lib/stages/frozen_rule.h"
#include "lib/stages/state_arrays.h"
#include "scene_trees.h"
#include "set_option.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace bough {
namespace {

std::optional<Wind> chosen_wind(const std::string& wind) {
    if (wind.empty()) return std::nullopt;
    if (const std::optional<Wind> preset = wind_preset(wind)) return preset;
    std::error_code none;
    if (wind.find_first_of("./") == std::string::npos && !std::filesystem::exists(wind, none))
        throw UsageError("--wind is '" + wind + "', neither calm, breeze, gusty, storm nor a file");
    return read_wind(read_input(wind), input_name(wind));
}

void apply(const RunOptions& o, const std::optional<Wind>& wind, Scene& scene) {
    if (wind) scene.wind = wind;
    if (o.seed) {
        if (!scene.wind) throw UsageError("--seed: only with a wind, whose turbulence is what it seeds");
        scene.wind->seed = *o.seed;
    }
    if (!o.gravity.empty()) {
        const std::vector<double> g = number_list("--gravity", o.gravity, 3);
        scene.gravity = Vec3(g[0], g[1], g[2]);
    }
    if (!o.pose.empty())
        scene.pose = o.pose == "drawn" ? Pose::drawn : o.pose == "settled" ? Pose::settled : Pose::rest;
    if (!o.joint_inertia.empty())
        scene.joint_inertia = o.joint_inertia == "paper" ? JointInertia::paper : JointInertia::branch;
    if (o.stiffness_scale) scene.stiffness_scale = *o.stiffness_scale;
    if (o.damping_scale) scene.damping_scale = *o.damping_scale;
    if (o.joint_limit) {
        if (*o.joint_limit > 180) throw UsageError("--joint-limit is above 180 degrees, which is no limit");
        const Vec3 all = Vec3::Constant(*o.joint_limit);
        scene.joint_limit = JointLimit{all, all, all};
    }
}

constexpr const char* empty_scene = R"({"format": "bough-scene", "version": 1})";

// The document with the options applied, and what --set asks for last of all: once in the document itself, which may wait for it to be
// complete, and of fields that other options set too, once more behind these.
SceneDocument chosen_document(const RunOptions& o, std::string_view content, const std::string& name) {
    const std::optional<Wind> wind = chosen_wind(o.wind);
    std::vector<SceneOverride> first = overrides_of(o.set), last;
    for (const SceneOverride& change : first)
        for (const char* field :
             {"wind", "gravity", "pose", "joint_inertia", "stiffness_scale", "damping_scale", "joint_limit"})
            if (change.path.front() == field) last.push_back(change);
    if (wind && !first.empty()) first.insert(first.begin(), {"--wind " + o.wind, {"wind"}, wind_text(*wind)});
    SceneDocument document = read_scene_document(content, name, first);
    apply(o, wind, document.scene);
    return last.empty() ? document : changed(document, last);
}

// What a scene makes of its trees themselves: into the tree, before anything is planned or weighed.
void change_trees(Setting& setting, const std::string& scene_file) {
    const auto count = [](std::size_t n, const char* what) { return std::to_string(n) + what; };
    if (setting.scene.wood) {
        WoodChanges changes;
        try {
            changes = override_wood(setting.tree, setting.ranges, *setting.scene.wood);
        } catch (const std::out_of_range& error) {
            throw InputError(input_name(scene_file), std::string("/") + error.what());
        }
        std::string line = "/wood: stiffness of " + count(changes.stiffness, " joints, damping of ") +
                           count(changes.damping, ", mass of ") + count(changes.mass, " bodies");
        if (setting.scene.wood->fork)
            line += "; " + count(changes.near_forks, " joints near ") + count(changes.forks, " forks");
        setting.changes.push_back(line);
        setting.scene.wood.reset();
    }
    if (setting.scene.load) {
        const LoadLaid laid = lay_load(setting.tree, *setting.scene.load);
        std::ostringstream kilograms;
        kilograms << laid.mass;
        setting.changes.push_back("/load: " + kilograms.str() + " kg on " + count(laid.bodies, " bodies"));
        setting.scene.load.reset();
    }
}

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

Solver chosen_solver(const RunOptions& o) {
    for (const Solver solver : all_solvers)
        if (o.solver == solver_name(solver)) return solver;
    throw UsageError("--solver is '" + o.solver + "', which is unknown");
}

template <class T> bool finite(const T& value) {
    if constexpr (std::is_floating_point_v<T>)
        return std::isfinite(value);
    else if constexpr (requires { value.allFinite(); })
        return value.allFinite();
    else
        return true; // a step's own scratch
}

std::string body_text(const Tree& tree, std::size_t i) {
    return "body " + std::to_string(i) + " (branch " + std::to_string(tree.branch[i]) + ")";
}

template <class T> std::string free_text(const World<T>& world, std::size_t k) {
    if (k < world.balls) return "ball " + std::to_string(k);
    return "what fell with " + body_text(*world.tree, std::size_t(world.free[k].parts.front().body));
}

// The stage before the spring that writes an array (state.h); visit_arrays names them in the order of the stages.
const char* early_stage(const std::string& array) {
    if (array.rfind("c_", 0) == 0) return stage_name(Stage::composite);
    if (array == "f_w" || array == "tau_w" || array.rfind("drag_", 0) == 0) return stage_name(Stage::external_forces);
    return nullptr;
}

template <class T>
[[noreturn]] void name_non_finite(const Plan<T>& plan, const State<T>& state, const Tree& tree, std::int64_t frame) {
    std::string place;
    visit_arrays(Plan<T>(), state, [&](const std::string& name, const auto& array, bool, const std::string&) {
        const char* stage = place.empty() ? early_stage(name) : nullptr;
        for (std::size_t i = 0; stage && place.empty() && i < array.size(); ++i)
            if (!finite(array[i])) place = std::string(stage) + " (" + name + "), " + body_text(tree, i);
    });
    const Stage last = is_articulated(plan.solver)      ? Stage::articulated
                       : plan.solver == Solver::coupled ? Stage::resolvent
                                                        : Stage::spring;
    if (place.empty()) place = std::string(stage_name(last)) + " (theta), " + body_text(tree, *first_non_finite(state));
    if (plan.solver == Solver::articulated_explicit)
        place += "; explicit Euler needs far smaller steps (--substeps), or take --solver articulated-implicit";
    throw PromiseError("the simulation became non-finite in frame " + std::to_string(frame) + ": stage " + place);
}

} // namespace

std::string rate_text(double rate) {
    std::ostringstream text;
    text << rate;
    return text.str();
}

void add_simd_option(CLI::App& app, RunOptions& o) {
    app.add_option("--simd", o.simd,
                   "Which SIMD code coupled and analytic step with: auto (default): the widest of avx512, avx2 and "
                   "baseline that "
                   "this machine has; off: the plain step, body by body")
        ->option_text("NAME")
        ->check(CLI::IsMember({"auto", "off", "baseline", "avx2", "avx512"}));
}

void add_refresh_option(CLI::App& app, RunOptions& o) {
    app.add_option("--refresh", o.refresh,
                   "With --solver analytic: when a joint's modes are worked out anew: once its composite has turned or "
                   "changed by about TOL radians since, or always (" +
                       rate_text(default_refresh) + "; in wind always)")
        ->option_text("TOL|always");
}

void add_sleep_option(CLI::App& app, RunOptions& o) {
    app.add_option("--sleep", o.sleep,
                   "Leave out subtrees at rest: whose bodies, and what carries them, have turned by less than RATE "
                   "[rad/s] for a second, until they are moved again; or off (" +
                       (o.sleep_default > 0 ? rate_text(o.sleep_default) : "off") + ")")
        ->option_text("RATE|off");
}

void add_run_options(CLI::App& app, RunOptions& o, double seconds_default) {
    const std::string seconds_text = std::to_string(int(seconds_default));
    app.add_option("INPUT", o.input, "A tree or a scene; - for stdin");
    CLI::Option* seconds = app.add_option("--seconds", o.seconds, "Length of the run [s] (" + seconds_text + ")")
                               ->option_text("S")
                               ->check(not_negative_number());
    app.add_option("--frames", o.frames, "Length of the run in frames, the start included")
        ->option_text("N")
        ->check(whole_number(1))
        ->excludes(seconds);
    app.add_option("--fps", o.fps, "Frames a second (30)")->option_text("F")->check(positive_number());
    app.add_option("--substeps", o.substeps, "Steps a frame (1)")->option_text("N")->check(whole_number(1, 1000000));
    app.add_option("--wind", o.wind, "Wind: calm, breeze, gusty, storm, or a bough-wind file")
        ->option_text("NAME|FILE");
    app.add_option("--seed", o.seed, "Seed of the wind's turbulence")->option_text("N")->check(whole_number(0));
    app.add_option("--gravity", o.gravity, "Gravity [m/s2] (0,-9.81,0)")->option_text("X,Y,Z");
    add_set_option(app, o.set);
    std::vector<std::string> solvers;
    for (const Solver solver : all_solvers) solvers.push_back(solver_name(solver));
    app.add_option("--solver", o.solver, solver_help())->option_text("NAME")->check(CLI::IsMember(solvers));
    std::vector<std::string> schemes;
    for (const Scheme scheme : all_schemes) schemes.push_back(scheme_of(scheme).name);
    app.add_option("--scheme", o.scheme,
                   "Which rational function coupled steps with: " + std::string(scheme_of(Scheme()).name) +
                       " (default): robust; P.25, P.5: damp less, stiff joints lag more; P34: true to higher "
                       "frequencies, two solves a step; LIE, midpoint, for comparison: first order; no damping at all")
        ->option_text("NAME")
        ->transform(CLI::IsMember(schemes, CLI::ignore_case)); // to the table's spelling
    add_simd_option(app, o);
    add_refresh_option(app, o);
    app.add_option("--tolerance", o.tolerance, "Error allowed in a step of articulated-reference [rad] (1e-8)")
        ->option_text("RAD")
        ->check(positive_number());
    app.add_option("--precision", o.precision, "float or double (double)")
        ->option_text("NAME")
        ->check(CLI::IsMember({"float", "double"}));
    app.add_option(
           "--pose", o.pose,
           "What the drawn tree is: drawn (in equilibrium under gravity), settled (unloaded; starts at its sag), "
           "rest (unloaded; starts from it)")
        ->option_text("NAME")
        ->check(CLI::IsMember({"drawn", "settled", "rest"}));
    app.add_option("--joint-inertia", o.joint_inertia,
                   "branch (a branch keeps its frequency under any segmentation) or paper")
        ->option_text("NAME")
        ->check(CLI::IsMember({"branch", "paper"}));
    app.add_option("--stiffness-scale", o.stiffness_scale, "Multiplies every joint's stiffness (1)")
        ->option_text("X")
        ->check(not_negative_number());
    app.add_option("--damping-scale", o.damping_scale, "Multiplies every joint's damping (1)")
        ->option_text("X")
        ->check(not_negative_number());
    app.add_option("--joint-limit", o.joint_limit,
                   "Largest angle of every joint about each of its axes, from its spring's rest [deg] (none)")
        ->option_text("DEG")
        ->check(positive_number());
}

std::int64_t frames_of(const RunOptions& o, double seconds_default) {
    if (o.frames) return *o.frames;
    const double frames = std::round(o.seconds.value_or(seconds_default) * o.fps) + 1;
    if (!(frames < 9e15)) throw UsageError("--seconds: more frames than can be counted");
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
        throw UsageError("--simd " + o.simd + ": this machine or build does not have it; the best here is " +
                         fast::target_name(fast::best_target()));
    return target;
}

double analytic_refresh(const RunOptions& o) {
    if (o.refresh.empty()) return default_refresh;
    if (o.refresh == "always") return 0;
    const std::optional<double> tolerance = parse_number(o.refresh);
    if (!tolerance || !(*tolerance > 0 && *tolerance <= 3))
        throw UsageError("--refresh is '" + o.refresh + "', expected a tolerance above 0, at most 3, or always");
    return *tolerance;
}

double chosen_refresh(const RunOptions& o, const Scene& scene) {
    const double tolerance = analytic_refresh(o);
    if (chosen_solver(o) == Solver::analytic) return o.refresh.empty() && scene.wind ? 0 : tolerance;
    if (tolerance > 0 && !o.refresh.empty())
        throw UsageError("--refresh " + o.refresh +
                         ": only with --solver analytic; all others work everything out anew");
    return 0;
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

Setting read_setting(const RunOptions& o) {
    if (o.input.empty()) throw UsageError("INPUT: missing");
    const Solver solver = chosen_solver(o);
    if (is_articulated(solver) && o.precision == "float")
        throw UsageError("--precision float: not with --solver " + o.solver + ", which runs in double");
    if (solver != Solver::analytic && !o.joint_inertia.empty())
        throw UsageError("--joint-inertia: only with --solver analytic");
    if (is_articulated(solver) && o.joint_limit)
        throw UsageError("--joint-limit: only with --solver coupled or analytic, which keep limits");
    if (solver != Solver::coupled && !o.scheme.empty()) throw UsageError("--scheme: only with --solver coupled");
    if (o.tolerance && solver != Solver::articulated_reference)
        throw UsageError("--tolerance: only with --solver articulated-reference");
    Setting setting;
    const Input input(o.input);
    const bool scene = is_scene(input.content());
    SceneDocument document =
        scene ? chosen_document(o, input.all(), input.name()) : chosen_document(o, empty_scene, "the scene");
    setting.scene = std::move(document.scene);
    if (scene) {
        stand_trees(setting, o.input, o.shard, document.material);
    } else {
        if (!o.shard.empty()) throw UsageError("--shard: only with a scene, whose trees it parts");
        if (!setting.scene.trees.empty())
            throw UsageError("--set trees: INPUT is a tree, which stands where it was drawn; a scene places trees");
        stand(setting, with_material(read_tree(input), document.material, o.input), Placement());
    }
    if (const std::optional<Defect> defect = check(setting.scene))
        throw UsageError("the scene's " + defect->field + " " + defect->message);
    change_trees(setting, o.input);
    return setting;
}

std::vector<std::string> files_read(const RunOptions& o) {
    std::vector<std::string> files{o.input};
    if (!o.wind.empty() && !wind_preset(o.wind)) files.push_back(o.wind);
    const Input input(o.input);
    if (is_scene(input.content()))
        for (const Placement& place : chosen_document(o, input.all(), input.name()).scene.trees)
            files.push_back(tree_file(o.input, place));
    return files;
}

Scene chosen_scene(const RunOptions& o) {
    Scene scene = chosen_document(o, empty_scene, "the scene").scene;
    if (const std::optional<Defect> defect = check(scene))
        throw UsageError("the scene's " + defect->field + " " + defect->message);
    return scene;
}

namespace {

// tree: const Tree& or Tree&&, as make_plan takes it.
template <class T, class TreeType>
Plan<T> plan_of(TreeType&& tree, const Setting& setting, Wishes wishes, const RunOptions& o) {
    wishes.top = setting.part.top;
    wishes.reach = setting.part.reach;
    wishes.clocks = setting.part.clocks;
    try {
        const Solver solver = chosen_solver(o);
        std::optional<fast::Target> simd = chosen_simd(o);
        double sleep = chosen_sleep(o), refresh = chosen_refresh(o, setting.scene);
        if (setting.part.parts > 1) sleep = 0; // trees sleep by blocks, which those of a whole scene share
        if (setting.part.moved) {              // as make_plan decides for the whole
            sleep = refresh = 0;
            if (solver == Solver::analytic) simd.reset();
        }
        Plan<T> plan = make_plan<T>(std::forward<TreeType>(tree), setting.ranges, setting.scene, wishes,
                                    1 / (o.fps * o.substeps), solver, chosen_scheme(o), simd, sleep, refresh);
        if (o.tolerance) plan.tolerance = *o.tolerance;
        return plan;
    } catch (const std::out_of_range& error) {
        throw InputError(input_name(o.input), error.what());
    } catch (const std::domain_error& error) {
        throw InputError(input_name(o.input), error.what());
    }
}

} // namespace

template <class T> Plan<T> plan_run(const Setting& setting, const Wishes& wishes, const RunOptions& o) {
    return plan_of<T>(setting.tree, setting, wishes, o);
}

template <class T> Plan<T> plan_run(Setting&& setting, const Wishes& wishes, const RunOptions& o) {
    return plan_of<T>(std::move(setting.tree), setting, wishes, o);
}

template <class T> Run<T> start_run(Plan<T> plan, const Setting& setting, const RunOptions& o) {
    Run<T> run{std::move(plan), {}, {}};
    run.state = make_state(run.plan);
    try {
        run.world = make_world(run.plan, setting.tree, setting.ranges);
    } catch (const std::out_of_range& error) {
        throw InputError(input_name(o.input), error.what());
    } catch (const std::domain_error& error) {
        throw InputError(input_name(o.input), error.what());
    }
    return run;
}

template <class T>
void advance_frame(Run<T>& run, const Tree& tree, std::int64_t frame, int substeps, StageClock* clock) {
    for (int k = 0; k < substeps; ++k) {
        advance(run.plan, run.state, run.world, clock);
        require_finite(run.plan, run.state, tree, frame);
        if (const std::optional<std::size_t> free = first_non_finite(run.world))
            throw PromiseError("the simulation became non-finite in frame " + std::to_string(frame) +
                               ": stage contacts, " + free_text(run.world, *free));
    }
}

template <class T> void require_finite(const Plan<T>& plan, State<T>& state, const Tree& tree, std::int64_t frame) {
    if (plan.lanes.on && state.lanes.finite) return; // seen by the step itself
    present(plan, state);
    if (first_non_finite(state)) name_non_finite(plan, state, tree, frame);
}

template <class T>
void fill_frame(const State<T>& state, std::int64_t frame, double fps, const MotionFields& fields, MotionFrame& out) {
    const auto copy = [&](bool wanted, const std::vector<Vector3<T>>& from, std::vector<Vec3>& to) {
        if (!wanted) return;
        to.resize(from.size());
        for (std::size_t i = 0; i < from.size(); ++i) {
            to[i] = from[i].template cast<double>();
            if (!to[i].allFinite())
                throw PromiseError("the simulation became non-finite in frame " + std::to_string(frame) +
                                   ": stage state_update, body " + std::to_string(i));
        }
    };
    out.frame = frame;
    out.time = double(frame) / fps;
    copy(fields.pose, state.x_w, out.position);
    copy(fields.velocity, state.v_w, out.velocity);
    copy(fields.velocity, state.omega_w, out.angular_velocity);
    copy(fields.torque, state.torque_j, out.torque);
    copy(fields.angles, state.theta, out.theta);
    copy(fields.angles, state.theta_dot, out.theta_dot);
    if (!fields.pose) return;
    out.rotation.resize(state.R_wb.size());
    for (std::size_t i = 0; i < state.R_wb.size(); ++i) {
        out.rotation[i] = Quat(Mat3(state.R_wb[i].template cast<double>())).normalized();
        if (out.rotation[i].w() < 0) out.rotation[i].coeffs() *= -1;
    }
}

std::string hash_text(std::uint64_t hash) {
    std::string text(16, '0');
    for (std::size_t k = 16; k-- > 0; hash >>= 4) text[k] = "0123456789abcdef"[hash & 15];
    return text;
}

template Plan<float> plan_run(const Setting&, const Wishes&, const RunOptions&);
template Plan<double> plan_run(const Setting&, const Wishes&, const RunOptions&);
template Plan<float> plan_run(Setting&&, const Wishes&, const RunOptions&);
template Plan<double> plan_run(Setting&&, const Wishes&, const RunOptions&);
template Run<float> start_run(Plan<float>, const Setting&, const RunOptions&);
template Run<double> start_run(Plan<double>, const Setting&, const RunOptions&);
template void advance_frame(Run<float>&, const Tree&, std::int64_t, int, StageClock*);
template void advance_frame(Run<double>&, const Tree&, std::int64_t, int, StageClock*);
template void require_finite(const Plan<float>&, State<float>&, const Tree&, std::int64_t);
template void require_finite(const Plan<double>&, State<double>&, const Tree&, std::int64_t);
template void fill_frame(const State<float>&, std::int64_t, double, const MotionFields&, MotionFrame&);
template void fill_frame(const State<double>&, std::int64_t, double, const MotionFields&, MotionFrame&);

} // namespace bough
