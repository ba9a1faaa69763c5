// formatted.h: printf into a string, for short lines of tables. Tools run in the "C" locale (run_tool pins it).
#pragma once
#include <string>

namespace bough {

// Any length; the compiler checks the arguments against the format.
std::string formatted(const char* format, ...) __attribute__((format(printf, 1, 2)));

std::string bytes_text(double bytes); // "1.2 GB", "340 MB", "12 kB"

} // namespace bough
