// common.h: what all tools share, declared, parsed and documented once: help, version, threads, output, notes (exits.h,
// option_values.h, signals.h, progress.h beside it). A tool is one Options struct, a function that declares its options, and a function that works.
#pragma once
#include "exits.h"
#include "formats/open.h"
#include "option_values.h"
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace bough {

// Options that every tool has.
struct CommonOptions {
    bool quiet = false;             // -q: no notes, no progress
    int threads = 0;                // --threads; as many as the machine has unless given
    std::string output = "-";       // -o
    std::string format;             // --format; empty: by the output's name
    bool source = true;             // --no-source: the output does not carry the command line
    std::string command_line;       // of this run, quoted for a shell
    std::vector<std::string> notes; // what the user should know once the run has succeeded
};

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
int run_tool(const ToolInfo&, int argc, char** argv, CommonOptions&, const std::function<void(CLI::App&)>& declare,
             const std::function<void()>& work);

bool same_file(const std::string& one, const std::string& other); // two names of one file; - is none

// Throws UsageError where an output is one of the inputs, another kind of file that would be lost. Empty names and - are
// none.
struct NamedFile {
    std::string option, file; // "--skin", "oak.glb"
};
void refuse_overwriting(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written);

// The ending of a file's name in lower case, ".glb", or "".
std::string ending(const std::string& path);

// The form of a document: --format, else the ending of the output's name. Throws UsageError for the ending of a mesh or
// motion, which the tool does not write there.
Form chosen_form(const CommonOptions&);

// `before` with this run's command line as one more line, or unchanged with --no-source.
std::string with_command_line(const std::string& before, const CommonOptions&);

// What a timing or a result was made with.
const char* bough_version();
const char* compiler_name();  // "GNU 12.2.0"
const char* compiler_flags(); // of the library
const char* simd_target();    // what --simd auto takes: baseline, avx2, avx512
int machine_threads();

// --threads takes up to this many; 1 where built without OpenMP.
#ifdef _OPENMP
constexpr int most_threads = 4096;
#else
constexpr int most_threads = 1;
#endif
void use_threads(int); // from now on, in parallel loops of the calling thread

} // namespace bough
