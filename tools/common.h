// common.h: what all tools share, declared, parsed and documented once: help, version, threads, output, notes, exit
// codes, signals. A tool is one Options struct, a function that declares its options, and a function that works.
#pragma once
#include "formats/open.h"
#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace bough {

// Exit codes of every tool. A signal gives 128 + its number, so Ctrl-C gives 130.
enum Exit : int {
    exit_done = 0,         // the output is complete
    exit_usage = 1,        // wrong options
    exit_input = 2,        // an input is missing, broken or refused
    exit_promise = 3,      // the simulation became non-finite, or a checked promise does not hold
    exit_output = 4,       // an output could not be written
    exit_interrupted = 130 // SIGINT
};

// Wrong use of the tool (exit 1). The text names the option.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};
// A promise does not hold (exit 3). What was written before it stays.
struct PromiseError : std::runtime_error {
    using std::runtime_error::runtime_error;
};
// A signal ended the run at a frame boundary (exit 128 + signal).
struct Interrupted : std::runtime_error {
    using std::runtime_error::runtime_error;
};

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

// Validators for options: the value is refused with the option's name.
CLI::Validator positive_number();     // finite, > 0
CLI::Validator not_negative_number(); // finite, >= 0
CLI::Validator whole_number(std::int64_t least, std::int64_t most = INT64_MAX);
CLI::Validator file_name(); // not empty, not an option by mistake

// --units and --up of tools that import. The unit in metres: "m", "cm", "mm", "ft", "in" or a number.
struct ImportChoice {
    std::string units, up;
};
void add_import_options(CLI::App&, ImportChoice&);
std::optional<double> unit_in_metres(const std::string& units);

// "a,b,c" to numbers, for an option; throws UsageError that names it.
std::vector<double> number_list(const std::string& option, const std::string& text, std::size_t count);
std::vector<std::string> split_list(const std::string& text);

std::optional<double> parse_number(const std::string& text);      // the whole text, finite
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

// From now on Ctrl-C only sets a flag: the caller looks at interrupted() at each frame and ends there. Before, and in
// tools that never call it, Ctrl-C ends the program at once; unfinished outputs are removed.
void interrupt_at_boundary();
bool interrupted();

// A bar on stderr for work that takes long: only on a terminal, never with -q, first shown after half a second.
class Progress {
public:
    Progress(const CommonOptions&, std::string what, std::int64_t total);
    ~Progress();
    void at(std::int64_t done);

private:
    std::string what_;
    std::int64_t total_;
    bool wanted_, shown_ = false;
    std::int64_t last_ms_;
};

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
