// treesim_options.h: what treesim is asked to do: its options, and which of them contradict each other.
#pragma once
#include "baked_sinks.h"
#include "dressing.h"
#include "file_names.h"
#include "frame_sink.h"
#include "join.h"
#include "loop.h"
#include "simulation.h"
#include "tool.h"

namespace bough {

constexpr double seconds_default = 10;

// What --report prints on stderr.
struct Reports {
    bool cost = false, error = false, guards = false, hash = false, plan = false, rigid = false;
};

struct TreesimOptions {
    CommonOptions common;
    RunOptions run;
    std::string fields, save_state, save_tree, resume;
    std::string skin; // the user's own model
    std::string mesh; // "made", "own"; empty: own where INPUT has one
    JoinOptions join;
    GltfChoice gltf;
    DressChoice dress;
    VatChoice vat;
    std::optional<int> sides, digits;
    bool rustle = false;
    LoopChoice loop;
    std::optional<double> settle;     // [s] --settle; none: as settle.h says
    std::vector<std::string> reports; // --report, as given
    Reports report;                   // what these name
    bool no_output = false, watch = false;
};

extern const ToolInfo treesim_info, join_info;
void declare(OptionList&, TreesimOptions&);
void declare_join(OptionList&, TreesimOptions&); // of treesim join

// What --report names. Throws UsageError for what is none of them.
Reports chosen_reports(const std::vector<std::string>& lists);

// Throws UsageError for a name that is none.
MotionFields chosen_fields(const TreesimOptions&);
// jsonl, json, safetensors, obj, mdd, pc2, glb, usda or vat: --format, else by the output's ending. Throws UsageError for the ending of a format that
// is not written.
std::string chosen_format(const CommonOptions&);
inline bool is_point_cache(const std::string& format) {
    return format == "mdd" || format == "pc2";
}
inline bool is_mesh(const std::string& format) {
    return format == "obj" || format == "glb" || format == "usda" || format == "vat" || is_point_cache(format);
}
// The files that -o stands for, as far as they are known beforehand: of a folder all.
std::vector<NamedFile> output_files(const TreesimOptions&, const std::string& format);
// The option that asks for leaves as they are without species; null: none.
const char* plain_leaves(const TreesimOptions&);
// Throws UsageError.
void refuse_contradictions(const TreesimOptions&, const std::string& format);

} // namespace bough
