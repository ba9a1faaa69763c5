#include "free_memory.h"
#include <algorithm>
#include <fstream>
#include <string>

namespace bough {
namespace {

// The number of a file that holds one; nothing where it is not there or says "max".
std::optional<std::size_t> number_in(const std::string& file) {
    std::ifstream text(file);
    std::size_t number = 0;
    return text >> number ? std::optional(number) : std::nullopt;
}

// That of the line which begins with `name`.
std::optional<std::size_t> number_after(const std::string& file, const std::string& name) {
    std::ifstream text(file);
    for (std::string word; text >> word;)
        if (std::size_t number = 0; word == name && text >> number) return number;
    return std::nullopt;
}

std::optional<std::size_t> of_machine() {
    const std::optional<std::size_t> kilobytes = number_after("/proc/meminfo", "MemAvailable:");
    return kilobytes ? std::optional(*kilobytes * 1024) : std::nullopt;
}

// What a group may take beside what it has. Pages of files that it has not touched lately are given back when others are needed.
std::optional<std::size_t> of_group(const std::string& folder) {
    const auto most = number_in(folder + "/memory.max"), taken = number_in(folder + "/memory.current");
    if (!most || !taken) return std::nullopt;
    const std::size_t kept =
        *taken - std::min(*taken, number_after(folder + "/memory.stat", "inactive_file").value_or(0));
    return *most - std::min(*most, kept);
}

} // namespace

std::optional<std::size_t> free_memory() {
    std::optional<std::size_t> least = of_machine();
    std::ifstream groups("/proc/self/cgroup");
    std::string path;
    for (std::string line; std::getline(groups, line);)
        if (line.starts_with("0::")) path = line.substr(3);
    if (path.empty()) return least;
    for (;;) { // a group has no more than those that it is in
        if (path.ends_with('/')) path.pop_back();
        if (const auto here = of_group("/sys/fs/cgroup" + path)) least = least ? std::min(*least, *here) : here;
        if (path.empty()) return least;
        path.erase(path.find_last_of('/') == std::string::npos ? 0 : path.find_last_of('/'));
    }
}

} // namespace bough
