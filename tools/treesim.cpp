// treesim: a timed simulation of a tree or a scene, frame after frame.
#include "error_line.h"
#include "formats/motion.h"
#include "formats/obj.h"
#include "frame_queue.h"
#include "frame_sink.h"
#include "lib/fast/sleep.h"
#include "lib/free/shown_tree.h"
#include "lib/stages/frozen.h"
#include "rigid_parts.h"
#include "simulation.h"
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace {

using namespace bough;

constexpr double seconds_default = 10;

struct Options {
    CommonOptions common;
    RunOptions run;
    std::string fields, save_state, resume;
    GltfChoice gltf;
    std::optional<int> sides;
    bool explain = false, hash = false, report_error = false, report_cost = false, report_rigid = false,
         no_output = false;
};

const ToolInfo info = {
    "treesim",
    "Moves a tree or a scene in time and writes its frames.\n"
    "Usage: treesim TREE|SCENE [--wind NAME|FILE] [--seconds S|--frames N] [-o FILE] ...",
    "Frames go to stdout as JSON lines: a header line, then a frame a line. -o frames/oak_%04d.obj writes a mesh a\n"
    "frame and frames/oak.mtl, -o oak.glb one skinned and animated mesh. --resume goes on after the saved frame with "
    "the same tree and scene; --seconds and\n"
    "--frames then say how many frames are added.\n"
    "  treesim tree.json --wind gusty --seconds 10 > motion.jsonl\n"
    "Exit: 0 done, 1 usage, 2 bad input, 3 non-finite, 4 output not written, 130 interrupted (frames so far stay).",
    {"jsonl", "json", "safetensors", "obj", "glb"}};

constexpr double sleep_default = 1e-5; // [rad/s]

void declare(CLI::App& app, Options& o) {
    o.run.sleep_default = sleep_default;
    add_run_options(app, o.run, seconds_default);
    add_sleep_option(app, o.run);
    app.add_option("--fields", o.fields, "What a frame holds: pose, velocity, torque, angles, with commas (pose)")
        ->option_text("LIST");
    app.add_option("--sides", o.sides, "Corners of the thickest branch's rings in a mesh (8)")
        ->option_text("N")
        ->check(whole_number(3, 256));
    add_max_joints(app, o.gltf);
    add_key_tolerance(app, o.gltf);
    app.add_flag("--no-output", o.no_output, "Write no frames (for --hash, --explain, --save-state)");
    app.add_flag("--explain", o.explain, "Print each stage and array on stderr: on or left out, and why");
    app.add_flag("--hash", o.hash, "Print `hash <16 hex digits>` of the final state on stderr");
    app.add_flag("--report-error", o.report_error,
                 "Print `error ...` on stderr: what the branches' tips are off by at this step, from a second run at "
                 "twice the step beside this one (half the time more); with --solver coupled");
    app.add_flag("--report-cost", o.report_cost,
                 "Print `cost ...` on stderr: bodies, steps a frame, milliseconds a frame that the steps alone took");
    app.add_flag("--report-rigid", o.report_rigid,
                 "Print `rigid ...` on stderr: how many joints move, what the branches' tips are off by for those that "
                 "/simulate or the tree's /rigid hold, and both costs, from a run of the whole tree beside this one");
    app.add_option("--save-state", o.save_state, "Write the last frame's state, for --resume")
        ->option_text("FILE")
        ->check(file_name());
    app.add_option("--resume", o.resume, "Go on from this state")->option_text("FILE");
}

MotionFields chosen_fields(const Options& o) {
    if (o.fields.empty()) return {};
    MotionFields fields{false, false, false, false};
    for (const std::string& name : split_list(o.fields)) {
        bool* field = name == "pose"       ? &fields.pose
                      : name == "velocity" ? &fields.velocity
                      : name == "torque"   ? &fields.torque
                      : name == "angles"   ? &fields.angles
                                           : nullptr;
        if (!field) throw UsageError("--fields holds '" + name + "', expected pose, velocity, torque, angles");
        *field = true;
    }
    return fields;
}

std::string chosen_format(const CommonOptions& common) {
    if (!common.format.empty()) return common.format;
    const std::string kind = ending(common.output);
    if (kind == ".json" || kind == ".safetensors" || kind == ".obj") return kind.substr(1);
    if (kind == ".glb") {
        if (common.output.find('%') != std::string::npos)
            throw UsageError("-o is '" + common.output + "', but a .glb holds all frames, so its name takes no number");
        return "glb";
    }
    for (const char* known : {".gltf", ".fbx", ".abc", ".usd", ".usda", ".usdc", ".dae", ".ply", ".stl"})
        if (kind == known)
            throw UsageError("-o is '" + common.output + "', but " + known +
                             " is not written; there are .jsonl, .json, .safetensors, .obj, .glb");
    return "jsonl";
}

void refuse_contradictions(const Options& o, const std::string& format) {
    if (o.no_output) {
        if (o.common.output != "-") throw UsageError("--no-output: not with -o");
        if (!o.common.format.empty()) throw UsageError("--no-output: not with --format");
        if (!o.fields.empty()) throw UsageError("--no-output: not with --fields");
    }
    if (o.report_error && o.run.solver != solver_name(Solver::coupled))
        throw UsageError("--report-error: only with --solver coupled, whose error is its step's alone");
    if (o.report_rigid && !o.resume.empty())
        throw UsageError("--report-rigid: not with --resume, which says nothing of the joints that are held");
    const bool mesh = format == "obj" || format == "glb";
    if (o.sides && !mesh) throw UsageError("--sides: only with a mesh (.obj, .glb)");
    if (!o.fields.empty() && mesh) throw UsageError("--fields: not with ." + format + ", which holds a mesh");
    if (o.gltf.given() && format != "glb")
        throw UsageError(std::string(o.gltf.key_tolerance ? "--key-tolerance" : "--max-joints") + ": only with .glb");
    if (format == "obj") {
        const std::string wrong = o.common.output == "-" ? "a pattern such as frames/oak_%04d.obj is needed"
                                                         : valid_sequence(o.common.output);
        if (!wrong.empty()) throw UsageError("-o is '" + o.common.output + "': " + wrong);
    }
    if (o.save_state == "-" && !o.no_output && o.common.output == "-")
        throw UsageError("--save-state -: frames and state cannot both go to stdout");
    if (o.resume == "-" && o.run.input == "-") throw UsageError("--resume -: the input is read from stdin already");
}

template <class T>
std::string explanation(const Plan<T>& plan, const std::vector<std::string>& changes, const RunOptions& run) {
    std::ostringstream text;
    text << "plan: " << plan.bodies << " bodies, " << run.precision << ", step " << plan.dt << " s, solver "
         << solver_name(plan.solver);
    if (plan.solver == Solver::coupled) text << ", scheme " << scheme_of(plan.scheme).name;
    text << "\n";
    for (const std::string& change : changes) text << "tree changed by " << change << "\n";
    for (const PlannedStage& stage : plan.stages)
        text << "stage " << stage_name(stage.stage) << (stage.on ? " on: " : " left out: ") << stage.reason << "\n";
    std::size_t used = 0, left = 0;
    for (const PlannedArray& array : plan.arrays) {
        text << "array " << array.name << (array.on ? " on, " : " left out, ") << array.bytes
             << " bytes: " << array.reason << "\n";
        (array.on ? used : left) += array.bytes;
    }
    text << "constants of bodies in document order "
         << (plan.pose ? "on: every scene" : "left out: in lanes; no poses, velocities, torques asked for") << "\n";
    text << "state: " << used << " bytes, left out " << left << " bytes\n";
    return text.str();
}

// visit(in memory, in the document) for each array that the solver carries from step to step (State).
template <class T, class StateType, class Saved, class Visit>
void visit_carried(const Plan<T>& plan, StateType& state, Saved& saved, Visit&& visit) {
    visit(state.theta, saved.theta);
    visit(state.theta_dot, saved.theta_dot);
    if (plan.solver == Solver::coupled) {
        visit(state.theta_change, saved.theta_change);
        visit(state.theta_dot_change, saved.theta_dot_change);
    } else {
        visit(state.scaled_rate, saved.scaled_rate);
    }
}

template <class T> void restore(const Options& o, const Setting& setting, const SavedState& saved, Run<T>& run) {
    Plan<T>& plan = run.plan;
    State<T>& state = run.state;
    const auto refuse = [&](const std::string& field, const std::string& found, const std::string& expected) {
        if (found != expected)
            throw InputError(input_name(o.resume), "/" + field + ": is " + found + ", but this run has " + expected);
    };
    refuse("precision", saved.precision, o.run.precision);
    refuse("solver", saved.solver, o.run.solver);
    refuse("scheme", saved.scheme, scheme_name(o.run));
    if (saved.refresh != plan.refresh) {
        const auto text = [](double refresh) { return refresh > 0 ? rate_text(refresh) : "always"; };
        throw InputError(input_name(o.resume),
                         "/refresh: is " + text(saved.refresh) + ", but this run has " + text(plan.refresh));
    }
    refuse("substeps", std::to_string(saved.substeps), std::to_string(o.run.substeps));
    if (saved.fps != o.run.fps) throw InputError(input_name(o.resume), "/fps: differs from this run's (--fps)");
    refuse("theta", std::to_string(saved.theta.size()) + " bodies", std::to_string(plan.bodies) + " bodies");
    if (saved.fingerprint != setting.fingerprint)
        throw InputError(input_name(o.resume), "/fingerprint: is " + hash_text(saved.fingerprint) +
                                                   ", but this run's tree and scene have " +
                                                   hash_text(setting.fingerprint));
    try {
        restore_world(plan, state, run.world, saved.free_bodies);
    } catch (const std::invalid_argument& error) {
        throw InputError(input_name(o.resume), std::string("/free_bodies: ") + error.what());
    }
    present(plan, state); // its arrays
    visit_carried(plan, state, saved, [](std::vector<Vector3<T>>& to, const std::vector<Vec3>& from) {
        for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i].template cast<T>();
    });
    state.articulated_step = saved.articulated_step;
    state.step = saved.frame * o.run.substeps;
    restart(plan, state);
    try {
        if (plan.refresh > 0) restore_frozen(plan, state, saved.frozen);
    } catch (const std::invalid_argument& error) {
        throw InputError(input_name(o.resume), std::string("/frozen: ") + error.what());
    }
    try {
        if (plan.lanes.sleep.on) fast::restore_sleep(plan, state, saved.sleep); // else what slept goes on awake
    } catch (const std::invalid_argument& error) {
        throw InputError(input_name(o.resume), std::string("/sleep: ") + error.what());
    }
}

template <class T> void save(const Options& o, const Setting& setting, Run<T>& run, std::int64_t frame) {
    const Plan<T>& plan = run.plan;
    State<T>& state = run.state;
    present(plan, state);
    SavedState saved;
    saved.frame = frame;
    saved.fps = o.run.fps;
    saved.substeps = o.run.substeps;
    saved.precision = o.run.precision;
    saved.solver = o.run.solver;
    saved.scheme = scheme_name(o.run);
    saved.fingerprint = setting.fingerprint;
    saved.articulated_step = state.articulated_step;
    saved.source = with_command_line(setting.source, o.common);
    saved.sleep = fast::saved_sleep(plan, state);
    saved.refresh = plan.refresh;
    saved.free_bodies = saved_world(state, run.world);
    saved.frozen = saved_frozen(plan, state);
    visit_carried(plan, state, saved, [](const std::vector<Vector3<T>>& from, std::vector<Vec3>& to) {
        for (const Vector3<T>& v : from) to.push_back(v.template cast<double>());
    });
    Output output(o.save_state);
    write_state(output, saved, form_of_name(o.save_state));
    output.finish();
}

// shown: the tree that meshes are made of, the balls with it.
std::unique_ptr<FrameSink> open_sink(Options& o, const Setting& setting, const Tree& shown, std::size_t bodies,
                                     const std::string& format, const MotionFields& fields) {
    if (o.no_output) return nullptr;
    if (format == "obj") return obj_sink(o.common.output, shown, o.sides.value_or(8));
    const std::string source = with_command_line(setting.source, o.common);
    if (format == "glb")
        return gltf_sink(o.common.output, shown, o.sides.value_or(8), o.run.fps, o.gltf, source, o.common.notes);
    MotionHeader header;
    header.fps = o.run.fps;
    header.balls = std::int64_t(setting.scene.balls.size());
    header.bodies = std::int64_t(bodies) + header.balls;
    header.events = has_free_bodies(setting.scene);
    header.fields = fields;
    header.name = setting.tree.name;
    header.source = source;
    return motion_sink(o.common.output, format, header);
}

template <class T>
void note_flags(const Plan<T>& plan, const StepFlags& flags, std::int64_t steps, std::vector<std::string>& notes) {
    if (flags.buckling > 0)
        notes.push_back(std::to_string(flags.buckling) +
                        " times a joint was softer than gravity's pull on it (buckling)");
    if (flags.bounded_lambda > 0)
        notes.push_back(std::to_string(flags.bounded_lambda) + " times a joint's growth in a step was bounded");
    if (flags.half_turns > 0)
        notes.push_back(std::to_string(flags.half_turns) +
                        " times a joint turned past half a turn: the small angles that the method assumes are left");
    if (flags.energy_guard > 0)
        notes.push_back(std::to_string(flags.energy_guard) +
                        " times a joint was kept from gaining energy in a turn of more than 0.3 rad in a step");
    if (flags.limited > 0)
        notes.push_back(std::to_string(flags.limited) + " times a joint was stopped at its limit, as asked");
    if (flags.fast_turns > 0)
        notes.push_back(std::to_string(flags.fast_turns) + " times a body turned by more than a radian in a step");
    if (flags.refreshed > 0) {
        std::ostringstream share;
        share << std::setprecision(3) << 100 * double(flags.refreshed) / (double(steps) * double(plan.bodies));
        notes.push_back(share.str() + " % of the bodies' steps made their joints' coefficients anew (--refresh)");
    }
    if (flags.asleep > 0)
        notes.push_back(std::to_string(flags.asleep) + " of " + std::to_string(std::uint64_t(steps) * plan.bodies) +
                        " steps of a body were left out: at rest below " + rate_text(plan.lanes.sleep.rate) +
                        " rad/s (--sleep)");
    if (flags.unresolved > 0)
        notes.push_back(std::to_string(flags.unresolved) + " of " + std::to_string(flags.inner_steps) +
                        " inner steps missed the tolerance: this is no reference solution");
}

template <class T> void note_world(const World<T>& world, std::vector<std::string>& notes) {
    if (!world.on()) return;
    const WorldCounts& counts = world.counts;
    std::string broke;
    constexpr std::array<const char*, 4> kinds{"branches", "leaves", "fruit", "petals"};
    static_assert(std::size_t(Kind::branch) == 0 && std::size_t(Kind::leaf) == 1 && std::size_t(Kind::fruit) == 2 &&
                  std::size_t(Kind::petal) == 3);
    std::uint64_t all = 0;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        all += counts.broke[k];
        if (counts.broke[k] > 0)
            broke += (broke.empty() ? "" : ", ") + std::to_string(counts.broke[k]) + " " + kinds[k];
    }
    std::ostringstream text;
    text.precision(3);
    if (!world.tree) return;
    text << all << " joints broke" << (broke.empty() ? "" : " (" + broke + ")") << ", " << counts.landed
         << " leaves and petals landed, " << counts.hits << " hits";
    notes.push_back(text.str());
    if (world.contact.model != ContactModel::penalty) return;
    text.str("");
    text << "the paper's pair of penalty and impulse left " << counts.imbalance
         << " N s of momentum out of balance (/contact/model)";
    notes.push_back(text.str());
}

// Frames first..last into the sink; what ended the run early is thrown after the frames before it are safe.
template <class T>
std::int64_t run_frames(const Options& o, const Setting& setting, Run<T>& run, FrameSink* sink,
                        ErrorEstimate<T>* estimate, RigidReport<T>* rigid, const MotionFields& fields,
                        std::int64_t first, std::int64_t last, std::chrono::duration<double, std::milli>& cost) {
    const Plan<T>& plan = run.plan;
    State<T>& state = run.state;
    std::optional<FrameQueue> queue;
    if (sink) queue.emplace(*sink, o.common.threads > 1 ? 2 : 1);
    Progress progress(o.common, "frame", last - first + 1);
    std::int64_t done = first - 1;
    try {
        for (std::int64_t f = first; f <= last; ++f) {
            if (interrupted()) throw Interrupted("interrupted after frame " + std::to_string(done));
            run.world.events = {};
            const auto start = std::chrono::steady_clock::now();
            if (f > 0) advance_frame(run, setting.tree, f, o.run.substeps);
            cost += std::chrono::steady_clock::now() - start;
            if (f > 0 && estimate) {
                present(plan, state);
                estimate->follow(state);
            }
            if (f > 0 && rigid) {
                present(plan, state);
                rigid->follow(plan, state, f);
            }
            if (queue) {
                present(plan, state);
                MotionFrame& frame = queue->next();
                fill_frame(state, f, o.run.fps, fields, frame);
                show_whole(setting, plan, state, frame);
                place_free_bodies(run.world, frame);
                queue->push();
            }
            done = f;
            progress.at(f - first + 1);
        }
    } catch (const PromiseError&) {
        if (queue) queue->finish();
        throw;
    } catch (const Interrupted&) {
        if (queue) queue->finish();
        if (!o.save_state.empty() && done >= 0) save(o, setting, run, done);
        throw;
    }
    if (queue) queue->finish();
    return done;
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

// The first and the last, from the start or from a saved state.
template <class T>
std::pair<std::int64_t, std::int64_t> frames_to_make(const Options& o, const Setting& setting, const SavedState* saved,
                                                     Run<T>& run, std::int64_t frames) {
    if (!saved) return {0, frames - 1};
    restore(o, setting, *saved, run);
    const std::int64_t first = run.state.step / o.run.substeps + 1;
    // --seconds counts the start, which is not written again
    return {first, frames - 1 + first - (o.run.frames ? 0 : 1)};
}

// A mesh has to know from its first frame on which of its parts will come off: the run is made once before, without output. It is the
// same again, bit by bit.
template <class T>
std::vector<std::uint32_t> what_breaks(const Options& o, const Setting& setting, const SavedState* saved, Run<T> run,
                                       std::int64_t frames) {
    const auto [first, last] = frames_to_make(o, setting, saved, run, frames);
    Progress progress(o.common, "frame (what breaks)", last - first + 1);
    for (std::int64_t f = std::max<std::int64_t>(first, 1); f <= last; ++f) {
        if (interrupted()) throw Interrupted("interrupted before the first frame, while finding out what breaks");
        run.world.events = {};
        advance_frame(run, setting.tree, f, o.run.substeps);
        progress.at(f - first + 1);
    }
    std::vector<std::uint32_t> broken = run.world.broken;
    std::sort(broken.begin(), broken.end());
    return broken;
}

template <class T> void simulate(Options& o, Setting setting, const std::string& format) {
    if (o.report_error && has_free_bodies(setting.scene))
        throw UsageError(std::string("--report-error: not with a scene's ") +
                         (setting.scene.fracture ? "fracture" : "balls") + ", which the second run would not have");
    const MotionFields fields = chosen_fields(o);
    const Wishes wishes{fields.velocity, fields.torque, !o.no_output || o.report_error || o.report_rigid};
    const bool needs_tree = o.report_error || format == "obj" || format == "glb" || has_free_bodies(setting.scene);
    if (!o.save_state.empty() || !o.resume.empty()) setting.fingerprint = fingerprint(setting);
    Plan<T> planned = needs_tree ? plan_run<T>(setting, wishes, o.run) : plan_run<T>(std::move(setting), wishes, o.run);
    const std::int64_t frames = frames_of(o.run, seconds_default);
    interrupt_at_boundary();
    std::optional<SavedState> saved; // read once: it may come from a pipe
    if (!o.resume.empty()) saved = read_state(read_input(o.resume), input_name(o.resume));
    const SavedState* const from = saved ? &*saved : nullptr;
    const bool mesh = format == "obj" || format == "glb";
    std::vector<std::uint32_t> broken;
    if (mesh && setting.scene.fracture)
        broken = what_breaks(o, setting, from, start_run(Plan<T>(planned), setting, o.run), frames);
    Run<T> run = start_run(std::move(planned), setting, o.run);
    const Plan<T>& plan = run.plan;
    State<T>& state = run.state;
    if (o.explain) std::cerr << explanation(plan, setting.changes, o.run);
    if (!o.run.sleep.empty() && o.run.sleep != "off" && !plan.lanes.sleep.on)
        o.common.notes.push_back("--sleep: nothing sleeps in this run: " +
                                 (plan.lanes.on ? plan.lanes.sleep.reason : "plain path: " + plan.lanes.reason));
    if (!o.run.refresh.empty() && o.run.refresh != "always" && plan.refresh == 0)
        o.common.notes.push_back("--refresh: nothing is kept in this run: " + plan.refresh_reason);
    const auto [first, last] = frames_to_make(o, setting, from, run, frames);
    const std::int64_t started = state.step;
    std::optional<ErrorEstimate<T>> estimate;
    if (o.report_error) estimate.emplace(setting.tree, plan, state);
    std::optional<RigidReport<T>> rigid;
    if (o.report_rigid) rigid.emplace(setting, o.run);
    const bool changed = mesh && (!broken.empty() || !setting.scene.balls.empty());
    const Tree own = changed ? shown_tree(setting.tree, broken, setting.scene.balls) : Tree();
    const Tree& shown = changed ? own : setting.whole ? setting.whole->tree : setting.tree;
    o.gltf.loose = broken.size() + setting.scene.balls.size();
    const std::unique_ptr<FrameSink> sink =
        open_sink(o, setting, shown, setting.whole ? shown.size_bodies() : plan.bodies, format, fields);
    std::chrono::duration<double, std::milli> cost{};
    const std::int64_t done = run_frames(o, setting, run, sink.get(), estimate ? &*estimate : nullptr,
                                         rigid ? &*rigid : nullptr, fields, first, last, cost);
    if (o.report_cost) std::cerr << cost_line(plan, o.run, cost.count(), done - std::max<std::int64_t>(first, 1) + 1);
    if (o.explain) { // before the state is saved, which takes arrays of its own
        for (std::size_t k = 0; k < stage_count; ++k)
            std::cerr << "calls " << stage_name(Stage(k)) << " " << state.calls[k] << "\n";
        std::cerr << "allocated " << state.bytes() << " bytes\n";
        if (run.world.on()) std::cerr << "free bodies " << run.world.bytes() << " bytes\n";
    }
    if (!o.save_state.empty()) save(o, setting, run, done);
    if (o.hash) std::cerr << "hash " << hash_text(state_hash(plan, state, run.world)) << "\n";
    if (rigid) std::cerr << rigid->line(cost.count(), done - std::max<std::int64_t>(first, 1) + 1) << "\n";
    if (estimate) std::cerr << error_line(estimate->result(), o.run.precision == "float") << "\n";
    note_flags(plan, state.flags, state.step - started, o.common.notes);
    note_world(run.world, o.common.notes);
}

void work(Options& o) {
    if (o.run.input.empty()) throw UsageError("INPUT: missing");
    const std::string format = o.no_output ? "" : chosen_format(o.common);
    chosen_fields(o);
    refuse_contradictions(o, format);
    Setting setting = read_setting(o.run);
    if (o.run.precision == "float")
        simulate<float>(o, std::move(setting), format);
    else
        simulate<double>(o, std::move(setting), format);
}

} // namespace

int main(int argc, char** argv) {
    Options o;
    return run_tool(
        info, argc, argv, o.common, [&o](CLI::App& app) { declare(app, o); }, [&o] { work(o); });
}
