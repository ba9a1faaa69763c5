// file_version.h: whether a file that is open has been written to since.
#pragma once
#include <cstdint>

namespace bough {

// Which file it is, and as it was written last: its length and the time, as far as the file system tells it.
struct FileVersion {
    std::int64_t size = 0, seconds = 0, nanoseconds = 0;
    std::uint64_t device = 0, number = 0;
    bool operator==(const FileVersion&) const = default;
};
FileVersion file_version(int file); // an open descriptor

// The version before a file is read. The clock of a file system has ticks (4 ms, often): of a file that was written within the last, another
// write could not be told. So that tick is waited for, 20 ms at most.
FileVersion settled_version(int file);

} // namespace bough
