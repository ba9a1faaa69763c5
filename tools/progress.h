// progress.h: how far long work has come.
#pragma once
#include "common.h"

namespace bough {

// A bar on stderr for work that takes long: only on a terminal, never with -q, first shown after half a second.
class Progress {
public:
    Progress(const CommonOptions&, std::string what, std::int64_t total);
    ~Progress();
    void at(std::int64_t done, std::uint64_t bytes = 0); // bytes written so far; 0: not shown

private:
    std::string what_;
    std::int64_t total_;
    bool wanted_, shown_ = false;
    std::int64_t last_ms_;
};

// Clears the bar of the line that it stands on, if one does, for what is said instead. May be called by a signal's handler.
void clear_progress();

} // namespace bough
