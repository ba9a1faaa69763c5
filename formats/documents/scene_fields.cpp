#include "scene_fields.h"
#include "formats/nearest_name.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <limits>

namespace bough {
namespace {

using nlohmann::json;

std::string kind_of_value(const json& value) {
    if (value.is_string()) return in_quotes(value.get_ref<const std::string&>());
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    return value.dump();
}

} // namespace

ObjectReader::ObjectReader(const json& value, const std::string& name, const std::string& at)
    : value_(value), name_(name), at_(at) {
    if (!value.is_object())
        throw InputError(name + (at.empty() ? "" : ": " + at), "is " + kind_of_value(value) + ", expected an object");
}

const json* ObjectReader::find(const std::string& key) {
    known_.push_back(key);
    const auto found = value_.find(key);
    return found == value_.end() ? nullptr : &*found;
}

bool ObjectReader::has(const std::string& key) {
    return find(key) != nullptr;
}

const json& ObjectReader::need(const std::string& key) {
    const json* value = find(key);
    if (value) return *value;
    for (const auto& [other, there] : value_.items()) // misspelt, it is there under another name
        if (std::find(known_.begin(), known_.end(), other) == known_.end() && !nearest_name(other, {key}, 2).empty())
            unknown_field(name_, at_, other, {key});
    missing_field(name_, at_, key);
}

void ObjectReader::fail(const std::string& key, const std::string& message) const {
    throw InputError(name_ + ": " + at(key), message);
}

double ObjectReader::real(const json& value, const std::string& key) const {
    if (!value.is_number()) fail(key, "is " + kind_of_value(value) + ", expected a number");
    return value.get<double>();
}

void ObjectReader::read(const std::string& key, double& to) {
    if (const json* value = find(key)) to = real(*value, key);
}

void ObjectReader::read(const std::string& key, std::int64_t& to) {
    const json* value = find(key);
    if (!value) return;
    const bool fits = value->is_number_integer() &&
                      (!value->is_number_unsigned() ||
                       value->get<std::uint64_t>() <= std::uint64_t(std::numeric_limits<std::int64_t>::max()));
    if (!fits) fail(key, "is " + kind_of_value(*value) + ", expected an integer");
    to = value->get<std::int64_t>();
}

void ObjectReader::read(const std::string& key, std::int32_t& to) {
    std::int64_t wide = to;
    read(key, wide);
    if (wide != std::int32_t(wide)) fail(key, "is " + std::to_string(wide) + ", expected an integer of 32 bits");
    to = std::int32_t(wide);
}

void ObjectReader::read(const std::string& key, std::uint64_t& to) {
    const json* value = find(key);
    if (!value) return;
    if (!value->is_number_unsigned()) fail(key, "is " + kind_of_value(*value) + ", expected an integer, 0 or more");
    to = value->get<std::uint64_t>();
}

void ObjectReader::read(const std::string& key, bool& to) {
    const json* value = find(key);
    if (!value) return;
    if (!value->is_boolean()) fail(key, "is " + kind_of_value(*value) + ", expected true or false");
    to = value->get<bool>();
}

void ObjectReader::read(const std::string& key, std::string& to) {
    const json* value = find(key);
    if (!value) return;
    if (!value->is_string()) fail(key, "is " + kind_of_value(*value) + ", expected text");
    to = value->get<std::string>();
}

void ObjectReader::read(const std::string& key, Vec3& to) {
    std::vector<double> numbers(to.data(), to.data() + 3);
    read(key, numbers);
    if (numbers.size() != 3)
        fail(key, "has " + counted(numbers.size(), "number", "numbers") + ", expected 3 (x, y, z)");
    to = Vec3(numbers[0], numbers[1], numbers[2]);
}

void ObjectReader::read(const std::string& key, std::vector<double>& to) {
    const json* value = find(key);
    if (!value) return;
    if (!value->is_array()) fail(key, "is " + kind_of_value(*value) + ", expected an array of numbers");
    std::vector<double> numbers;
    for (const json& entry : *value) {
        if (!entry.is_number())
            throw InputError(name_ + ": " + at(key) + "/" + std::to_string(numbers.size()),
                             "is " + kind_of_value(entry) + ", expected a number");
        numbers.push_back(entry.get<double>());
    }
    to = std::move(numbers);
}

bool ObjectReader::read_rows(const std::string& key, const std::vector<std::string>& parts,
                             std::vector<double>& numbers) {
    const json* value = find(key);
    if (!value) return false;
    std::string names;
    for (const std::string& part : parts) names += (names.empty() ? "" : ", ") + part;
    const std::string width = std::to_string(parts.size());
    if (!value->is_array()) fail(key, "is " + kind_of_value(*value) + ", expected an array of [" + names + "]");
    numbers.clear();
    if (!value->empty() && value->front().is_array()) {
        std::size_t row = 0;
        for (const json& entry : *value) {
            // Each row as a field of its own, so that its errors have its place.
            const std::string place = std::to_string(row++);
            const json part{{place, entry}};
            std::vector<double> found;
            ObjectReader reader(part, name_, at(key));
            reader.read(place, found);
            if (found.size() != parts.size())
                reader.fail(place, "has " + counted(found.size(), "number", "numbers") + ", expected " + width + " (" +
                                       names + ")");
            numbers.insert(numbers.end(), found.begin(), found.end());
        }
        return true;
    }
    read(key, numbers);
    if (numbers.size() % parts.size() != 0)
        fail(key, "has " + counted(numbers.size(), "number", "numbers") + ", expected a multiple of " + width + " (" +
                      names + ")");
    return true;
}

void ObjectReader::read(const std::string& key, std::vector<Vec3>& to) {
    std::vector<double> n;
    if (!read_rows(key, {"x", "y", "z"}, n)) return;
    to.clear();
    for (std::size_t i = 0; i < n.size(); i += 3) to.emplace_back(n[i], n[i + 1], n[i + 2]);
}

void ObjectReader::read(const std::string& key, std::vector<Quat>& to) {
    std::vector<double> n;
    if (!read_rows(key, {"x", "y", "z", "w"}, n)) return;
    to.clear();
    for (std::size_t i = 0; i < n.size(); i += 4) to.emplace_back(n[i + 3], n[i], n[i + 1], n[i + 2]);
}

std::size_t ObjectReader::word(const std::string& key, const std::vector<std::string>& words, std::size_t fallback) {
    std::string text = words[fallback];
    read(key, text);
    const auto found = std::find(words.begin(), words.end(), text);
    if (found != words.end()) return std::size_t(found - words.begin());
    std::string expected;
    for (const std::string& word : words) expected += (expected.empty() ? "" : ", ") + word;
    fail(key, "is " + in_quotes(text) + ", expected one of " + expected);
}

const json& ObjectReader::list(const std::string& key) {
    static const json empty = json::array();
    const json* value = find(key);
    if (value && !value->is_array()) fail(key, "is " + kind_of_value(*value) + ", expected an array");
    return value ? *value : empty;
}

void ObjectReader::finish() {
    for (const auto& [key, value] : value_.items())
        if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
            std::sort(known_.begin(), known_.end());
            known_.erase(std::unique(known_.begin(), known_.end()), known_.end());
            unknown_field(name_, at_, key, known_);
        }
}

} // namespace bough
