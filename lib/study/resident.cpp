#include "resident.h"
#include <fstream>
#include <string>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace bough {
namespace {

// A line "NAME:   1234 kB".
std::optional<std::size_t> status(const std::string& name) {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);)
        if (line.rfind(name + ":", 0) == 0) return std::size_t(std::stoull(line.substr(name.size() + 1))) * 1024;
    return std::nullopt;
}

} // namespace

std::optional<std::size_t> resident() {
#ifdef __GLIBC__
    ::malloc_trim(0);
#endif
    return status("VmRSS");
}

std::optional<std::size_t> peak_resident() {
    return status("VmHWM");
}

bool forget_peak() {
    std::ofstream file("/proc/self/clear_refs");
    file << "5\n";
    return bool(file.flush());
}

} // namespace bough
