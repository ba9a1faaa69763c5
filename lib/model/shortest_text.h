// shortest_text.h: a number as people write it in messages.
#pragma once
#include <string>

namespace bough {

// With as few digits as read back as the same number, whatever the locale.
std::string shortest_text(double);

} // namespace bough
