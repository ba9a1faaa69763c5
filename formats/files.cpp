#include "files.h"
#include "documents/motion.h"
#include "documents/scene.h"
#include "documents/species.h"
#include "documents/splines.h"
#include "documents/tree.h"
#include "lib/base/shortest_text.h"
#include "lib/growth/segment.h"
#include "lib/growth/species.h"
#include "lib/model/wood.h"
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>

namespace bough {
namespace {

Species species_named(const std::string& name) {
    if (std::optional<Species> species = find_species(name)) return std::move(*species);
    std::string names;
    for (const std::string& known : species_names()) names += (names.empty() ? "" : ", ") + known;
    throw SceneError("species: is '" + name + "', expected one of " + names);
}

MotionForm form_of(const std::string& file) {
    const std::string ending = std::filesystem::path(file).extension().string();
    if (ending == ".safetensors") return MotionForm::safetensors;
    if (ending == ".json") return MotionForm::json;
    if (ending == ".jsonl" || file == "-") return MotionForm::jsonl;
    throw OutputError(file, "ends with '" + ending + "', expected .jsonl, .json or .safetensors");
}

template <class Write> void write_file(const std::string& file, Write&& write) {
    Output output(file);
    write(output, form_of_name(file));
    output.finish();
}

} // namespace

std::vector<std::string> species_names() {
    std::vector<std::string> names = {default_species().name};
    for (const SpeciesFile& file : species_files()) names.emplace_back(file.name);
    return names;
}

Splines grow(const std::string& species, const GrowOptions& o) {
    const Species kind = species_named(species);
    const Items items{o.leaves, o.petals, o.fruit};
    if (o.bodies < 0) throw SceneError("bodies: is " + std::to_string(o.bodies) + ", expected 0 or more");
    try {
        const GrowthParameters growth = o.age == 0 ? kind.growth : at_age(kind, o.age);
        Splines splines = o.bodies > 0 ? grow_bodies(growth, o.seed, items, o.bodies) : grow(growth, o.seed, items);
        splines.material = kind.material;
        splines.color = kind.color;
        return splines;
    } catch (const std::invalid_argument& error) {
        throw SceneError(error.what());
    }
}

Tree convert(const Splines& splines) {
    if (const std::optional<Defect> defect = check(splines))
        throw SceneError("splines: /" + defect->field + (defect->index < 0 ? "" : "/" + std::to_string(defect->index)) +
                         ": " + defect->message);
    const Material* const wood = find_wood(splines.material);
    try {
        Tree tree = segment(splines, wood ? *wood : wood_presets().front(), SegmentOptions());
        if (tree.size_bodies() > 0) return tree;
    } catch (const std::invalid_argument& error) {
        throw SceneError(error.what());
    }
    throw SceneError("splines: hold no branch with a length, expected a tree");
}

Splines read_splines(const std::string& file) {
    return read_splines(read_input(file), input_name(file));
}

Tree read_tree(const std::string& file) {
    return read_tree(Input(file));
}

Scene read_scene(const std::string& file) {
    SceneDocument document = read_scene_document(read_input(file), input_name(file));
    std::map<std::string, std::shared_ptr<const Tree>> known;
    for (Placement& place : document.scene.trees) {
        std::shared_ptr<const Tree>& tree = known[place.file];
        if (!tree) {
            const std::string path = tree_file(file, place);
            tree = std::make_shared<const Tree>(with_material(read_tree(path), document.material, path));
        }
        place.tree = tree;
    }
    // A scene written later has no /material, so that the files' own trees would come back with another wood.
    if (document.material.any())
        for (Placement& place : document.scene.trees) place.file.clear();
    return std::move(document.scene);
}

void write_splines(const std::string& file, const Splines& splines) {
    write_file(file, [&](Output& to, Form form) { write_splines(to, splines, form); });
}

void write_tree(const std::string& file, const Tree& tree) {
    write_file(file, [&](Output& to, Form form) { write_tree(to, tree, form); });
}

void write_scene(const std::string& file, const Scene& scene) {
    write_file(file, [&](Output& to, Form form) { write_scene(to, scene, form); });
}

SavedState read_state(const std::string& file) {
    return read_state(read_input(file), input_name(file));
}

void write_state(const std::string& file, const SavedState& saved) {
    write_file(file, [&](Output& to, Form form) { write_state(to, saved, form); });
}

struct MotionFile::Inside {
    Inside(const std::string& file, const MotionHeader& header, const Digits& digits)
        : fps(header.fps), bodies(header.bodies), fields(header.fields), output(file),
          writer(output, header, form_of(file), digits) {}
    double fps;
    std::int64_t bodies;
    MotionFields fields;
    Output output;
    MotionWriter writer;
    MotionFrame frame;
    std::int64_t written = 0;
};

MotionFile::MotionFile(const std::string& file, const Simulation& simulation, double fps) {
    if (!(fps >= 0) || !std::isfinite(fps))
        throw SceneError("fps: is " + shortest_text(fps) + ", expected frames a second above 0, or 0 for one a step");
    MotionHeader header;
    header.fps = fps > 0 ? fps : 1 / simulation.options().step;
    header.bodies = std::int64_t(simulation.bodies());
    header.balls = header.bodies - std::int64_t(simulation.tree().size_bodies());
    header.events = simulation.has_events();
    header.fields.velocity = simulation.options().velocities;
    header.fields.torque = simulation.options().torques;
    header.fields.stress = simulation.options().stresses;
    header.name = simulation.tree().name;
    header.source = simulation.tree().source;
    inside_ = std::make_unique<Inside>(file, header, Digits{simulation.options().precision == Precision::single, 0});
}

MotionFile::MotionFile(MotionFile&&) noexcept = default;
MotionFile::~MotionFile() = default;

void MotionFile::write(const Simulation& simulation) {
    const auto whole = [&](bool named, std::size_t size, const char* field) {
        if (named && size == 0) throw SceneError(std::string(field) + ": the simulation computes none, the file's did");
    };
    if (const auto bodies = std::int64_t(simulation.bodies()); bodies != inside_->bodies)
        throw SceneError("bodies: the simulation has " + std::to_string(bodies) + ", the file's has " +
                         std::to_string(inside_->bodies));
    whole(inside_->fields.velocity, simulation.velocities().size(), "velocities");
    whole(inside_->fields.torque, simulation.torques().size(), "torques");
    whole(inside_->fields.stress, simulation.stresses().size(), "stresses");
    MotionFrame& frame = inside_->frame;
    const auto copy = [](const auto& from, auto& to) { to.assign(from.begin(), from.end()); };
    frame.frame = inside_->written;
    frame.time = double(inside_->written) / inside_->fps;
    copy(simulation.positions(), frame.position);
    copy(simulation.rotations(), frame.rotation);
    copy(simulation.velocities(), frame.velocity);
    copy(simulation.angular_velocities(), frame.angular_velocity);
    copy(simulation.torques(), frame.torque);
    copy(simulation.stresses(), frame.stress);
    frame.events = simulation.events();
    if (const std::string what = beyond_floats(frame); !what.empty()) throw OutputError(inside_->output.name(), what);
    inside_->writer.write(frame);
    ++inside_->written;
}

void MotionFile::finish() {
    inside_->writer.finish();
    inside_->output.finish();
}

} // namespace bough
