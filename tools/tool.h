// tool.h: how every tool runs: one Options struct, a function that declares its options (option_list.h), and a function that works. Help, version,
// threads, output and notes are declared, parsed and documented once, here (exits.h, signals.h, progress.h beside it).
#pragma once
#include "common.h"
#include "option_list.h"
#include <functional>

namespace bough {

// What a tool, or a sub-command of one, says of itself, and which of the common options it has.
struct ToolInfo {
    const char* name;                   // "treegen"
    const char* about;                  // one sentence
    const char* usage;                  // as it is typed, a line each
    const char* details = "";           // paragraphs, a line each
    const char* examples = "";          // as they are typed, a line each
    std::vector<std::string> formats{}; // what --format takes; empty: no --format
    std::vector<std::string> first{};   // what --help shows beside the common options; empty: all
    bool has_source = true;             // whether outputs record the command line (--no-source)
    bool has_threads = true;            // --threads N; else it declares its own
    bool has_input = true;              // whether it does nothing without an argument
};

// A tool's sub-command keeps its options itself.
struct Subcommand {
    const char* word; // first of the command line; of the one that runs without a word it may be ""
    ToolInfo info;
    std::function<void(OptionList&)> declare;
    std::function<void()> work;
};

// Runs a tool: chooses the sub-command by the first word, the first of them without one; declares the common options and its own, parses, works,
// reports what went wrong in one line on stderr, closes stdout, returns the exit code. Notes are printed after success only, and not with -q.
int run_tool(const std::vector<Subcommand>&, int argc, char** argv, CommonOptions&);
int run_tool(const ToolInfo&, int argc, char** argv, CommonOptions&, const std::function<void(OptionList&)>& declare,
             const std::function<void()>& work);

} // namespace bough
