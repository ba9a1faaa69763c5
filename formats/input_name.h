// input_name.h: how an input is called in messages.
#pragma once
#include <string>

namespace bough {

// Returns its path, "<stdin>" for "-".
inline std::string input_name(const std::string& path) {
    return path == "-" ? "<stdin>" : path;
}

} // namespace bough
