// treeconvert: splines, or any file that can be imported as splines, to a tree of rigid bodies and its skin mesh.
#include "dressing.h"
#include "file_names.h"
#include "formats/documents/material.h"
#include "formats/documents/splines.h"
#include "formats/documents/tree.h"
#include "formats/exports/obj.h"
#include "formats/exports/sequence.h"
#include "formats/imports/any_tree.h"
#include "formats/imports/placed_import.h"
#include "formats/plain_text.h"
#include "frame_sink.h"
#include "import_file.h"
#include "import_stats.h"
#include "lib/base/counted.h"
#include "lib/base/shortest_text.h"
#include "lib/growth/segment.h"
#include "lib/growth/skin.h"
#include "lib/model/drawn_pose.h"
#include "lib/model/root_stiffness.h"
#include "lib/model/split.h"
#include "merge_trial.h"
#include "run_options.h"
#include "tool.h"
#include "wind_trial.h"
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <sstream>

namespace {

using namespace bough;

struct Options {
    CommonOptions common;
    ImportChoice choice;
    std::string input, mesh, wind_groups, material, radii;
    GltfChoice gltf;
    DressChoice dress;
    MergeChoice merge;
    std::optional<double> segment_length, max_bend, root_stiffness;
    std::optional<std::int64_t> max_bodies;
    std::optional<int> sides;
    bool strict = false, stats = false, split = false, list_materials = false;
};

const ToolInfo info = {
    .name = "treeconvert",
    .about = "Turns splines, or any file that treegen imports, into a tree of jointed rigid bodies.",
    .usage = "treeconvert INPUT [-o FILE] [--mesh FILE] [--material NAME|FILE] ...",
    .details =
        "With --split, -o and --mesh are patterns with one %d (or %04d) in the file name: trunk_%d.json gives "
        "trunk_0.json, trunk_1.json ... in the order of the roots. Of another program's file each is set down to "
        "the ground, unless with --keep-place.",
    .examples = "treegen --bodies 2000 | treeconvert - --mesh rest.obj -o tree.json\n"
                "treeconvert oak.xml --stats -o oak.tree.json",
    .formats = {"json", "safetensors"},
    .first = {"INPUT", "--units", "--up", "--trunk-diameter", "--stats", "--strict", "--material", "--list-materials",
              "--segment-length", "--max-bodies", "--mesh", "--sides", "--max-joints", "--leaves-as", "--split"}};

void declare(OptionList& list, Options& o) {
    list.add("INPUT", o.input, "Splines or an importable file; - for stdin");
    list.group("Wood");
    list.add("--segment-length", o.segment_length, "Longest body of a branch [m]; from the branch unless given")
        .takes("M")
        .check(positive_number());
    list.add("--max-bend", o.max_bend, "Most that a branch turns within one body [deg] (20)")
        .takes("DEG")
        .check(positive_number());
    list.add("--max-bodies", o.max_bodies,
             "At most N bodies: what is left out stays as mass, drag and damping on what carries it,\nleaves in clumps")
        .takes("N")
        .check(whole_number(1));
    list.add("--root-stiffness", o.root_stiffness,
             "A spring between the ground and each trunk [N m/rad]; rigid unless given. Old trees: 1e6 to 1e7")
        .takes("K")
        .check(positive_number());
    list.add("--radii", o.radii,
             "file (default), as the input says; or carry: thick enough that wood of --material sags little and stands "
             "four times over")
        .takes("carry|file")
        .one_of({"carry", "file"});
    list.group("Mesh");
    list.add(
            "--mesh", o.mesh,
            "Also write the skin mesh in the drawn pose: FILE.obj with FILE.mtl beside it, or FILE.glb with its joints")
        .takes("FILE")
        .check(file_name());
    list.add("--sides", o.sides, "Corners of the thickest branch's rings, with --mesh (8)")
        .takes("N")
        .check(whole_number(3, 256));
    add_max_joints(list, o.gltf);
    add_leaves_as(list, o.gltf);
    add_dress_options(list, o.dress);
    list.add("--wind-groups", o.wind_groups,
             "With --mesh FILE.glb: also write its joints' groups for Unreal's Dynamic Wind (JSON), by how many "
             "branches they are from the trunk, with influences fitted to a trial run; the joints' x axes then lie "
             "along "
             "the branches, as it wants them")
        .takes("FILE")
        .check(file_name());
    list.group("Wood");
    list.add("--material", o.material,
             "Wood: a preset's name (--list-materials) or a bough-material file; the splines' own unless given")
        .takes("NAME|FILE");
    list.add_flag("--list-materials", o.list_materials, "Write the presets with their figures and sources, and exit");
    list.group("Input");
    list.add_flag("--strict", o.strict, "Guesses, repairs and omissions are errors");
    list.add_flag("--stats", o.stats, "Print what was understood of the input and what was made of it on stderr");
    list.group("Output");
    list.add_flag("--split", o.split, "One file for each root");
    list.group("Wood");
    add_merge_options(list, o.merge);
    list.group("Input");
    add_import_options(list, o.choice);
}

std::string mtl_of(const std::string& mesh) {
    return std::filesystem::path(mesh).replace_extension(".mtl").string();
}

void refuse_own_inputs(const Options& o, const std::string& output, const std::string& mesh,
                       const std::string& wind_groups) {
    const std::vector<NamedFile> written{{"-o", output},
                                         {"--mesh", mesh},
                                         {"the .mtl of --mesh", ending(mesh) == ".obj" ? mtl_of(mesh) : ""},
                                         {"--wind-groups", wind_groups}};
    refuse_overwriting({{"INPUT", o.input},
                        {"--material", o.material},
                        {"--wind", wind_file(o.merge.wind)},
                        {"--look", look_file(o.dress)}},
                       written);
    refuse_overwriting_the_model(written);
}

void refuse_no_patterns(const Options& o) {
    for (const auto& [name, file] : {std::pair("-o", &o.common.output), std::pair("--mesh", &o.mesh),
                                     std::pair("--wind-groups", &o.wind_groups)}) {
        if (file->empty()) continue;
        const std::string wrong = *file == "-" ? "a pattern such as trunk_%d.json is needed" : valid_sequence(*file);
        if (!wrong.empty()) throw UsageError("--split: " + std::string(name) + " is '" + *file + "': " + wrong);
    }
}

// The option that asks for leaves as they are without species.
const char* plain_leaves(const Options& o) {
    return o.gltf.instances() ? "--leaves-as instances" : !o.wind_groups.empty() ? "--wind-groups" : nullptr;
}

void refuse_contradictions(const Options& o) {
    if (o.input.empty()) throw UsageError("INPUT: missing");
    refuse_merge_contradictions(o.merge, !o.wind_groups.empty());
    if (o.sides && o.mesh.empty()) throw UsageError("--sides: only with --mesh");
    if (o.mesh == "-") throw UsageError("--mesh is '-', expected a file name");
    if (!o.mesh.empty() && ending(o.mesh) != ".obj" && ending(o.mesh) != ".glb")
        throw UsageError("--mesh is '" + o.mesh + "', expected a name that ends in .obj or .glb");
    const char* const glb = o.gltf.given() ? o.gltf.given() : !o.wind_groups.empty() ? "--wind-groups" : nullptr;
    if (glb && ending(o.mesh) != ".glb") throw UsageError(std::string(glb) + ": only with --mesh FILE.glb");
    if (o.wind_groups == "-") throw UsageError("--wind-groups is '-', expected a file name");
    refuse_contradictions(o.dress, ending(o.mesh) == ".glb" ? "glb" : "obj", !o.mesh.empty(), plain_leaves(o));
    refuse_own_inputs(o, o.common.output, o.mesh, o.wind_groups);
    if (o.split) refuse_no_patterns(o);
    require_outputs({{"-o", o.common.output},
                     {"--mesh", o.mesh},
                     {"the .mtl of --mesh", ending(o.mesh) == ".obj" ? mtl_of(o.mesh) : ""},
                     {"--wind-groups", o.wind_groups}});
}

// "northern-red-oak, white-oak; " of "oak".
std::string woods_like(const std::string& word) {
    std::string names;
    for (const Material& wood : wood_presets())
        if (wood.name.find(word) != std::string::npos) names += (names.empty() ? "" : ", ") + wood.name;
    return names.empty() ? names : "there is " + names + "; ";
}

Material chosen_material(const Options& o, const Splines& splines) {
    if (o.material.empty()) return own_material(splines, input_name(o.input));
    if (const Material* preset = find_wood(o.material)) return *preset;
    std::error_code none;
    if (o.material.find_first_of("./") == std::string::npos && !std::filesystem::exists(o.material, none))
        throw UsageError("--material is '" + o.material + "', neither a preset (" + woods_like(o.material) +
                         "--list-materials has all) nor a file");
    return read_material(read_input(o.material), input_name(o.material));
}

void list_materials(const std::string& file) {
    std::ostringstream text;
    text << "name\tdensity[kg/m3]\tE[Pa]\tG[Pa]\tdamping ratio\tstrength[Pa]\tsource\n";
    for (const Material& m : wood_presets())
        text << m.name << "\t" << m.density << "\t" << m.youngs_modulus << "\t" << m.shear_modulus << "\t"
             << m.damping_ratio << "\t" << m.strength << "\t" << m.source << "\n";
    Output output(file);
    output.write(text.str());
    output.finish();
}

// What segment() refuses, told of the option that asked for it. A message that begins with no field's name says that there are too many bodies.
std::string of_option(std::string_view what) {
    using Names = std::pair<std::string_view, const char*>;
    for (const auto& [field, option] :
         {Names{"segment_length: ", "--segment-length: "}, Names{"max_bend: ", "--max-bend: "},
          Names{"max_bodies: ", "--max-bodies: "}, Names{"merge: ", "merge: "}}) // no option asks for the last
        if (what.starts_with(field)) return option + std::string(what.substr(field.size()));
    return "--segment-length: " + std::string(what);
}

SegmentOptions segment_options(const Options& o) {
    SegmentOptions options;
    if (o.segment_length) options.segment_length = *o.segment_length;
    if (o.max_bend) options.max_bend = *o.max_bend * 3.14159265358979323846 / 180;
    if (!(options.max_bend > 0)) // segment() would tell of radians, which nobody gave
        throw UsageError("--max-bend: is " + shortest_text(*o.max_bend) +
                         ", expected degrees that are more than 0 in radians too");
    if (o.max_bodies) options.max_bodies = *o.max_bodies;
    return options;
}

std::string statistics(const Splines& splines, const Tree& tree, const SegmentReport& report, const Material& wood) {
    const auto [R_wb, x_w] = drawn_pose(tree);
    std::size_t kinds[4] = {0, 0, 0, 0}, roots = 0;
    double mass = 0, leaves = 0, fruit = 0, area = 0, top = -INFINITY, foot = INFINITY, softest = INFINITY,
           stiffest = 0;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        ++kinds[std::size_t(tree.kind[i])];
        roots += tree.parent[i] < 0;
        mass += tree.mass[i];
        if (is_flat(tree.kind[i])) {
            area += foliage_area(tree, i);
            leaves += foliage_area(tree, i) * tree.size[i][2] * wood.leaf_density;
        }
        if (tree.parent[i] < 0) foot = std::min(foot, x_w[i].y());
        top = std::max({top, x_w[i].y(), (x_w[i] + R_wb[i].col(2) * tree.size[i][0]).y()});
        softest = std::min(softest, tree.stiffness[i].minCoeff());
        stiffest = std::max(stiffest, tree.stiffness[i].maxCoeff());
    }
    for (const double r : splines.fruit_radius) fruit += wood.fruit_density * 4 / 3 * std::numbers::pi * r * r * r;
    std::ostringstream text;
    text << "splines     " << splines.branches() << " branches, " << splines.points() << " points, " << splines.leaves()
         << " leaves, " << splines.fruits() << " fruit\n"
         << "bodies      " << tree.size_bodies() << ": " << kinds[0] << " of branches, " << kinds[1] << " leaves, "
         << kinds[3] << " petals, " << kinds[2] << " fruit; roots " << roots << "\n"
         << "material    " << tree.material << "\n"
         << "mass        " << mass << " kg: wood " << mass - leaves - fruit << ", leaves " << leaves << ", fruit "
         << fruit << "; " << area << " m2 of leaves\n"
         << "height      " << top - foot << " m\n"
         << "stiffness   " << softest << " to " << stiffest << " N m/rad\n"
         << "sway        " << sway_text(tree) << "\n"
         << "longest     " << report.segment_length << " m of branch in one body\n"
         << "merged      " << report.merged_points << " points; dropped " << report.dropped_branches
         << " branches; radii raised to have a mass " << report.thin_points << "\n";
    return text.str();
}

using Outputs = std::vector<std::unique_ptr<Output>>;

void write_mesh(Outputs& outputs, const Tree& tree, Options& o, const std::string& mesh, const std::string& wind) {
    const int sides = o.sides.value_or(SkinOptions().sides);
    const std::optional<OwnMesh> own =
        dressed(tree, o.sides, o.dress, ending(mesh) == ".glb" ? "glb" : "obj", plain_leaves(o));
    const Skin skin = !own ? chosen_skin(tree, sides, o.gltf) : ending(mesh) == ".glb" ? Skin() : skin_of(*own);
    if (ending(mesh) == ".glb") {
        const JointGroups groups = chosen_joints(tree, o.gltf);
        GltfOptions options = gltf_options(o.gltf, tree.source);
        options.x_along = !wind.empty();
        if (!wind.empty()) options.tilted = vertical_joints(tree, groups);
        if (!options.tilted.empty())
            o.common.notes.push_back(
                mesh + ": " +
                counted(options.tilted.size(), "joint of a vertical branch is", "joints of vertical branches are") +
                " turned by 1e-3 rad, as Unreal's wind knows no direction for them");
        outputs.push_back(std::make_unique<Output>(mesh));
        if (own)
            GltfWriter(*outputs.back(), *own, tree, groups, options).finish();
        else
            GltfWriter(*outputs.back(), skin, tree, groups, options).finish();
        if (!wind.empty()) {
            const WindFit fit = wind_by_trial(tree, groups, o.merge, o.common, o.input);
            outputs.push_back(std::make_unique<Output>(wind));
            write_dynamic_wind(*outputs.back(), tree, groups, fit);
            o.common.notes.push_back(wind_note(fit, o.merge));
        }
        if (const std::string lost = leaves_note(tree, o.gltf); !lost.empty())
            o.common.notes.push_back(mesh + ": " + lost);
        if (groups.size() < tree.size_bodies())
            o.common.notes.push_back(
                mesh + ": " + std::to_string(tree.size_bodies()) + " bodies merged to " +
                std::to_string(groups.size()) +
                (o.gltf.instances() ? " joints (--max-joints, --leaves-as instances)" : " joints (--max-joints)"));
        return;
    }
    const std::string mtl = mtl_of(mesh);
    outputs.push_back(std::make_unique<Output>(mtl));
    write_mtl(*outputs.back(), skin);
    outputs.push_back(std::make_unique<Output>(mesh));
    write_obj(*outputs.back(), skin, skin.position, skin.normal, std::filesystem::path(mtl).filename().string());
}

// A tree and the mesh that goes with it: all is written before anything appears under its name.
void write_one(const Tree& tree, Options& o, const std::string& file, const std::string& mesh,
               const std::string& wind) {
    Outputs outputs;
    if (!mesh.empty()) write_mesh(outputs, tree, o, mesh, wind);
    outputs.push_back(std::make_unique<Output>(file));
    write_tree(*outputs.back(), tree, chosen_form(o.common));
    for (auto& output : outputs) output->finish();
}

void write_each(const std::vector<Tree>& trees, Options& o) {
    const auto named = [](const std::string& pattern, std::size_t k) {
        return pattern.empty() ? std::string() : sequence_name(pattern, std::int64_t(k));
    };
    for (std::size_t k = 0; k < trees.size(); ++k)
        refuse_own_inputs(o, named(o.common.output, k), named(o.mesh, k), named(o.wind_groups, k));
    for (std::size_t k = 0; k < trees.size(); ++k) {
        try {
            write_one(trees[k], o, named(o.common.output, k), named(o.mesh, k), named(o.wind_groups, k));
        } catch (const OutputError& error) {
            throw OutputError(o.common.output, "stopped after " + std::to_string(k) + " of " +
                                                   std::to_string(trees.size()) + " trees: " + error.what());
        }
    }
    for (const std::string* pattern : {&o.common.output, &o.mesh, &o.wind_groups}) {
        if (pattern->empty()) continue;
        std::string note = left_behind(*pattern, std::int64_t(trees.size()) - 1, "tree", "trees");
        if (!note.empty()) o.common.notes.push_back(std::move(note));
    }
}

// The trees of one slope, each with its base on the ground; where they stand on it stays.
void set_down(std::vector<Tree>& trees, std::vector<std::string>& notes) {
    double most = 0;
    std::size_t count = 0;
    for (Tree& tree : trees) {
        double& height = tree.joint_position.front().y();
        count += std::abs(height) > noted_height;
        most = std::max(most, std::abs(height));
        height = 0;
    }
    if (count > 0)
        notes.push_back("--split: " + std::to_string(count) + " of " + counted(trees.size(), "tree", "trees") +
                        " set on the ground, over up to " + shown(most) + " m");
}

void work(Options& o) {
    if (o.list_materials) return list_materials(o.common.output);
    refuse_contradictions(o);
    const std::string name = input_name(o.input);
    ImportNotes found;
    Splines splines = read_import(o.input, o.choice, found);
    refuse_own_inputs(o, o.common.output, o.mesh, o.wind_groups);
    const bool is_foreign = found.format != "bough-splines"; // a document of ours stays where it is
    if (o.stats) std::cerr << import_statistics(splines, found);
    std::vector<std::string> notes = std::move(found.lines);
    const std::size_t guesses = notes.size();
    const Material material = chosen_material(o, splines);
    splines.source = with_command_line(splines.source, o.common);
    if (o.radii == "carry") make_carry(splines, material, notes);
    SegmentReport report;
    Tree tree;
    try {
        tree = segment(splines, material, segment_options(o), &report);
    } catch (const std::invalid_argument& error) {
        const std::string_view what = error.what();
        if (what.starts_with("bodies: ")) throw InputError(name, "/" + std::string(what));
        throw UsageError(of_option(what));
    } catch (const std::bad_alloc&) {
        throw InputError(name,
                         "out of memory while bodies were made of its " + counted(splines.points(), "point", "points"));
    }
    if (o.root_stiffness) stand_on_springs(tree, *o.root_stiffness);
    for (std::string& line : repairs(report)) notes.push_back(std::move(line));
    if (o.strict && !notes.empty()) throw InputError(name, notes.front() + " (--strict)");
    if (report.joined_fruit > 0) notes.push_back(joined_fruit(report));
    require_bodies(tree, name);
    std::string merged;
    if (o.merge.below) merged = merge_by_trial(tree, o.merge, o.common, o.input);
    if (o.split) {
        std::vector<Tree> trees = split_roots(tree);
        if (is_foreign && !o.choice.keep_place) set_down(trees, notes);
        write_each(trees, o);
    } else {
        write_one(tree, o, o.common.output, o.mesh, o.wind_groups);
    }
    if (o.stats) std::cerr << statistics(splines, tree, report, material) << merged;
    for (std::size_t k = o.stats ? guesses : 0; k < notes.size(); ++k) // --stats has told of the guesses
        o.common.notes.push_back(name + ": " + notes[k]);
}

} // namespace

int main(int argc, char** argv) {
    Options o;
    return run_tool(
        info, argc, argv, o.common, [&o](OptionList& list) { declare(list, o); }, [&o] { work(o); });
}
