// shortest_text.h: a number as people write it in messages, whatever the locale.
#pragma once
#include <string>

namespace bough {

// Writes as few digits as read back as the same number.
std::string shortest_text(double);
// Rounds to so many significant digits.
std::string rounded_text(double, int digits);
std::string four_digits(double);

} // namespace bough
