// tool.h: how every tool runs: one Options struct, a function that declares its options (option_list.h), and a function that works. Help, version, threads,
// output and notes are declared, parsed and documented once, here (exits.h, signals.h, progress.h beside it).
#pragma once
#include "common.h"
#include "option_list.h"
#include <functional>

namespace bough {

struct ToolInfo {
    const char* name;                 // "treegen"
    const char* about;                // one or two lines for --help
    const char* epilog;               // examples and details for --help
    std::vector<std::string> formats; // what --format takes; empty: no --format
    bool has_source = true;           // whether outputs record the command line (--no-source)
    bool has_threads = true;          // --threads N; else the tool declares its own
    bool has_input = true;            // whether it does nothing without an argument
};

// Runs a tool: declares the common options and the tool's own, parses, works, reports what went wrong in one line on
// stderr, closes stdout, returns the exit code. Notes are printed after success only, and not with -q.
int run_tool(const ToolInfo&, int argc, char** argv, CommonOptions&, const std::function<void(OptionList&)>& declare,
             const std::function<void()>& work);

} // namespace bough
