// reader_limits.h: what a child process may take that reads another program's model (forked.h).
#pragma once
#include "formats/forked.h"
#include <cstdint>
#include <optional>

namespace bough {

// What the user gave; each else follows from the file and the machine. Of the whole process; set before anything is read.
struct ReaderChoice {
    std::optional<std::int64_t> megabytes, seconds; // --reader-memory, --reader-seconds
};
ReaderChoice& reader_choice();

// For a file of so many bytes. Memory: 1 GB and 64 bytes for each byte of the file, at most three quarters of what is free; processor time:
// 2 minutes and a second for each 256 KB. Files of Blender and of our own take up to 40 bytes and a second a MB. A limit of the
// process's own (ulimit) that is lower stays.
ChildLimits reader_limits(std::size_t file);

} // namespace bough
