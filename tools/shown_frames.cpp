#include "shown_frames.h"
#include "baked_sinks.h"
#include "formats/documents/motion.h"
#include "formats/inside.h"
#include "lib/base/counted.h"
#include "lib/base/hash_text.h"
#include "progress.h"
#include "rustling.h"
#include "sized_sink.h"
#include <algorithm>
#include <iostream>
#include <numbers>
#include <set>

namespace bough {
namespace {

// What the run reads and writes, none of which an image beside the output may replace.
std::vector<NamedFile> files_of_run(const TreesimOptions& o, const Setting& setting) {
    std::vector<NamedFile> files{{"INPUT", o.run.input},
                                 {"--wind", wind_file(o.run.wind)},
                                 {"--skin", o.skin},
                                 {"--look", look_file(o.dress)},
                                 {"--resume", o.resume}};
    for (const NamedFile& output : {NamedFile{"--save-state", o.save_state}, NamedFile{"--save-tree", o.save_tree}})
        if (output.file != "-") files.push_back(output);
    for (const std::string& file : setting.tree_files) files.push_back({"the scene", file});
    for (const std::string& file : named_files_read()) files.push_back({"the model", file});
    return files;
}

DrivenPlace place_of(const Setting& setting) {
    if (setting.scene.trees.empty()) return {};
    const Placement& first = setting.scene.trees.front();
    return {first.position, first.yaw * std::numbers::pi / 180};
}

DrivenOptions driven_options(const TreesimOptions& o, const Setting& setting, const std::string& source) {
    DrivenOptions options;
    options.fps = o.run.fps;
    options.key_tolerance = gltf_options(o.gltf, source).key_tolerance;
    options.source = source;
    options.place = place_of(setting);
    return options;
}

// Of a user's own model, which is taken. Null where there is none, or where INPUT's is none that the tree can move and nobody asked for it: a note
// says so, and there is none then.
std::unique_ptr<FrameSink> driven(TreesimOptions& o, const Setting& setting, const Tree& shown,
                                  const std::string& format, const CacheFrames& cached,
                                  std::optional<UserModel>& model) {
    if (!model) return nullptr;
    const auto pass_over = [&](const InputError& error) {
        if (!o.skin.empty() || o.mesh == "own") throw;
        o.common.notes.push_back(std::string(error.what()) + ": a mesh made from the tree is shown");
        model.reset();
        return nullptr;
    };
    try {
        const std::string source = with_command_line(setting.source, o.common);
        if (format == "glb")
            return driven_sink(o.common.output, std::move(*model), shown, driven_options(o, setting, source),
                               o.common.notes);
        DrivenMesh mesh(*model, shown, place_of(setting), o.common.notes);
        model->document.reset(); // its arrays are in the mesh
        o.common.notes.push_back(counted(mesh.bones(), "bone", "bones") + " of the model moved");
        if (format == "obj")
            return obj_sink(o.common.output, moved(std::move(mesh)), files_of_run(o, setting), o.common.notes);
        if (format == "vat")
            return vat_sink(o.common.output, shown, moved(std::move(mesh)),
                            {o.run.fps, cached.count, o.loop.seconds.has_value(), true}, o.vat, source, o.common.notes);
        if (format == "usda")
            return usda_sink(o.common.output, shown.name, rigged(mesh), o.run.fps, source, files_of_run(o, setting));
        return driven_cache_sink(o.common.output, format, std::move(mesh), cached, o.common.notes);
    } catch (const OtherTree& error) {
        return pass_over(error);
    } catch (const NoSkinnedMesh& error) {
        return pass_over(error);
    }
}

// How each of the scene's trees looks; nothing where all look alike: as --look says, or as the first, since a vertex animation texture has vertices
// for one.
std::vector<TreeLook> looks_apart(const TreesimOptions& o, const Setting& setting, const std::string& format) {
    return o.dress.look.empty() && format != "vat" ? setting.looks : std::vector<TreeLook>();
}

bool one_is_known(const std::vector<TreeLook>& looks, const DressChoice& o) {
    return std::any_of(looks.begin(), looks.end(), [&](const TreeLook& look) { return has_look(look.name, o); });
}

// What makes the mesh of trees that have none of their own. Beside others whose look is known, one of none is told of.
std::function<OwnMesh(const Tree&)> made_mesh(TreesimOptions& o, const Setting& setting, const std::string& format) {
    const bool others = one_is_known(looks_apart(o, setting, format), o.dress);
    return [&o, &format, others](const Tree& tree) {
        std::optional<OwnMesh> made;
        if (!others || has_look(tree.name, o.dress))
            made = dressed(tree, o.sides, o.dress, format, plain_leaves(o));
        else if (const char* const given = o.dress.given())
            o.common.notes.push_back(std::string(given) + ": not of the tree that is called '" + tree.name +
                                     "', which is no species whose leaves are known: its leaves are kites");
        return made ? std::move(*made) : dress(tree, Species(), {LeafDetail::kite, 0, o.sides.value_or(8)});
    };
}

// Whether the scene's trees are of several looks, one of which is known.
bool looks_differ(const TreesimOptions& o, const Setting& setting, const std::string& format) {
    const std::vector<TreeLook> looks = looks_apart(o, setting, format);
    return std::set<TreeLook>(looks.begin(), looks.end()).size() > 1 && dresses(o.dress, format, plain_leaves(o)) &&
           one_is_known(looks, o.dress);
}

// Of a scene some of whose files are skinned models. Null where none of them can be moved by its tree: notes say so, and the others remain to be
// shown.
std::unique_ptr<FrameSink> placed(TreesimOptions& o, const Setting& setting, const Tree& shown,
                                  const std::string& format, const CacheFrames& cached, ShownModel& model) {
    if (model.skinned.empty()) return nullptr;
    std::vector<PlacedForest> forests;
    std::vector<PlacedMesh> meshes;
    Bodies elsewhere;
    const std::string source = with_command_line(setting.source, o.common);
    std::vector<PlacedFile> files = placed_files(std::exchange(model.skinned, {}), shown, setting);
    for (std::size_t k = 0; k < files.size(); ++k) {
        const Bodies bodies = bodies_of(files[k]);
        const auto pass_over = [&](const InputError& error) {
            if (o.mesh == "own") throw;
            o.common.notes.push_back(std::string(error.what()) + ": a mesh made from the tree is shown");
        };
        try {
            if (format == "glb")
                forests.push_back(forest_of(std::move(files[k]), driven_options(o, setting, source), o.common.notes));
            else
                std::ranges::move(meshes_of(std::move(files[k]), k, o.common.notes), std::back_inserter(meshes));
        } catch (const OtherTree& error) {
            pass_over(error);
            continue;
        } catch (const NoSkinnedMesh& error) {
            pass_over(error);
            continue;
        }
        elsewhere.insert(elsewhere.end(), bodies.begin(), bodies.end());
    }
    if (forests.empty() && meshes.empty()) return nullptr;
    std::sort(elsewhere.begin(), elsewhere.end());
    OtherMesh others = other_mesh(bound_mesh(std::exchange(model.bound, {}), shown, setting,
                                             {elsewhere, looks_apart(o, setting, format)},
                                             made_mesh(o, setting, format), o.common.notes),
                                  elsewhere, shown.size_bodies());
    if (others.bodies.empty() && !o.gltf.max_joints.empty())
        throw UsageError("--max-joints: only with --mesh made, as all of the scene's trees show bones of their own");
    if (format == "glb")
        return forest_sink(o.common.output, std::move(forests), std::move(others), shown, o.run.fps, o.gltf, source,
                           o.common.notes);
    o.common.notes.push_back(counted(bones_of(meshes), "bone", "bones") + " of the models moved");
    if (format == "usda")
        return usda_sink(o.common.output, shown.name, rigged(meshes, std::move(others), shown, o.gltf, o.common.notes),
                         o.run.fps, source, files_of_run(o, setting));
    MovedMesh mesh = moved(std::move(meshes), std::move(others), shown);
    if (format == "obj") return obj_sink(o.common.output, std::move(mesh), files_of_run(o, setting), o.common.notes);
    if (format == "vat")
        return vat_sink(o.common.output, shown, std::move(mesh),
                        {o.run.fps, cached.count, o.loop.seconds.has_value(), true}, o.vat, source, o.common.notes);
    return moved_cache_sink(o.common.output, format, std::move(mesh), cached, o.common.notes);
}

// shown: the tree that meshes are made of, the balls with it.
std::unique_ptr<FrameSink> open_sink(TreesimOptions& o, const Setting& setting, const Tree& shown, std::size_t bodies,
                                     const std::string& format, std::int64_t first, std::int64_t last,
                                     ShownModel& model) {
    const CacheFrames cached{o.run.fps, first, last - first + 1};
    if (std::unique_ptr<FrameSink> sink = driven(o, setting, shown, format, cached, model.driven)) return sink;
    if (std::unique_ptr<FrameSink> sink = placed(o, setting, shown, format, cached, model)) return sink;
    RustleMaker rustle = [](const Skin&, bool) { return std::unique_ptr<Rustle>(); };
    if (o.rustle) rustle = rustle_maker(setting, shown, o.run.fps);
    std::optional<OwnMesh> own;
    const bool bound = !model.bound.empty();
    const bool apart = !bound && is_mesh(format) && looks_differ(o, setting, format);
    if (bound || apart)
        own = bound_mesh(std::move(model.bound), shown, setting, {{}, looks_apart(o, setting, format)},
                         made_mesh(o, setting, format), o.common.notes);
    else if (is_mesh(format))
        own = dressed(shown, o.sides, o.dress, format, plain_leaves(o));
    if (own && format == "vat" && o.dress.look.empty() && !bound && setting.tree_files.size() > 1)
        o.common.notes.push_back("the trees of " + std::to_string(setting.tree_files.size()) +
                                 " files all look as the first one's species, " + shown.name + ", does (--look)");
    if (is_point_cache(format) && own)
        return own_cache_sink(o.common.output, format, shown, std::move(*own), cached, o.common.notes);
    if (is_mesh(format) && format != "glb") {
        SkinOptions drawn{o.sides.value_or(8)};
        if (format == "vat") drawn.clump_leaves = leaves_in_vat;
        Skin skin = own ? skin_of(*own) : build_skin(shown, drawn);
        if (format == "obj")
            return obj_sink(o.common.output, moved(std::move(skin), std::move(own), shown, rustle),
                            files_of_run(o, setting), o.common.notes);
        if (format == "vat")
            return vat_sink(o.common.output, shown, moved(std::move(skin), std::move(own), shown, rustle),
                            {o.run.fps, last - first + 1, o.loop.seconds.has_value(), bound}, o.vat,
                            with_command_line(setting.source, o.common), o.common.notes);
        if (format == "usda")
            return usda_sink(o.common.output, shown.name,
                             rigged(shown, std::move(skin), std::move(own), o.gltf, o.common.notes), o.run.fps,
                             with_command_line(setting.source, o.common), files_of_run(o, setting));
        return cache_sink(o.common.output, format, shown, std::move(skin), rustle, cached, o.common.notes);
    }
    const std::string source = with_command_line(setting.source, o.common);
    if (own) return own_sink(o.common.output, shown, std::move(*own), o.run.fps, o.gltf, source, o.common.notes);
    if (format == "glb")
        return gltf_sink(o.common.output, shown, o.sides.value_or(8), rustle, o.run.fps, o.gltf, source,
                         o.common.notes);
    MotionHeader header;
    header.fps = o.run.fps;
    header.balls = std::int64_t(setting.scene.balls.size() + setting.scene.walkers.size());
    header.bodies = std::int64_t(bodies);
    header.events = has_free_bodies(setting.scene);
    header.fields = chosen_fields(o);
    header.part = setting.part.part;
    header.parts = setting.part.parts;
    header.first_body = setting.part.first_body;
    if (setting.part.parts > 1) header.whole = hash_text(setting.part.whole);
    header.name = setting.tree.name;
    header.source = source;
    return motion_sink(o.common.output, format, header, {o.run.precision == "float", o.digits.value_or(0)});
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
        o.common.notes.push_back(std::string("the vertices are those of ") +
                                 (setting.ranges.size() > 1 ? "the files' own meshes" : "the file's own mesh") +
                                 ", material by material: the mesh that they move is the first frame of an OBJ "
                                 "sequence (the same run with --frames 1 -o rest_%d.obj)");
        return;
    }
    o.common.notes.push_back("the vertices are those of " + counted(setting.ranges.size(), "tree", "trees") + " and " +
                             counted(balls, "ball", "balls") +
                             ": the mesh that they move is the first frame of an OBJ sequence (the same run with "
                             "--frames 1 -o rest_%d.obj)");
}

} // namespace

ShownFrames shown_frames(TreesimOptions& o, const Setting& setting, const Simulation& run, const std::string& format,
                         const std::vector<std::uint32_t>& broken, std::int64_t first, std::int64_t last,
                         ShownModel model) {
    ShownFrames shown;
    if (o.no_output) return shown;
    if (is_point_cache(format)) refuse_broken_cache(o, broken.size());
    const std::size_t balls = is_mesh(format) ? run.balls().size() : 0;
    if (!broken.empty() || balls > 0) shown.own = std::make_unique<const Tree>(run.shown_tree(broken));
    o.gltf.loose = broken.size() + balls;
    const bool bound = !model.bound.empty() || !model.skinned.empty();
    shown.sink = open_sink(o, setting, shown.own ? *shown.own : run.tree(), run.bodies(), format, first, last, model);
    if (model.driven && balls > 0)
        o.common.notes.push_back("balls and walkers are not shown beside a model's own mesh");
    if (is_kept(o.common.output)) {
        std::string smaller =
            smaller_output(format, o.digits || o.run.precision == "float", split_list(o.fields).size() > 1);
        shown.sink =
            sized_sink(std::move(shown.sink), std::move(smaller), last - first + 1, [&o](const std::string& text) {
                if (o.common.quiet) return;
                clear_progress();
                std::cerr << treesim_info.name << ": " << text << "\n";
            });
    }
    if (is_point_cache(format)) note_cache(o, setting, balls, bound || model.driven);
    return shown;
}

} // namespace bough
