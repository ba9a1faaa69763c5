#include "reader_limits.h"
#include "formats/free_memory.h"
#include <algorithm>

namespace bough {

ReaderChoice& reader_choice() {
    static ReaderChoice choice;
    return choice;
}

ChildLimits reader_limits(std::size_t file) {
    const ReaderChoice& choice = reader_choice();
    constexpr std::size_t megabyte = std::size_t(1) << 20;
    ChildLimits limits;
    limits.stack = 256 * megabyte; // for chains of some 100 000 nodes
    limits.bytes = 1000 * megabyte + 64 * file;
    limits.bytes_from = "much for a file of its size; --reader-memory gives it more";
    if (const std::optional<std::size_t> free = free_memory(); free && *free / 4 * 3 < limits.bytes) {
        limits.bytes = *free / 4 * 3;
        limits.bytes_from = "three quarters of what is free on this machine; --reader-memory gives it more";
    }
    if (choice.megabytes) {
        limits.bytes = std::size_t(*choice.megabytes) * megabyte;
        limits.bytes_from = "--reader-memory";
    }
    limits.seconds = unsigned(choice.seconds.value_or(120 + std::int64_t(file / megabyte)));
    limits.seconds_from =
        choice.seconds ? "--reader-seconds" : "much for a file of its size; --reader-seconds gives it more";
    return limits;
}

} // namespace bough
