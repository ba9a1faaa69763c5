// error.h: what formats/ throws, and which exit code a tool gives for it. The text is one line, ready for stderr.
#pragma once
#include <stdexcept>
#include <string>

namespace bough {

// Bad input (exit 2): "PLACE: what is wrong, what was expected". PLACE is FILE, FILE:LINE or FILE: /json/pointer.
struct InputError : std::runtime_error {
    InputError(const std::string& place, const std::string& message);
};

// Output that could not be written (exit 4): "FILE: why".
struct OutputError : std::runtime_error {
    OutputError(const std::string& file, const std::string& message);
};

} // namespace bough
