// output_place.h: what an output of some name would be written to, asked of the file, not of its name.
#pragma once
#include "error.h"
#include <cstdint>
#include <string>
#include <utility>

namespace bough {

struct OutputPlace {
    using File = std::pair<std::uint64_t, std::uint64_t>; // device and number
    std::string path; // after links, which are followed also to a file that is not there yet; "-": stdout
    // What is there is written to: stdout, a device, a pipe, what another process has open (/dev/fd/3)
    bool direct = false;
    bool exists = false; // something is there already: `file`, with the permissions `mode`
    unsigned mode = 0;
    File file{}, folder{}; // of what is there; of the folder in which it stands (none where it is written to directly)
    std::string name;      // in the folder
    bool swallows = false; // a device that does not mix what is written to it by two: /dev/null, a terminal
};

// Throws OutputError for a folder, a place that cannot be looked at, and for links in a circle.
OutputPlace output_place(const std::string& path);

// Whether what is written to the one would replace, or mix with, what is written to the other.
bool same_output(const OutputPlace&, const OutputPlace&);

// Throws as an Output (open.h) of that name would, and leaves nothing: for outputs that are written when work of hours is done.
void require_output(const std::string& path);

} // namespace bough
