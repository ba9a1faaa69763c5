// machine_limits.h: what the machine can do at most, measured with loops that do nothing else (machine_kernels.h): memory read, written and
// copied over an array much larger than its caches, and multiply-adds in registers, by one thread or several at once.
//
// One pass each: to be called again and again between other measurements, so that a machine that others use as well is taken as it is then.
#pragma once
#include "../lanes/target.h"
#include <cstddef>

namespace bough {

struct MachineLimits {
    double read = 0, write = 0, copy = 0;   // [B/s]; copied bytes count twice, as they are read and written
    double peak_float = 0, peak_double = 0; // [1/s] operations, two a multiply-add
};

// array: [bytes] of memory that is taken for the while, at least a row (64 bytes) a thread. Throws std::bad_alloc; std::logic_error where what was
// read is not what was written.
MachineLimits measure_limits(fast::Target, int threads, std::size_t array);

// [bytes] Four times the last cache (caches.h), at least 256 MB, at most a quarter of the machine's memory.
std::size_t default_array();

} // namespace bough
