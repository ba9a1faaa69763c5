// forked.h: work that may crash, done in a child process, so that the caller outlives it.
#pragma once
#include <cstddef>
#include <functional>
#include <string>

namespace bough {

// The failure of work that threw without a text.
inline constexpr const char* unnamed_failure = "failed";

struct ChildResult {
    std::string bytes;   // what `work` returned
    std::string failure; // empty, or why there is nothing: what `work` threw, or "crashed (signal 11)"
};

// What the child may take; 0: no limit of its own. Sanitized builds keep no memory limit (they reserve terabytes).
struct ChildLimits {
    unsigned seconds = 0;  // of processor time
    std::size_t bytes = 0; // of address space beside what the caller has
    std::size_t stack = 0; // [bytes] `work` has, for readers that recurse by depth; within `bytes`
};
// What readers of other people's models get: minutes, under 1 GB, a stack for chains of some 100 000 nodes.
constexpr ChildLimits reader_limits{120, std::size_t(1000) << 20, std::size_t(256) << 20};

// Runs `work` in a forked child whose stderr is thrown away, and hands back what it returned. The child ends with
// _exit: no destructor of the caller's and no unfinished output is touched. Call it before threads are started.
// Throws std::runtime_error where no process can be made.
ChildResult run_forked(const std::function<std::string()>& work, const ChildLimits& = {});

} // namespace bough
