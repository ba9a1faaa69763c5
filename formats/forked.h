// forked.h: work that may crash, done in a child process, so that the caller outlives it.
#pragma once
#include <cstddef>
#include <functional>
#include <string>

namespace bough {

// The failure of work that threw without a text.
inline constexpr const char* unnamed_failure = "failed";

struct ChildResult {
    std::string bytes;    // what `work` returned
    std::string failure;  // empty, or why there is nothing: what `work` threw, or "crashed (signal 11)"
    bool limited = false; // ... which is a limit
};

// What the child may take; 0: no limit of its own. Sanitized builds keep no memory limit (they reserve terabytes). A lower limit that the
// process has itself (ulimit -v, -t) stays, and is the one that is named.
struct ChildLimits {
    unsigned seconds = 0;                           // of processor time
    std::size_t bytes = 0;                          // of address space beside what the caller has, and beside the stack
    std::size_t stack = 0;                          // [bytes] `work` has, for readers that recurse by depth
    std::string seconds_from = {}, bytes_from = {}; // said where they bite: "--reader-seconds gives it more"
};

// Runs `work` in a forked child whose stderr is thrown away, and hands back what it returned. The child ends with
// _exit: no destructor of the caller's and no unfinished output is touched. Call it before threads are started.
// Throws std::runtime_error where no process can be made.
ChildResult run_forked(const std::function<std::string()>& work, const ChildLimits& = {});

} // namespace bough
