// caches.h: how much the machine's caches hold.
#pragma once
#include <cstddef>

namespace bough {

// [bytes] Both return 0 where the system does not say. They ask it each time, which reads some files of a line.
std::size_t last_cache(); // the one that is asked last, which cores may share
std::size_t core_cache(); // a core's own

} // namespace bough
