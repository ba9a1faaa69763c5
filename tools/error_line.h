// error_line.h: what treesim --report error prints: one line that begins with `error` and says what the tips are off
// by, or why that is not known. No line feed.
#pragma once
#include "lib/simulation/run_error.h"
#include <string>

namespace bough {

std::string error_line(const TipError&);

} // namespace bough
