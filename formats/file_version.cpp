#include "file_version.h"
#include <sys/stat.h>
#include <time.h>

namespace bough {
namespace {

constexpr std::int64_t billion = 1'000'000'000;

std::int64_t nanoseconds_of(const timespec& time) {
    return time.tv_sec * billion + time.tv_nsec;
}

// [ns] since the last write, by the clock that file systems use.
std::int64_t age(const FileVersion& version) {
#ifdef CLOCK_REALTIME_COARSE
    constexpr clockid_t clock = CLOCK_REALTIME_COARSE;
#else
    constexpr clockid_t clock = CLOCK_REALTIME;
#endif
    timespec now{};
    ::clock_gettime(clock, &now);
    return nanoseconds_of(now) - (version.seconds * billion + version.nanoseconds);
}

} // namespace

FileVersion file_version(int file) {
    struct stat known {};
    if (::fstat(file, &known) != 0) return {};
    return {known.st_size, known.st_mtim.tv_sec, known.st_mtim.tv_nsec, std::uint64_t(known.st_dev),
            std::uint64_t(known.st_ino)};
}

FileVersion settled_version(int file) {
    constexpr std::int64_t tick = 10'000'000; // of the coarsest clock that Linux has
    constexpr timespec moment{0, 1'000'000};
    FileVersion version = file_version(file);
    for (int k = 0; k < 20; ++k) {
        const std::int64_t ago = age(version);
        if (ago < 0 || ago > tick) break; // below 0: a clock that was set back
        ::nanosleep(&moment, nullptr);
        version = file_version(file);
    }
    return version;
}

} // namespace bough
