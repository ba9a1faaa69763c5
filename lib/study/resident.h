// resident.h: memory that this process has in use, as the system counts it (Linux: /proc/self). Nothing where the system does not say.
#pragma once
#include <cstddef>
#include <optional>

namespace bough {

std::optional<std::size_t> resident();      // [bytes] now, after what was freed has been given back
std::optional<std::size_t> peak_resident(); // [bytes] most since forget_peak, or since the process began
bool forget_peak();                         // false where the system does not allow it

} // namespace bough
