// forked.h: work that may crash, done in a child process, so that the caller outlives it.
#pragma once
#include <functional>
#include <string>

namespace bough {

struct ChildResult {
    std::string bytes;   // what `work` returned
    std::string failure; // empty, or why there is nothing: what `work` threw, or "crashed (signal 11)"
};

// Runs `work` in a forked child whose stderr is thrown away, and hands back what it returned. The child ends with
// _exit: no destructor of the caller's and no unfinished output is touched. Call it before threads are started.
// Throws std::runtime_error where no process can be made.
ChildResult run_forked(const std::function<std::string()>& work);

} // namespace bough
