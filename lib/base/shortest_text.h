// shortest_text.h: a number as people write it in messages, whatever the locale.
#pragma once
#include <string>

namespace bough {

// With as few digits as read back as the same number.
std::string shortest_text(double);
// Rounded to so many digits that count.
std::string rounded_text(double, int digits);
std::string four_digits(double);

} // namespace bough
