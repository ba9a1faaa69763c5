#include "treesim_options.h"
#include "file_names.h"
#include "formats/documents/motion.h"
#include "formats/exports/obj.h"
#include "formats/output_folder.h"
#include "import_file.h"
#include <algorithm>
#include <filesystem>

namespace bough {

const ToolInfo treesim_info = {
    .name = "treesim",
    .about = "Moves a tree or a scene in time and writes its frames.",
    .usage = "treesim TREE|SCENE [--wind NAME|FILE] [--seconds S] [-o FILE] ...\n"
             "treesim join PART... [-o FILE]   (parts of a scene put together)",
    .details =
        "Frames go to stdout as JSON lines: a header line, then a frame a line. -o frames/oak_%04d.obj writes a mesh a "
        "frame and frames/oak.mtl, -o oak.glb one skinned and animated mesh, -o oak.mdd or oak.pc2 where the vertices "
        "of the mesh are that treeconvert --mesh oak.obj writes (Blender: import oak.obj, add the modifier Mesh "
        "Cache, leave its axes: Forward +Y, Up +Z), -o oak_vat/ a vertex animation texture and its mesh (OpenVAT), -o "
        "oak.usda USD text with a skeleton.\n"
        "--resume goes on after the saved frame with the same tree and scene; --seconds and --frames then say how many "
        "frames are added.",
    .examples = "treesim oak.xml --wind gusty --seconds 6 -o oak.glb\n"
                "treesim tree.json --wind gusty --seconds 10 > motion.jsonl\n"
                "treesim tree.json --wind breeze --set material.E=9e9 -o soft.glb",
    .formats = {"jsonl", "json", "safetensors", "obj", "glb", "mdd", "pc2", "usda", "vat"},
    .first = {"INPUT", "--set", "--wind", "--seed", "--gravity", "--seconds", "--frames", "--fps", "--loop",
              "--loop-blend", "--max-joints", "--leaves-as", "--vat-vertices", "--substeps", "--solver", "--report"}};

const ToolInfo join_info = {
    .name = "treesim",
    .about = "Puts together the parts of a scene that treesim --shard made.",
    .usage = "treesim join PART... [-o FILE]\n"
             "treesim join STATE... --report hash",
    .details =
        "Motions become one motion, frame by frame. Saved states become the hash of the whole run. The parts may "
        "come in any order; all of them must be there. Meshes are not joined: each part's stands in the whole's "
        "place.",
    .examples = "treesim join part1.state.json part2.state.json --report hash\n"
                "treesim join part*.safetensors -o park.safetensors",
    .formats = {"jsonl", "json", "safetensors"}};

namespace {

constexpr double sleep_default = 1e-5; // [rad/s]

void declare_mesh(OptionList& list, TreesimOptions& o) {
    list.group("Mesh");
    add_max_joints(list, o.gltf);
    add_leaves_as(list, o.gltf);
    list.add(
            "--mesh", o.mesh,
            "own: the mesh that INPUT itself has is shown, with its materials: a SpeedTree XML's or a skinned model's, "
            "of a scene each tree's (where there is one, the default); made: one made from the tree")
        .takes("NAME")
        .one_of({"own", "made"});
    list.add(
            "--skin", o.skin,
            "Show this model (.glb, .gltf, .fbx, .dae) instead of a mesh made from the tree: in a .glb its own meshes, "
            "skins and materials, with the motion as an animation of its bones; in .usda its mesh and its bones; in "
            ".obj, .mdd, .pc2 and NAME_vat/ its vertices as the bones move them. Or a SpeedTree XML with mesh. The "
            "tree must have been made from it, or stand where its bones do")
        .takes("FILE")
        .check(file_name());
    list.add("--sides", o.sides, "Corners of the thickest branch's rings in a mesh (8)")
        .takes("N")
        .check(whole_number(3, 256));
    add_key_tolerance(list, o.gltf);
    add_dress_options(list, o.dress);
    add_vat_options(list, o.vat);
    list.add_flag("--rustle", o.rustle, "In a mesh, clumps' drawn leaves rustle with the wind");
}

void declare_output(OptionList& list, TreesimOptions& o) {
    list.group("Output");
    list.add("--report", o.reports,
             "Print on stderr, with commas: hash, of the final state; cost, the milliseconds a frame that the steps "
             "took; error, what the branches' tips are off by at this step, from a second run beside this one (five "
             "times the time more); guards, how often the step held or bounded something; plan, each stage and array, "
             "on or left out, and why; rigid, what held joints save and lose, from a run of the whole tree")
        .takes("LIST")
        .any_number_of_times()
        .suggests({"cost", "error", "guards", "hash", "plan", "rigid"});
    list.add("--fields", o.fields,
             "What a frame holds, with commas: pose, velocity, torque, angles, stress, which bends the wood at each "
             "joint (pose)")
        .takes("LIST")
        .suggests({"angles", "pose", "stress", "torque", "velocity"});
    list.add("--digits", o.digits,
             "Round the numbers of JSON frames to so many digits; 6 halve the file, and are a hundredth of a "
             "millimetre in ten metres (as many as give back the same number)")
        .takes("N")
        .check(whole_number(1, 17));
    list.add_flag("--no-output", o.no_output, "Write no frames (for --report, --save-state)");
    list.add("--save-state", o.save_state, "Write the last frame's state, for --resume")
        .takes("FILE")
        .check(file_name());
    list.add("--save-tree", o.save_tree,
             "Write the tree as it stands at the last frame, drawn there: run again with pose drawn it stays, its "
             "springs at rest around what forces had bent it to. It stands where the scene put it; /wood and /load "
             "are in it, the load as its own weight, stiffness_scale and damping_scale are not. For scenes of one tree")
        .takes("FILE")
        .check(file_name());
    list.add_flag(
        "--watch", o.watch,
        "Run, and again whenever the scene, one of its trees or the wind's file has changed, until Ctrl-C; -o "
        "FILE is written anew each time, whole or not at all");
}

} // namespace

void declare(OptionList& list, TreesimOptions& o) {
    o.run.sleep_default = sleep_default;
    add_run_options(list, o.run, seconds_default);
    list.group("Input");
    list.add("--resume", o.resume, "Go on from this state").takes("FILE");
    add_sleep_option(list, o.run);
    add_loop_options(list, o.loop);
    list.group("Wind");
    list.add("--settle", o.settle,
             "Seconds of the wind that are run before frame 0, which then shows the sway and not the first blow. By "
             "default as long as the slowest sway takes to forget the start, 2 to 20 s; 0, a start at rest, without "
             "wind and where the start is what is looked at: pose rest, /fracture. Balls, walkers and what may break "
             "wait for frame 0")
        .takes("S")
        .check(not_negative_number());
    declare_output(list, o);
    declare_mesh(list, o);
    list.group("Distributed");
    list.add("--shard", o.run.shard,
             "Only the i-th of n parts of a scene's trees; bodies move as they do in the whole (treesim join)")
        .takes("i/n");
    for (const char* name : {"hash", "explain", "report-error", "report-cost", "report-rigid"}) {
        const std::string now = name;
        list.renamed("--" + now, "--report " + (now == "explain" ? "plan" : now.substr(now.rfind('-') + 1)));
    }
    list.renamed("--joint-inertia", "--set joint_inertia=NAME");
    list.renamed("--join", "treesim join PART...");
}

void declare_join(OptionList& list, TreesimOptions& o) {
    list.group("Input");
    list.add("PART", o.join.parts, "Motions, or saved states, of all parts").takes("...").in_a_row();
    list.group("Output");
    list.add("--report", o.reports, "hash: print the hash of the whole run, of saved states")
        .takes("hash")
        .one_of({"hash"})
        .any_number_of_times();
    list.renamed("--hash", "--report hash");
}

Reports chosen_reports(const std::vector<std::string>& lists) {
    Reports reports;
    const std::pair<const char*, bool*> names[] = {{"cost", &reports.cost},     {"error", &reports.error},
                                                   {"guards", &reports.guards}, {"hash", &reports.hash},
                                                   {"plan", &reports.plan},     {"rigid", &reports.rigid}};
    for (const std::string& list : lists)
        for (const std::string& name : split_list(list)) {
            const auto* found = std::find_if(std::begin(names), std::end(names),
                                             [&](const auto& known) { return name == known.first; });
            if (found == std::end(names))
                throw UsageError("--report holds '" + name + "', expected cost, error, guards, hash, plan, rigid");
            *found->second = true;
        }
    return reports;
}

MotionFields chosen_fields(const TreesimOptions& o) {
    if (o.fields.empty()) return {};
    MotionFields fields = no_fields;
    for (const std::string& name : split_list(o.fields)) {
        const auto field = field_of(name);
        if (!field) throw UsageError("--fields holds '" + name + "', expected " + field_words_text);
        fields.*field = true;
    }
    return fields;
}

std::string chosen_format(const CommonOptions& common) {
    if (!common.format.empty()) return common.format;
    const std::string folder = without_slash(common.output),
                      written = "there are .jsonl, .json, .safetensors, .obj, .glb, .mdd, .pc2, .usda, NAME_vat/";
    if (folder.ends_with("_vat")) return "vat";
    if (folder != common.output)
        throw UsageError("-o is '" + common.output + "', a folder, which is only written as NAME_vat/; " + written);
    const std::string kind = ending(common.output);
    if (kind == ".json" || kind == ".safetensors" || kind == ".obj") return kind.substr(1);
    if (kind == ".glb" || kind == ".mdd" || kind == ".pc2" || kind == ".usda") {
        if (common.output.find('%') != std::string::npos)
            throw UsageError("-o is '" + common.output + "', but a " + kind +
                             " holds all frames, so its name takes no number");
        return kind.substr(1);
    }
    for (const char* known :
         {".gltf", ".fbx", ".abc", ".usd", ".usdc", ".usdz", ".dae", ".ply", ".stl", ".bvh", ".blend"})
        if (kind == known)
            throw UsageError("-o is '" + common.output + "', but " + known + " is not written; " + written);
    if (kind == ".csv")
        throw UsageError("-o is '" + common.output + "', but a motion is not written as .csv; " + written +
                         "; tools/README.md has a script that makes columns of a .jsonl");
    if (kind == ".gif" || kind == ".webp" || kind == ".mp4" || kind == ".png")
        throw UsageError("-o is '" + common.output + "', but " + kind +
                         " is not written; write a .glb, of which tools/picture makes one");
    return "jsonl";
}

std::vector<NamedFile> output_files(const TreesimOptions& o, const std::string& format) {
    if (o.no_output) return {};
    if (format != "vat")
        return {{"-o", o.common.output}, {"the .mtl of -o", format == "obj" ? sequence_mtl(o.common.output) : ""}};
    std::vector<NamedFile> files;
    for (const std::string& file : vat_outputs(o.common.output, o.vat)) files.push_back({"-o", file});
    return files;
}

const char* plain_leaves(const TreesimOptions& o) {
    return !o.skin.empty() ? "--skin" : o.rustle ? "--rustle" : o.gltf.instances() ? "--leaves-as instances" : nullptr;
}

namespace {

// Options of one kind of mesh with another.
void refuse_choices(const TreesimOptions& o, const std::string& format) {
    const char* const given = o.gltf.given();
    const bool joints = given && given == std::string("--max-joints");
    if (given && format != "glb" && !(joints && format == "usda"))
        throw UsageError(std::string(given) + (joints ? ": only with .glb and .usda" : ": only with .glb"));
    if (format == "usda" && (!o.gltf.leaves_as.empty() || o.gltf.key_tolerance))
        throw UsageError(std::string(o.gltf.leaves_as.empty() ? "--key-tolerance" : "--leaves-as") +
                         ": only with .glb");
    if (o.vat.given() && format != "vat") throw UsageError(std::string(o.vat.given()) + ": only with -o NAME_vat/");
    if (format == "vat" && o.common.output == "-") throw UsageError("-o is '-', but an OpenVAT is a folder, NAME_vat/");
    if (format == "usda" && o.rustle)
        throw UsageError("--rustle: not with .usda, whose leaves move with their joints alone");
}

} // namespace

void refuse_contradictions(const TreesimOptions& o, const std::string& format) {
    if (o.no_output) {
        if (o.common.output != "-") throw UsageError("--no-output: not with -o");
        if (!o.common.format.empty()) throw UsageError("--no-output: not with --format");
        if (!o.fields.empty()) throw UsageError("--no-output: not with --fields");
        if (o.digits) throw UsageError("--no-output: not with --digits");
    }
    if (o.report.error && o.run.solver != solver_name(Solver::coupled))
        throw UsageError("--report error: only with --solver coupled, whose error is its step's alone");
    if (o.report.rigid && !o.resume.empty())
        throw UsageError("--report rigid: not with --resume, which says nothing of the joints that are held");
    const bool mesh = is_mesh(format);
    if (o.rustle && !mesh) throw UsageError("--rustle: only with a mesh (.obj, .glb, .mdd, .pc2, .usda, NAME_vat/)");
    if (o.rustle && o.loop.blend) throw UsageError("--rustle: not with --loop-blend, whose end is its beginning");
    if (o.sides && !mesh) throw UsageError("--sides: only with a mesh (.obj, .glb, .mdd, .pc2, .usda, NAME_vat/)");
    if (!o.fields.empty() && mesh) throw UsageError("--fields: not with ." + format + ", which holds a mesh");
    if (o.digits && format != "json" && format != "jsonl")
        throw UsageError("--digits: only with frames as JSON, not with ." + format);
    if (!o.mesh.empty() && !mesh)
        throw UsageError("--mesh: only with a mesh (.obj, .glb, .mdd, .pc2, .usda, NAME_vat/)");
    if (!o.skin.empty()) {
        if (!mesh) throw UsageError("--skin: only with a mesh (.glb, .obj, .mdd, .pc2, .usda, NAME_vat/)");
        if (!o.mesh.empty()) throw UsageError("--mesh: not with --skin, which says what is shown");
        if (o.sides) throw UsageError("--sides: not with --skin, whose mesh is its own");
        if (!o.gltf.max_joints.empty() && !is_speedtree_file(o.skin))
            throw UsageError("--max-joints: not with --skin, whose bones are its own");
        if (!o.gltf.leaves_as.empty()) throw UsageError("--leaves-as: not with --skin, whose leaves are its own");
        if (o.skin == "-" && o.run.input == "-") throw UsageError("--skin -: the input is read from stdin already");
        if (o.skin == "-" && o.watch) throw UsageError("--watch: not with --skin -, which cannot be read again");
    }
    refuse_contradictions(o.dress, format, mesh, plain_leaves(o));
    refuse_choices(o, format);
    if (format == "obj") {
        const std::string wrong = o.common.output == "-" ? "a pattern such as frames/oak_%04d.obj is needed"
                                                         : valid_sequence(o.common.output);
        if (!wrong.empty()) throw UsageError("-o is '" + o.common.output + "': " + wrong);
    }
    if (o.save_state == "-" && !o.no_output && o.common.output == "-")
        throw UsageError("--save-state -: frames and state cannot both go to stdout");
    if (o.save_tree == "-" && ((!o.no_output && o.common.output == "-") || o.save_state == "-"))
        throw UsageError("--save-tree -: the tree and " + std::string(o.save_state == "-" ? "the state" : "frames") +
                         " cannot both go to stdout");
    // --save-tree INPUT, where that is a tree, and --save-state of what is resumed are another state of the same thing.
    const std::vector<NamedFile> beside{
        {"--wind", wind_file(o.run.wind)}, {"--skin", o.skin}, {"--look", look_file(o.dress)}};
    std::vector<NamedFile> written = output_files(o, format);
    refuse_overwriting({{"--resume", o.resume}}, written);
    refuse_overwriting({{"--resume", o.resume}}, {{"--save-tree", o.save_tree}});
    written.push_back({"--save-state", o.save_state});
    refuse_overwriting({{"INPUT", o.run.input}}, written);
    refuse_overwriting(beside, written);
    refuse_overwriting(beside, {{"--save-tree", o.save_tree}});
    refuse_contradictions(o.loop, o.run);
    if (o.settle.value_or(0) > 0 && o.loop.seconds)
        throw UsageError("--settle: not with --loop, whose first periods are run before anything is written");
    if (o.settle.value_or(0) > 0 && !o.resume.empty())
        throw UsageError("--settle: not with --resume, which goes on from where the saved run stood");
    if (o.loop.seconds) {
        const std::pair<bool, const char*> others[] = {
            {!o.save_state.empty(), "--save-state"},
            {!o.resume.empty(), "--resume"},
            {o.report.error, "--report error"},
            {o.report.rigid, "--report rigid"},
            {!o.run.shard.empty(), "--shard"}}; // each part would end in its own time
        for (const auto& [given, name] : others)
            if (given) throw UsageError(std::string("--loop: not with ") + name);
        const MotionFields fields = chosen_fields(o);
        if (o.loop.blend && (!fields.pose || fields.velocity || fields.torque || fields.angles || fields.stress))
            throw UsageError("--loop-blend: only with --fields pose, which it changes");
    }
    if (o.watch) {
        std::error_code none;
        if (o.run.input == "-" || std::filesystem::is_fifo(o.run.input, none))
            throw UsageError("--watch: not with stdin or a pipe, which cannot be read again");
        if (o.no_output || o.common.output == "-") throw UsageError("--watch: needs -o FILE, written anew by each run");
        if (!o.resume.empty()) throw UsageError("--watch: not with --resume, which goes on with one scene alone");
    }
    if (o.resume == "-" && o.run.input == "-") throw UsageError("--resume -: the input is read from stdin already");
    // The files of a folder that is not there yet cannot be tried.
    if (format == "vat") require_output_folder(o.common.output);
    std::error_code none;
    if (format == "vat" && !std::filesystem::exists(without_slash(o.common.output), none))
        written = {{"-o", without_slash(o.common.output)}, {"--save-state", o.save_state}};
    written.push_back({"--save-tree", o.save_tree});
    require_outputs(written);
}

} // namespace bough
