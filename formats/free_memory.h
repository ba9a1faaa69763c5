// free_memory.h: how much this process may still take, as the system counts it.
#pragma once
#include <cstddef>
#include <optional>

namespace bough {

// [bytes] that can be had without swapping, of the machine (/proc/meminfo) or, where that is less, of the control group (version 2) that
// the process runs in, as containers have one. Nothing where the system does not say.
std::optional<std::size_t> free_memory();

} // namespace bough
