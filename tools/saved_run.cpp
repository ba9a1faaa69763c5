#include "saved_run.h"
#include "formats/documents/motion.h"
#include "formats/documents/tree.h"

namespace bough {
namespace {

void save_state(const TreesimOptions& o, const Simulation& run, std::int64_t frame) {
    SavedState saved = run.save();
    saved.frame = frame;
    saved.fps = o.run.fps;
    saved.substeps = o.run.substeps;
    saved.source = with_command_line(saved.source, o.common);
    Output output(o.save_state);
    write_state(output, saved, form_of_name(o.save_state));
    output.finish();
}

void save_tree(const TreesimOptions& o, const Simulation& run) {
    Tree tree;
    try {
        tree = run.posed_tree();
    } catch (const SceneError& error) {
        throw OutputError(o.save_tree, std::string("--save-tree: ") + error.what());
    }
    tree.source = with_command_line(tree.source, o.common);
    Output output(o.save_tree);
    write_tree(output, tree, form_of_name(o.save_tree));
    output.finish();
}

} // namespace

void restore(const TreesimOptions& o, const SavedState& saved, Simulation& run) {
    if (saved.substeps != o.run.substeps)
        throw InputError(input_name(o.resume), "/substeps: is " + std::to_string(saved.substeps) +
                                                   ", but this run has " + std::to_string(o.run.substeps));
    if (saved.fps != o.run.fps) throw InputError(input_name(o.resume), "/fps: differs from this run's (--fps)");
    try {
        run.restore(saved);
    } catch (const SceneError& error) {
        throw InputError(input_name(o.resume), error.what());
    }
}

void save(const TreesimOptions& o, const Simulation& run, std::int64_t frame) {
    if (!o.save_state.empty()) save_state(o, run, frame);
    if (!o.save_tree.empty()) save_tree(o, run);
}

void require_one_tree(const Setting& setting) {
    if (setting.whole) throw UsageError("--save-tree: not where joints are held (/simulate, /rigid)");
    if (setting.ranges.size() != 1)
        throw UsageError("--save-tree: the scene has " + std::to_string(setting.ranges.size()) +
                         " trees, expected one: a document holds one tree");
}

} // namespace bough
