#include "speedtree_fields.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <limits>

namespace bough::speedtree {
namespace {

std::optional<double> comma_number(std::string_view token) {
    return parse_number(token, true);
}

} // namespace

std::size_t Fields::offset(const pugi::xml_node& node) const {
    return begin_ + std::size_t(std::max(std::ptrdiff_t(0), node.offset_debug()));
}

std::size_t Fields::line(const pugi::xml_node& node) const {
    return line_of(content_, offset(node));
}

void Fields::refuse(const pugi::xml_node& node, const std::string& message) const {
    refuse(node.name(), offset(node), message);
}

void Fields::refuse(const char* element, std::size_t offset, const std::string& message) const {
    throw InputError(file_line(name_, line_of(content_, offset)), std::string("<") + element + "> " + message);
}

template <class T, class Parse>
T Fields::attribute(const pugi::xml_node& node, const char* attribute, const char* what, Parse parse) const {
    const pugi::xml_attribute found = node.attribute(attribute);
    if (!found) refuse(node, std::string("has no ") + attribute + ", expected " + what);
    const auto value = parse(trimmed(found.value()));
    if (!value) refuse(node, std::string(attribute) + " is " + in_ascii_quotes(found.value()) + ", expected " + what);
    return T(*value);
}

double Fields::number(const pugi::xml_node& node, const char* name) const {
    return attribute<double>(node, name, "a finite number", comma_number);
}

double Fields::number(const pugi::xml_node& node, const char* name, double fallback) const {
    return node.attribute(name) ? number(node, name) : fallback;
}

std::int64_t Fields::integer(const pugi::xml_node& node, const char* name) const {
    return attribute<std::int64_t>(node, name, "an integer", parse_integer);
}

std::int64_t Fields::integer(const pugi::xml_node& node, const char* name, std::int64_t fallback) const {
    return node.attribute(name) ? integer(node, name) : fallback;
}

Vec3 Fields::vector(const pugi::xml_node& node, const char* prefix) const {
    const std::string p(prefix);
    return {number(node, (p + "X").c_str()), number(node, (p + "Y").c_str()), number(node, (p + "Z").c_str())};
}

Vec3 Fields::vector(const pugi::xml_node& node, const char* prefix, const Vec3& fallback) const {
    const std::string p(prefix);
    return {number(node, (p + "X").c_str(), fallback.x()), number(node, (p + "Y").c_str(), fallback.y()),
            number(node, (p + "Z").c_str(), fallback.z())};
}

template <class T, class Parse>
std::vector<T> Fields::list(const pugi::xml_node& parent, const char* child, const char* what, Parse parse) const {
    const pugi::xml_node node = parent.child(child);
    const std::string_view text = node.child_value();
    std::vector<T> values;
    values.reserve(text.size() / 8);
    std::size_t at = 0;
    for (std::string_view token = next_token(text, at); !token.empty(); token = next_token(text, at)) {
        const auto value = parse(token);
        if (!value) {
            const std::size_t lines = std::size_t(std::count(text.data(), token.data(), '\n'));
            throw InputError(file_line(name_, line(node.first_child()) + lines),
                             std::string("<") + parent.name() + "> " + child + " holds " + in_ascii_quotes(token) +
                                 ", expected " + what);
        }
        values.push_back(*value);
    }
    return values;
}

std::vector<double> Fields::numbers(const pugi::xml_node& parent, const char* child) const {
    return list<double>(parent, child, "finite numbers", comma_number);
}

std::vector<std::int64_t> Fields::integers(const pugi::xml_node& parent, const char* child) const {
    return list<std::int64_t>(parent, child, "integers", parse_integer);
}

std::vector<float> Fields::floats(const pugi::xml_node& parent, const char* child) const {
    const auto single = [](std::string_view token) -> std::optional<float> {
        const std::optional<double> value = comma_number(token);
        if (!value || std::abs(*value) > double(std::numeric_limits<float>::max())) return {};
        return float(*value);
    };
    return list<float>(parent, child, "finite numbers", single);
}

std::vector<std::int32_t> Fields::indices(const pugi::xml_node& parent, const char* child, std::size_t end,
                                          const char* things) const {
    const std::string what = end == 0 ? std::string("none, as there are no ") + things
                                      : "0 to " + std::to_string(end - 1) + " (" + things + ")";
    const auto index = [end](std::string_view token) -> std::optional<std::int32_t> {
        const std::optional<std::int64_t> value = parse_integer(token);
        if (!value || *value < 0 || std::size_t(*value) >= end) return {};
        return std::int32_t(*value);
    };
    return list<std::int32_t>(parent, child, what.c_str(), index);
}

std::vector<Vec3> Fields::points(const pugi::xml_node& parent, const char* prefix) const {
    const std::string p(prefix);
    const std::string child[3] = {p + "X", p + "Y", p + "Z"};
    std::vector<double> part[3];
    for (int k = 0; k < 3; ++k) {
        if (!parent.child(child[k].c_str())) refuse(parent, "has no " + child[k] + ", expected a list of numbers");
        part[k] = numbers(parent, child[k].c_str());
        expect_length(parent, child[k].c_str(), part[k].size(), part[0].size());
    }
    std::vector<Vec3> points(part[0].size());
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = {part[0][i], part[1][i], part[2][i]};
    return points;
}

void Fields::expect_length(const pugi::xml_node& parent, const char* child, std::size_t found,
                           std::size_t expected) const {
    if (found == expected) return;
    refuse(parent, std::string(child) + " holds " + counted(found, "value", "values") + ", expected " +
                       std::to_string(expected));
}

} // namespace bough::speedtree
