#include "caches.h"
#include <algorithm>
#include <fstream>
#include <string>
#include <unistd.h>

namespace bough {
namespace {

// As Linux says of the first core: sysconf of glibc 2.36 says ten times too much of a Zen 4 in a virtual machine. 0: it does not say.
std::size_t size_of_level(int level) {
    for (int index = 0; index < 8; ++index) {
        const std::string folder = "/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(index) + "/";
        std::ifstream level_file(folder + "level"), type_file(folder + "type"), size_file(folder + "size");
        int found = 0;
        std::string type;
        std::size_t size = 0;
        char unit = 0;
        if (!(level_file >> found) || !(type_file >> type) || !(size_file >> size)) continue;
        size_file >> unit;
        if (found == level && type != "Instruction") return size << (unit == 'K' ? 10 : unit == 'M' ? 20 : 0);
    }
    return 0;
}

std::size_t size_or(int level, [[maybe_unused]] int name) {
    if (const std::size_t size = size_of_level(level)) return size;
#ifdef _SC_LEVEL3_CACHE_SIZE
    const long size = ::sysconf(name);
    if (size > 0) return std::size_t(size);
#endif
    return 0;
}

} // namespace

#ifdef _SC_LEVEL3_CACHE_SIZE
constexpr int level_2 = _SC_LEVEL2_CACHE_SIZE, level_3 = _SC_LEVEL3_CACHE_SIZE;
#else
constexpr int level_2 = 0, level_3 = 0;
#endif

std::size_t last_cache() {
    return std::max(size_or(3, level_3), core_cache());
}

std::size_t core_cache() {
    return size_or(2, level_2);
}

} // namespace bough
