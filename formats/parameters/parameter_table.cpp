#include "parameter_table.h"
#include "formats/nearest_name.h"
#include "formats/plain_text.h"
#include <algorithm>
#include <cmath>

namespace bough {

namespace {

std::string range(double least, double most) {
    if (std::isinf(most)) return std::isinf(least) ? "a number" : "at least " + shown(least);
    return shown(least) + " to " + shown(most);
}

} // namespace

void ParameterTable::add(const std::string& name, ParameterValue value) {
    const std::size_t line = value.line;
    if (!values_.emplace(name, std::move(value)).second)
        throw InputError(file_line(file_, line), in_ascii_quotes(name) + " is there twice, expected once");
}

bool ParameterTable::is_list(const std::string& name) const {
    const auto at = values_.find(name);
    return at != values_.end() && at->second.kind == ParameterValue::Kind::list;
}

const ParameterValue* ParameterTable::find(const std::string& name) {
    asked_.insert(name);
    const auto at = values_.find(name);
    return at == values_.end() ? nullptr : &at->second;
}

void ParameterTable::refuse(const std::string& name, const std::string& expected) const {
    const auto at = values_.find(name);
    if (at == values_.end()) throw InputError(file_, name + ": is missing, expected " + expected);
    throw InputError(file_line(file_, at->second.line),
                     name + ": is " + in_ascii_quotes(at->second.text) + ", expected " + expected);
}

double ParameterTable::number(const std::string& name, double fallback, double least, double most) {
    const ParameterValue* value = find(name);
    if (!value) return fallback;
    const auto written = value->kind == ParameterValue::Kind::text ? parse_number(trimmed(value->text)) : std::nullopt;
    if (value->kind != ParameterValue::Kind::number && !written)
        refuse(name, "a number, " + range(least, most) + ", with a decimal point");
    const double result = written ? *written : value->numbers[0];
    if (!(result >= least && result <= most)) refuse(name, range(least, most));
    return result;
}

int ParameterTable::whole(const std::string& name, int fallback, int least, int most) {
    const double result = number(name, fallback, least, most);
    if (result != std::floor(result)) refuse(name, "a whole number, " + range(least, most));
    return static_cast<int>(result);
}

bool ParameterTable::flag(const std::string& name, bool fallback) {
    const ParameterValue* value = find(name);
    if (!value) return fallback;
    const bool number =
        value->kind == ParameterValue::Kind::number && (value->numbers[0] == 0 || value->numbers[0] == 1);
    if (value->kind != ParameterValue::Kind::flag && !number) refuse(name, "true or false");
    return value->numbers[0] != 0;
}

std::string ParameterTable::text(const std::string& name, const std::string& fallback) {
    const ParameterValue* value = find(name);
    if (!value) return fallback;
    if (value->kind != ParameterValue::Kind::text) refuse(name, "text");
    return value->text;
}

std::array<double, 4> ParameterTable::four(const std::string& name, const std::array<double, 4>& fallback, double least,
                                           double most, int grown, bool whole) {
    const ParameterValue* value = find(name);
    if (!value) return fallback;
    if (value->kind != ParameterValue::Kind::list || value->numbers.size() != 4) refuse(name, "a list of 4 numbers");
    std::array<double, 4> result{};
    for (int n = 0; n < 4; ++n) {
        const double v = result[std::size_t(n)] = value->numbers[std::size_t(n)];
        if (n < grown && (!(v >= least && v <= most) || (whole && v != std::floor(v))))
            refuse(name, std::string(whole ? "whole numbers, " : "") + range(least, most) + " for level " +
                             std::to_string(n));
    }
    return result;
}

std::vector<double> ParameterTable::three(const std::string& name, const std::array<double, 3>& fallback, double least,
                                          double most) {
    const ParameterValue* value = find(name);
    if (!value) return {fallback.begin(), fallback.end()};
    if (value->kind != ParameterValue::Kind::list || value->numbers.size() != 3) refuse(name, "a list of 3 numbers");
    for (const double v : value->numbers)
        if (!(v >= least && v <= most)) refuse(name, "numbers " + range(least, most));
    return value->numbers;
}

std::string ParameterTable::known(std::initializer_list<const char*> names) {
    std::string there;
    for (const char* name : names)
        if (find(name)) there += (there.empty() ? "" : ", ") + std::string(name);
    return there;
}

void ParameterTable::not_honoured(std::initializer_list<const char*> names, const std::string& reason,
                                  std::vector<std::string>& notes) {
    std::string there;
    for (const char* name : names) {
        const ParameterValue* value = find(name);
        if (!value) continue;
        const bool nothing =
            value->kind == ParameterValue::Kind::text
                ? value->text.empty() || parse_number(trimmed(value->text)) == 0.0
                : std::all_of(value->numbers.begin(), value->numbers.end(), [](double v) { return v == 0; });
        if (!nothing) there += (there.empty() ? "" : ", ") + std::string(name);
    }
    if (!there.empty()) notes.push_back(there + " (" + reason + ")");
}

void ParameterTable::finish() const {
    for (const auto& [name, value] : values_) {
        if (asked_.count(name)) continue;
        const std::string nearest = nearest_name(name, {asked_.begin(), asked_.end()}, name.size() + 100);
        throw InputError(file_line(file_, value.line),
                         "unknown parameter " + in_ascii_quotes(name) + ", the nearest known one is " + nearest);
    }
}

} // namespace bough
