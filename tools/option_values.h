// option_values.h: what an option takes, checked while it is parsed, and lists that are parsed after.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace bough {

// What is wrong with the value of an option, or "": it is refused with the option's name before that.
using ValueCheck = std::function<std::string(const std::string& text)>;
ValueCheck positive_number();     // finite, > 0
ValueCheck not_negative_number(); // finite, >= 0
ValueCheck whole_number(std::int64_t least, std::int64_t most = INT64_MAX);
ValueCheck file_name(); // not empty, not an option by mistake

// "a,b,c" to numbers, for an option; throws UsageError that names it.
std::vector<double> number_list(const std::string& option, const std::string& text, std::size_t count);
std::vector<std::string> split_list(const std::string& text);

std::optional<double> parse_number(const std::string& text); // the whole text, finite

} // namespace bough
