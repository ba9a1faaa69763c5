// option_values.h: what an option takes, checked while it is parsed, and lists that are parsed after.
#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bough {

// Validators for options: the value is refused with the option's name.
CLI::Validator positive_number();     // finite, > 0
CLI::Validator not_negative_number(); // finite, >= 0
CLI::Validator whole_number(std::int64_t least, std::int64_t most = INT64_MAX);
CLI::Validator file_name(); // not empty, not an option by mistake

// "a,b,c" to numbers, for an option; throws UsageError that names it.
std::vector<double> number_list(const std::string& option, const std::string& text, std::size_t count);
std::vector<std::string> split_list(const std::string& text);

std::optional<double> parse_number(const std::string& text); // the whole text, finite

} // namespace bough
