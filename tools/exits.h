// exits.h: how a tool ends, and the errors that end it so (run_tool, common.h).
#pragma once
#include <stdexcept>

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

} // namespace bough
