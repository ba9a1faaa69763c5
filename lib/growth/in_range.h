// in_range.h: how a parameter of growth out of its range is refused. Private to growth.
#pragma once
#include "../base/shortest_text.h"
#include <stdexcept>
#include <string>

namespace bough {

// Throws std::invalid_argument: "leaf_bend: is 2, expected -1 to 1".
[[noreturn]] inline void refuse(const std::string& name, double value, const std::string& expected) {
    throw std::invalid_argument(name + ": is " + shortest_text(value) + ", expected " + expected);
}

// Written so that NaN fails.
inline void within(const std::string& name, double value, double least, double most) {
    if (!(value >= least && value <= most)) refuse(name, value, shortest_text(least) + " to " + shortest_text(most));
}

} // namespace bough
