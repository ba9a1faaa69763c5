// treesim: a timed simulation of a tree or a scene, frame after frame.
#include "error_line.h"
#include "file_names.h"
#include "formats/documents/motion.h"
#include "frame_queue.h"
#include "lib/base/counted.h"
#include "lib/free/shown_tree.h"
#include "lib/simulation/explanation.h"
#include "lib/simulation/fingerprint.h"
#include "notes.h"
#include "progress.h"
#include "rigid_parts.h"
#include "rustling.h"
#include "saved_run.h"
#include "saved_tree.h"
#include "shown_model.h"
#include "signals.h"
#include "sized_sink.h"
#include "watch.h"
#include <algorithm>
#include <chrono>
#include <iostream>
#include <numbers>

namespace {

using namespace bough;

DrivenOptions driven_options(const TreesimOptions& o, const Setting& setting, const std::string& source) {
    DrivenOptions options;
    options.fps = o.run.fps;
    options.key_tolerance = gltf_options(o.gltf, source).key_tolerance;
    options.source = source;
    if (!setting.scene.trees.empty()) {
        options.position = setting.scene.trees.front().position;
        options.yaw = setting.scene.trees.front().yaw * std::numbers::pi / 180;
    }
    return options;
}

// Where a scene puts its tree.
Eigen::Affine3d place_of_tree(const Setting& setting) {
    if (setting.scene.trees.empty()) return Eigen::Affine3d::Identity();
    const Placement& place = setting.scene.trees.front();
    return Eigen::Translation3d(place.position) * Eigen::AngleAxisd(place.yaw * std::numbers::pi / 180, Vec3::UnitY());
}

// shown: the tree that meshes are made of, the balls with it.
std::unique_ptr<FrameSink> open_sink(TreesimOptions& o, const Setting& setting, const Tree& shown, std::size_t bodies,
                                     const std::string& format, const MotionFields& fields, std::int64_t first,
                                     std::int64_t last, ShownModel model) {
    if (o.no_output) return nullptr;
    RustleMaker rustle = [](const Skin&, bool) { return std::unique_ptr<Rustle>(); };
    if (o.rustle) rustle = rustle_maker(setting, shown, o.run.fps);
    std::optional<OwnMesh> own;
    if (model.bound) own = bound_to(std::move(*model.bound), shown, place_of_tree(setting), o.common.notes);
    if (is_point_cache(format) || format == "obj") {
        Skin skin = own ? skin_of(*own) : build_skin(shown, {o.sides.value_or(8)});
        if (format == "obj") return obj_sink(o.common.output, shown, std::move(skin), rustle, o.common.notes);
        return cache_sink(o.common.output, format, shown, std::move(skin), rustle, o.run.fps, first, last - first + 1,
                          o.common.notes);
    }
    const std::string source = with_command_line(setting.source, o.common);
    if (model.driven)
        return driven_sink(o.common.output, std::move(*model.driven), shown, driven_options(o, setting, source),
                           o.common.notes);
    if (own) return own_sink(o.common.output, shown, std::move(*own), o.run.fps, o.gltf, source, o.common.notes);
    if (format == "glb")
        return gltf_sink(o.common.output, shown, o.sides.value_or(8), rustle, o.run.fps, o.gltf, source,
                         o.common.notes);
    MotionHeader header;
    header.fps = o.run.fps;
    header.balls = std::int64_t(setting.scene.balls.size() + setting.scene.walkers.size());
    header.bodies = std::int64_t(bodies) + header.balls;
    header.events = has_free_bodies(setting.scene);
    header.fields = fields;
    header.part = setting.part.part;
    header.parts = setting.part.parts;
    header.first_body = setting.part.first_body;
    if (setting.part.parts > 1) header.whole = hash_text(setting.part.whole);
    header.name = setting.tree.name;
    header.source = source;
    return motion_sink(o.common.output, format, header);
}

// Frames first..last into the sink; what ended the run early is thrown after the frames before it are safe.
template <class T>
std::int64_t run_frames(const TreesimOptions& o, const Setting& setting, Run<T>& run, FrameSink* sink,
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
                show_all(setting, run, frame);
                queue->push();
            }
            done = f;
            progress.at(f - first + 1);
        }
    } catch (const PromiseError&) {
        if (queue && !o.watch) queue->finish(); // who watches keeps the last that was whole
        throw;
    } catch (const Interrupted&) {
        if (queue && !o.watch) queue->finish();
        if (!o.save_state.empty() && done >= 0) save(o, setting, run, done);
        if (!o.save_tree.empty() && done >= 0) save_tree(o.save_tree, setting, run, o.common);
        throw;
    }
    if (queue) queue->finish();
    return done;
}

// The first and the last, from the start or from a saved state.
template <class T>
std::pair<std::int64_t, std::int64_t> frames_to_make(const TreesimOptions& o, const Setting& setting,
                                                     const SavedState* saved, Run<T>& run, std::int64_t frames) {
    if (!saved) return {0, frames - 1};
    restore(o, setting, *saved, run);
    const std::int64_t first = run.state.step / o.run.substeps + 1;
    // --seconds counts the start, which is not written again
    return {first, frames - 1 + first - (o.run.frames ? 0 : 1)};
}

// A mesh has to know from its first frame on which of its parts will come off: the run is made once before, without output. It is the
// same again, bit by bit.
template <class T>
std::vector<std::uint32_t> what_breaks(const TreesimOptions& o, const Setting& setting, const SavedState* saved,
                                       Run<T> run, std::int64_t frames) {
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

// A point cache is of a mesh that is written elsewhere, whole.
void refuse_broken_cache(const TreesimOptions& o, std::size_t broken) {
    if (broken == 0) return;
    throw UsageError(
        "-o is '" + o.common.output + "': " + std::to_string(broken) +
        " joints break in this run, and what breaks off is a mesh of its own, which a point cache does not "
        "hold; expected .glb or frames of .obj");
}

void note_cache(TreesimOptions& o, const Setting& setting, std::size_t balls, bool own) {
    if (balls == 0 && setting.ranges.size() == 1 && !own) return;
    if (own) {
        o.common.notes.push_back(
            "the vertices are those of the file's own mesh, material by material: the mesh that they "
            "move is the first frame of an OBJ sequence (the same run with --frames 1 -o rest_%d.obj)");
        return;
    }
    o.common.notes.push_back("the vertices are those of " + counted(setting.ranges.size(), "tree", "trees") + " and " +
                             counted(balls, "ball", "balls") +
                             ": the mesh that they move is the first frame of an OBJ sequence (the same run with "
                             "--frames 1 -o rest_%d.obj)");
}

// Returns the number of frames made.
template <class T>
std::int64_t simulate(TreesimOptions& o, Setting setting, const std::string& format, ShownModel model) {
    if (o.report_error && has_free_bodies(setting.scene))
        throw UsageError(std::string("--report-error: not with a scene's ") + (free_part(setting.scene) + 1) +
                         ", which the second run would not have");
    const MotionFields fields = chosen_fields(o);
    const bool loops = o.loop.seconds.has_value();
    const std::int64_t frames = loops ? loop_frames(o.loop, o.run) : frames_of(o.run, seconds_default);
    if (loops) make_periodic(frames, o.run.fps, setting.scene);
    if (setting.whole && o.loop.blend) throw UsageError("--loop-blend: not where joints are held (/simulate, /rigid)");
    if (setting.whole && !o.save_tree.empty())
        throw UsageError("--save-tree: not where joints are held (/simulate, /rigid)");
    const Wishes wishes{fields.velocity, fields.torque,
                        !o.no_output || o.report_error || o.report_rigid || loops || !o.save_tree.empty()};
    if (!o.save_tree.empty()) require_one_tree(setting);
    const bool mesh = is_mesh(format);
    const bool needs_tree = loops || o.report_error || !o.save_tree.empty() || mesh || has_free_bodies(setting.scene);
    if (!o.save_state.empty() || !o.resume.empty()) setting.fingerprint = fingerprint(setting.tree, setting.scene);
    Plan<T> plan_made = needs_tree ? planned<T>(setting, wishes, o.run) : planned<T>(std::move(setting), wishes, o.run);
    interrupt_at_boundary();
    std::optional<SavedState> saved; // read once: it may come from a pipe
    if (!o.resume.empty()) saved = read_state(read_input(o.resume), input_name(o.resume));
    const SavedState* const from = saved ? &*saved : nullptr;
    std::vector<std::uint32_t> broken;
    if (mesh && setting.scene.fracture)
        broken = what_breaks(o, setting, from, started(Plan<T>(plan_made), setting, o.run), frames);
    if (is_point_cache(format)) refuse_broken_cache(o, broken.size());
    Run<T> run = started(std::move(plan_made), setting, o.run);
    const Plan<T>& plan = run.plan;
    State<T>& state = run.state;
    if (o.explain) std::cerr << explanation(plan, setting.changes);
    const fast::PlannedLanes<T>* const lanes = fast::planned_lanes(plan);
    if (!o.run.sleep.empty() && o.run.sleep != "off" && !plan.stepper->sleeps())
        o.common.notes.push_back("--sleep: nothing sleeps in this run: " +
                                 (lanes ? lanes->sleep.reason : "plain path: " + plan.stepper->plainly()));
    const auto [first, last] = frames_to_make(o, setting, from, run, frames);
    const std::int64_t started = state.step;
    std::optional<ErrorEstimate<T>> estimate;
    if (o.report_error) estimate.emplace(setting.tree, plan, state);
    std::optional<RigidReport<T>> rigid;
    if (o.report_rigid) rigid.emplace(setting, o.run);
    const std::vector<Ball> balls =
        mesh ? shown_balls(setting.tree, setting.scene, run.world.walkers) : std::vector<Ball>();
    const bool changed = mesh && (!broken.empty() || !balls.empty());
    const Tree own = changed ? shown_tree(setting.tree, broken, balls) : Tree();
    const Tree& shown = changed ? own : setting.whole ? setting.whole->tree : setting.tree;
    o.gltf.loose = broken.size() + balls.size();
    const bool bound = model.bound.has_value();
    std::unique_ptr<FrameSink> sink = open_sink(o, setting, shown, setting.whole ? shown.size_bodies() : plan.bodies,
                                                format, fields, first, last, std::move(model));
    if (sink && o.common.output != "-")
        sink = sized_sink(std::move(sink), format, last - first + 1, [&o](const std::string& text) {
            if (o.common.quiet) return;
            clear_progress();
            std::cerr << treesim_info.name << ": " << text << "\n";
        });
    if (is_point_cache(format)) note_cache(o, setting, balls.size(), bound);
    LoopStart loop;
    if (loops) {
        std::optional<Run<T>> before;
        loop = close_loop(run, setting.tree, o.loop, o.run, o.common, before);
        if (sink) sink = loop_sink(std::move(sink), format == "glb", std::move(before), setting.tree, o.loop, o.run);
    }
    std::chrono::duration<double, std::milli> cost{};
    const std::int64_t done = run_frames(o, setting, run, sink.get(), estimate ? &*estimate : nullptr,
                                         rigid ? &*rigid : nullptr, fields, first, last, cost);
    if (loops) measure_seam(run, setting.tree, loop, o.loop, o.run, o.common.notes);
    if (o.report_cost) std::cerr << cost_line(plan, o.run, cost.count(), done - std::max<std::int64_t>(first, 1) + 1);
    if (o.explain) { // before the state is saved, which takes arrays of its own
        for (std::size_t k = 0; k < stage_count; ++k)
            std::cerr << "calls " << stage_name(Stage(k)) << " " << state.calls[k] << "\n";
        std::cerr << "allocated " << state.bytes() << " bytes\n";
        if (run.world.on()) std::cerr << "free bodies " << run.world.bytes() << " bytes\n";
    }
    if (!o.save_state.empty()) save(o, setting, run, done);
    if (!o.save_tree.empty()) save_tree(o.save_tree, setting, run, o.common);
    if (o.hash) std::cerr << "hash " << hash_text(state_hash(plan, state, run.world)) << "\n";
    if (rigid) std::cerr << rigid->line(cost.count(), done - std::max<std::int64_t>(first, 1) + 1) << "\n";
    if (estimate) std::cerr << error_line(estimate->result()) << "\n";
    note_flags(plan, state.flags, state.step - started, o.common.notes);
    note_world(run.world, o.common.notes);
    return done - first + 1;
}

std::int64_t make(TreesimOptions& o, const std::string& format) {
    ShownModel model = model_before_threads(o, format);
    Setting setting = read_setting(o.run);
    o.common.notes.insert(o.common.notes.end(), setting.notes.begin(), setting.notes.end());
    std::vector<NamedFile> written{{"-o", o.common.output}, {"--save-state", o.save_state}};
    // A scene's only tree may be saved in its own place, as INPUT may; one of several is not all that its file holds.
    if (setting.part.parts > 1) written.push_back({"--save-tree", o.save_tree});
    refuse_overwriting_trees(setting, written);
    if (!setting.tree_files.empty()) refuse_overwriting({{"INPUT", o.run.input}}, {{"--save-tree", o.save_tree}});
    for (const std::string& file : setting.converted) // another program's, whole
        refuse_overwriting({{"INPUT", file}}, {{"--save-tree", o.save_tree}});
    complete_model(model, o, setting, format);
    if (o.run.precision == "float") return simulate<float>(o, std::move(setting), format, std::move(model));
    return simulate<double>(o, std::move(setting), format, std::move(model));
}

// What has nothing to do with putting parts together would be ignored.
void put_together(const TreesimOptions& o) {
    const std::vector<std::string> known{"--join",      "-o",          "--format", "--hash",
                                         "--no-output", "--no-source", "-q",       "--threads"};
    if (const std::string other = o.list->given_beside(known); !other.empty())
        throw UsageError(other + ": not with --join");
    const std::string format = o.no_output ? "" : chosen_format(o.common);
    if (is_mesh(format)) throw UsageError("--join: meshes are not joined; expected .jsonl, .json, .safetensors");
    std::vector<NamedFile> parts;
    for (const std::string& part : o.join.parts) parts.push_back({"--join", part});
    refuse_overwriting(parts, {{"-o", o.common.output}});
    interrupt_at_boundary();
    JoinOptions join = o.join;
    join.hash = o.hash;
    const std::string line = join_parts(join, o.common, format, !o.no_output);
    if (!line.empty()) std::cerr << line << "\n";
}

void work(TreesimOptions& o) {
    if (!o.join.parts.empty()) return put_together(o);
    if (o.run.input.empty()) throw UsageError("INPUT: missing");
    const std::string format = o.no_output ? "" : chosen_format(o.common);
    chosen_fields(o);
    refuse_contradictions(o, format);
    if (o.watch)
        watch(o, [&o, &format] {
            TreesimOptions once = o;
            return make(once, format);
        });
    make(o, format);
}

} // namespace

int main(int argc, char** argv) {
    TreesimOptions o;
    return run_tool(
        treesim_info, argc, argv, o.common, [&o](OptionList& list) { declare(list, o); }, [&o] { work(o); });
}
