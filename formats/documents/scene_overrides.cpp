#include "formats/plain_text.h"
#include "scene_parts.h"
#include <algorithm>
#include <stdexcept>

namespace bough {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

bool is_number(const std::string& part) {
    if (part.empty() || part.size() > 9 || (part[0] == '0' && part.size() > 1)) return false;
    return std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string pointer_of(const SceneOverride& change) {
    std::string at;
    for (const std::string& part : change.path) at = pointer(at, part);
    return at;
}

// Where `part` of a value stands; made if it is not there.
json& step_into(json& value, const std::string& at, const std::string& part, const SceneOverride& change) {
    if (value.is_null()) value = is_number(part) ? json::array() : json::object();
    if (at == "/wind" && value.is_string())
        if (const std::optional<Wind> preset = wind_preset(value.get<std::string>())) value = json(value_of(*preset));
    if (value.is_object()) return value[part];
    if (!value.is_array())
        throw InputError(change.given + ": " + at,
                         "is " + text_of(ordered_json(value)) + ", which has no field " + in_quotes(part));
    const std::size_t size = value.size();
    if (!is_number(part) || std::stoull(part) > size)
        throw InputError(change.given + ": " + pointer(at, part), "is no element of a list of " + std::to_string(size) +
                                                                      ", expected 0 to " + std::to_string(size) +
                                                                      " (the last of them adds one)");
    const auto index = std::size_t(std::stoull(part));
    if (index == size) value.push_back(nullptr);
    return value[index];
}

std::vector<std::string> parts_of(const std::string& at) {
    std::vector<std::string> parts;
    for (const char c : at) {
        if (c == '/')
            parts.emplace_back();
        else if (!parts.empty())
            parts.back() += c;
    }
    return parts;
}

} // namespace

SceneOverride parse_override(const std::string& option, const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
        throw std::invalid_argument("is '" + text + "', expected PATH=VALUE, such as wind.velocity=[8,0,0]");
    std::string shown = text;
    for (std::size_t k = equals; k < shown.size(); ++k)
        if (is_blank(shown[k])) shown[k] = ' ';
    if (valid_utf8(shown) != shown)
        throw std::invalid_argument("is '" + valid_utf8(shown) +
                                    "', which holds bytes that are no text; expected UTF-8");
    SceneOverride change{option + " " + text, {""}, text.substr(equals + 1)};
    for (const char c : text.substr(0, equals)) {
        if (c == '.')
            change.path.emplace_back();
        else
            change.path.back() += c;
    }
    if (std::any_of(change.path.begin(), change.path.end(), [](const std::string& part) { return part.empty(); }))
        throw std::invalid_argument("is '" + text +
                                    "', whose path has an empty part; expected names with points "
                                    "between them, such as wind.velocity");
    if (change.value.empty())
        throw std::invalid_argument("is '" + text + "', expected a value behind the =; \"\" is an empty text");
    return change;
}

void override_field(json& document, const SceneOverride& change) {
    json* field = &document;
    std::string at;
    for (const std::string& part : change.path) {
        field = &step_into(*field, at, part, change);
        at = pointer(at, part);
    }
    *field = json::accept(change.value) ? parse_json(change.value, change.given, at) : json(change.value);
}

const SceneOverride& nearest_override(const std::vector<SceneOverride>& changes, const std::string& at) {
    const std::vector<std::string> place = parts_of(at);
    const SceneOverride* nearest = &changes.back();
    std::size_t most = 0;
    for (const SceneOverride& change : changes) {
        const std::vector<std::string> path = parts_of(pointer_of(change));
        const auto differ = std::mismatch(path.begin(), path.end(), place.begin(), place.end());
        const auto same = std::size_t(differ.first - path.begin());
        if (same == 0 || same < most) continue; // of equal ones the last, which had the last word
        most = same;
        nearest = &change;
    }
    return *nearest;
}

} // namespace bough
