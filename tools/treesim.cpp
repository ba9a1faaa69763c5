// treesim: a timed simulation of a tree or a scene, frame after frame.
#include "error_line.h"
#include "file_names.h"
#include "formats/documents/motion.h"
#include "frame_queue.h"
#include "lib/base/hash_text.h"
#include "notes.h"
#include "progress.h"
#include "rigid_parts.h"
#include "saved_run.h"
#include "settle.h"
#include "shown_frames.h"
#include "signals.h"
#include "watch.h"
#include <algorithm>
#include <chrono>
#include <iostream>

namespace {

using namespace bough;

// What runs beside the run, and tells of it.
struct Companions {
    std::optional<RunError> error;
    std::optional<RigidReport> rigid;
};

// Which frames are made, and what that took.
struct FrameRange {
    std::int64_t first = 0, last = 0, done = -1;
    std::chrono::duration<double, std::milli> cost{};
    std::int64_t steps() const { return done - std::max<std::int64_t>(first, 1) + 1; } // [frames] the start takes none
};

// Frames into the sink; what ended the run early is thrown after the frames before it are safe.
void run_frames(const TreesimOptions& o, Simulation& run, FrameSink* sink, Companions& beside, FrameRange& range) {
    const MotionFields fields = chosen_fields(o);
    std::optional<FrameQueue> queue;
    if (sink) queue.emplace(*sink, o.common.threads > 1 ? 2 : 1);
    Progress progress(o.common, "frame", range.last - range.first + 1);
    range.done = range.first - 1;
    const auto any = [&] { return range.done >= range.first; };
    try {
        for (std::int64_t f = range.first; f <= range.last; ++f) {
            if (interrupted())
                throw Interrupted(any() ? "interrupted after frame " + std::to_string(range.done)
                                        : "interrupted before the first frame: nothing is written");
            const auto start = std::chrono::steady_clock::now();
            if (f > 0) advance_frame(run, f, o.run.substeps);
            range.cost += std::chrono::steady_clock::now() - start;
            if (f > 0 && beside.error) beside.error->follow();
            if (f > 0 && beside.rigid) beside.rigid->follow(run, f);
            if (queue) {
                fill_frame(run, f, o.run.fps, fields, queue->next());
                queue->push();
            }
            range.done = f;
            progress.at(f - range.first + 1, queue ? queue->bytes() : 0);
        }
    } catch (const PromiseError&) {
        if (queue && any() && !o.watch) queue->finish(); // who watches keeps the last that was whole
        throw;
    } catch (const Interrupted&) {
        if (queue && any() && !o.watch) queue->finish();
        if (any()) save(o, run, range.done);
        throw;
    }
    if (queue) queue->finish();
}

// The first and the last, from the start or from a saved state.
FrameRange frames_to_make(const TreesimOptions& o, Simulation& run, std::int64_t frames) {
    FrameRange range;
    range.last = frames - 1;
    if (o.resume.empty()) return range;
    restore(o, read_state(read_input(o.resume), input_name(o.resume)), run);
    range.first = run.steps() / o.run.substeps + 1;
    // --seconds counts the start, which is not written again
    range.last += range.first - (o.run.frames ? 0 : 1);
    return range;
}

// A mesh has to know from its first frame on which of its parts will come off: the run is made once before, without output. It is the
// same again, bit by bit.
std::vector<std::uint32_t> what_breaks(const TreesimOptions& o, Simulation ahead, const FrameRange& range) {
    Progress progress(o.common, "frame (what breaks)", range.last - range.first + 1);
    for (std::int64_t f = std::max<std::int64_t>(range.first, 1); f <= range.last; ++f) {
        if (interrupted()) throw Interrupted("interrupted before the first frame, while finding out what breaks");
        advance_frame(ahead, f, o.run.substeps);
        progress.at(f - range.first + 1);
    }
    std::vector<std::uint32_t> broken(ahead.broken().begin(), ahead.broken().end());
    std::sort(broken.begin(), broken.end());
    return broken;
}

void refuse_contradictions(const TreesimOptions& o, const Setting& setting) {
    if (o.report.error && has_free_bodies(setting.scene))
        throw UsageError(std::string("--report error: not with a scene's ") + (free_part(setting.scene) + 1) +
                         ", which the second run would not have");
    if (setting.whole && o.loop.blend) throw UsageError("--loop-blend: not where joints are held (/simulate, /rigid)");
    if (!o.save_tree.empty()) require_one_tree(setting);
}

RunWishes wishes_of(const TreesimOptions& o, const std::string& format) {
    RunWishes wishes;
    wishes.fields = chosen_fields(o);
    wishes.trees = o.loop.seconds || o.report.error || !o.save_tree.empty() || is_mesh(format);
    wishes.poses = wishes.trees || !o.no_output || o.report.rigid;
    wishes.state = !o.save_state.empty() || !o.resume.empty();
    return wishes;
}

// What a run that has ended took.
void report(const TreesimOptions& o, const Simulation& run, const FrameRange& range) {
    const RunAccount account = run.account();
    if (o.report.cost) std::cerr << cost_line(account, o.run, range.cost.count(), range.steps());
    if (!o.report.plan) return;
    for (const StageCalls& of : account.stages) std::cerr << "calls " << of.stage << " " << of.calls << "\n";
    std::cerr << "allocated " << account.state_bytes << " bytes\n";
    if (run.has_events()) std::cerr << "free bodies " << account.free_bytes << " bytes\n";
}

// Returns the number of frames made.
std::int64_t simulate(TreesimOptions& o, const std::shared_ptr<Setting>& setting, const std::string& format,
                      ShownModel model) {
    const bool loops = o.loop.seconds.has_value();
    const std::int64_t frames = loops ? loop_frames(o.loop, o.run) : frames_of(o.run, seconds_default);
    refuse_contradictions(o, *setting);
    if (loops) make_periodic(o.loop, setting->scene);
    const std::int64_t before = frames_before(o, *setting); // while the tree is all there
    Simulation run = started(setting, o.run, o.common.threads, wishes_of(o, format));
    interrupt_at_boundary();
    if (o.report.plan) std::cerr << run.explain();
    if (const std::string awake = run.account().awake; o.run.asks_for_sleep() && !awake.empty())
        o.common.notes.push_back("--sleep: nothing sleeps in this run: " + awake);
    if (frames > 1 && o.resume.empty() && stands_still(setting->scene))
        o.common.notes.push_back(
            "nothing will move: the scene has no wind, pulls, attachments, moved roots or balls; try --wind gusty");
    FrameRange range = frames_to_make(o, run, frames);
    const auto shown_with = [&](const std::vector<std::uint32_t>& broken) {
        return shown_frames(o, *setting, run, format, broken, range.first, range.last, std::move(model));
    };
    const bool breaks = is_mesh(format) && setting->scene.fracture;
    ShownFrames shown;
    if (!breaks) shown = shown_with({}); // first, as it may refuse
    settle(run, before, o);
    const std::int64_t started = run.steps();
    if (breaks) shown = shown_with(what_breaks(o, run.copy(), range));
    Companions beside;
    if (o.report.error) beside.error.emplace(run);
    if (o.report.rigid) {
        beside.rigid.emplace(*setting, o.run, o.common.threads);
        settle(beside.rigid->whole(), before, o);
    }
    LoopStart loop;
    if (loops) {
        loop = close_loop(run, o.loop, o.run, o.common);
        if (shown.sink)
            shown.sink = loop_sink(std::move(shown.sink), format == "glb" || format == "usda", loop, o.loop, o.run);
    }
    run_frames(o, run, shown.sink.get(), beside, range);
    if (loops) measure_seam(run, loop, o.loop, o.run, o.common.notes);
    report(o, run, range); // before the state is saved, which takes arrays of its own
    save(o, run, range.done);
    if (o.report.guards) std::cerr << guards_lines(run.account(), run.steps() - started);
    if (o.report.hash) std::cerr << "hash " << hash_text(run.hash()) << "\n";
    if (beside.rigid) std::cerr << beside.rigid->line(range.cost.count(), range.steps()) << "\n";
    if (beside.error) std::cerr << error_line(beside.error->result()) << "\n";
    note_run(run.account(), setting->scene, run.steps() - started, o.common.notes);
    if (const std::string note = settled_note(before, o); !note.empty()) o.common.notes.push_back(note);
    return range.done - range.first + 1;
}

std::int64_t make(TreesimOptions& o, const std::string& format) {
    ShownModel model = model_before_threads(o, format);
    const auto read = std::make_shared<Setting>(read_setting(o.run));
    Setting& setting = *read;
    o.common.notes.insert(o.common.notes.end(), setting.notes.begin(), setting.notes.end());
    std::vector<NamedFile> written = output_files(o, format);
    written.push_back({"--save-state", o.save_state});
    // A scene's only tree may be saved in its own place, as INPUT may; one of several is not all that its file holds.
    if (setting.part.parts > 1) written.push_back({"--save-tree", o.save_tree});
    refuse_overwriting_trees(setting, written);
    if (!setting.tree_files.empty()) refuse_overwriting({{"INPUT", o.run.input}}, {{"--save-tree", o.save_tree}});
    for (const std::string& file : setting.converted) // another program's, whole
        refuse_overwriting({{"INPUT", file}}, {{"--save-tree", o.save_tree}});
    complete_model(model, o, setting, format);
    written.push_back({"--save-tree", o.save_tree});
    refuse_overwriting_the_model(written);
    return simulate(o, read, format, std::move(model));
}

void put_together(TreesimOptions& o) {
    if (o.join.parts.empty()) throw UsageError("PART: missing");
    o.join.hash = chosen_reports(o.reports).hash;
    const std::string format = chosen_format(o.common);
    if (is_mesh(format)) throw UsageError("join: meshes are not joined; expected .jsonl, .json, .safetensors");
    std::vector<NamedFile> parts;
    for (const std::string& part : o.join.parts) parts.push_back({"PART", part});
    refuse_overwriting(parts, {{"-o", o.common.output}});
    require_outputs({{"-o", o.common.output}});
    interrupt_at_boundary();
    const std::string line = join_parts(o.join, o.common, format);
    if (!line.empty()) std::cerr << line << "\n";
}

void work(TreesimOptions& o) {
    if (o.run.input.empty()) throw UsageError("INPUT: missing");
    o.report = chosen_reports(o.reports);
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
    return run_tool({{"", treesim_info, [&o](OptionList& list) { declare(list, o); }, [&o] { work(o); }},
                     {"join", join_info, [&o](OptionList& list) { declare_join(list, o); }, [&o] { put_together(o); }}},
                    argc, argv, o.common);
}
