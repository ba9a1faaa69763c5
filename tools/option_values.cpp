#include "option_values.h"
#include "exits.h"
#include <charconv>
#include <cmath>

namespace bough {
namespace {

ValueCheck number_check(const char* expected, bool (*accepts)(double)) {
    return [=](const std::string& text) {
        const std::optional<double> value = parse_number(text);
        return value && accepts(*value) ? std::string() : "is '" + text + "', expected " + expected;
    };
}

} // namespace

std::optional<double> parse_number(const std::string& text) {
    double value = 0;
    const char* first = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
    const char* last = text.data() + text.size();
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
    return value;
}

ValueCheck positive_number() {
    return number_check("a number above 0", [](double v) { return v > 0; });
}

ValueCheck not_negative_number() {
    return number_check("a number, 0 or more", [](double v) { return v >= 0; });
}

ValueCheck whole_number(std::int64_t least, std::int64_t most) {
    return [=](const std::string& text) {
        std::int64_t value = 0;
        const char* last = text.data() + text.size();
        const auto [end, error] = std::from_chars(text.data(), last, value);
        if (error == std::errc() && end == last && value >= least && value <= most) return std::string();
        return "is '" + text + "', expected a whole number from " + std::to_string(least) +
               (most == INT64_MAX && error != std::errc::result_out_of_range ? "" : " to " + std::to_string(most));
    };
}

ValueCheck file_name() {
    return [](const std::string& text) -> std::string {
        if (text.size() > 1 && text[0] == '-')
            return "is '" + text + "', which looks like an option (write ./" + text + " for a file of that name)";
        return {};
    };
}

std::vector<std::string> split_list(const std::string& text) {
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == ',')
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

std::vector<double> number_list(const std::string& option, const std::string& text, std::size_t count) {
    std::vector<double> values;
    for (const std::string& part : split_list(text)) {
        const std::optional<double> value = parse_number(part);
        if (!value) break;
        values.push_back(*value);
    }
    if (values.size() != count || split_list(text).size() != count)
        throw UsageError(option + " is '" + text + "', expected " +
                         (count == 1 ? "a number" : std::to_string(count) + " numbers parted by commas"));
    return values;
}

} // namespace bough
