#include "document_parts.h"
#include "formats/nearest_name.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include <algorithm>

namespace bough {
namespace {

// What a document of another kind is good for, for someone who gave it to the wrong tool.
std::string advice(const std::string& found, const std::string& expected) {
    if (found == "bough-splines" && expected == "bough-tree") return ": run treeconvert on it first";
    if (found == "bough-scene" && expected == "bough-tree") return ": a scene names its trees itself, give it alone";
    if (found == "bough-tree" && expected == "bough-splines") return ": it has been through treeconvert already";
    return "";
}

// In one line and of bounded length, whatever the file holds.
std::string shown(std::string_view text) {
    constexpr std::size_t most = 60;
    std::string result;
    for (char c : text.substr(0, most)) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            result += '?';
        else
            result += c;
    }
    return text.size() > most ? result + "..." : result;
}

void check_length(const Field& field, const Array& array, const std::string& name, const std::string& at) {
    const std::size_t components = array.components;
    const std::string each = components == 1 ? "one for each " : std::to_string(components) + " for each ";
    const std::string place = name + ": " + pointer(at, field.name);
    const std::string has = "has " + counted(field.numbers, "number", "numbers") + ", expected ";
    if (!array.per.count) {
        if (field.numbers % components != 0)
            throw InputError(place, has + "a multiple of " + std::to_string(components));
        return;
    }
    const std::size_t expected = components * array.per.count();
    if (field.numbers == expected) return;
    const std::string wanted = std::to_string(expected) + " (" + each + array.per.what + ")";
    throw InputError(place, field.seen ? has + wanted : "is missing, expected " + wanted);
}

} // namespace

std::string pointer(const std::string& at, std::string_view key) {
    std::string escaped;
    for (char c : shown(key)) {
        if (c == '~')
            escaped += "~0";
        else if (c == '/')
            escaped += "~1";
        else
            escaped += c;
    }
    return at + "/" + escaped;
}

std::string in_quotes(std::string_view text) {
    return std::string("\"").append(shown(text)).append("\"");
}

std::vector<std::string> names(const std::vector<Field>& fields) {
    std::vector<std::string> result;
    for (const Field& field : fields) result.push_back(field.name);
    return result;
}

void unknown_field(const std::string& name, const std::string& at, std::string_view key,
                   const std::vector<std::string>& known) {
    const std::string nearest =
        key.size() > 64 ? std::string() : nearest_name(key, known, std::min<std::size_t>(key.size() / 2, 3));
    std::string expected;
    if (!nearest.empty()) {
        expected = "did you mean " + in_quotes(nearest) + "?";
    } else {
        expected = "expected one of ";
        for (const std::string& candidate : known) expected += (&candidate == &known.front() ? "" : ", ") + candidate;
    }
    throw InputError(name + ": " + pointer(at, key), "is an unknown field, " + expected);
}

void missing_field(const std::string& name, const std::string& at, const std::string& field) {
    throw InputError(name + ": " + pointer(at, field), "is missing");
}

void check_format(const std::string& name, const std::string& format, const DocumentType& type) {
    if (format == type.format) return;
    const bool ours = format.rfind("bough-", 0) == 0;
    if (ours && format.size() < 32)
        throw InputError(name,
                         "is a " + shown(format) + " document, expected " + type.format + advice(format, type.format));
    throw InputError(name + ": /format", "is " + in_quotes(format) + ", expected " + in_quotes(type.format));
}

void check_version(const std::string& name, std::int64_t version, const DocumentType& type) {
    if (version == type.version) return;
    const std::string number = std::to_string(version), ours = std::to_string(type.version);
    if (version > type.version)
        throw InputError(name + ": /version", "is " + number + ", newer than this program, which reads " + ours);
    throw InputError(name + ": /version", "is " + number + ", expected " + ours);
}

bool is_binary(std::string_view content, const std::string& name, const DocumentType& type) {
    const std::string expected = std::string(", expected a ") + type.format + " document";
    const std::size_t start = text_start(content);
    const bool binary = looks_binary(content);
    if (start == content.size()) throw InputError(name, "is empty" + expected);
    if (!binary && content[start] != '{') throw InputError(name, "is neither JSON nor safetensors" + expected);
    if (const std::string format = document_format(content); !format.empty()) check_format(name, format, type);
    return binary;
}

void check_complete(std::vector<Field>& fields, const std::string& name, const std::string& at) {
    for (Field& field : fields) {
        if (field.required && !field.seen) missing_field(name, at, field.name);
        Array* array = std::get_if<Array>(&field.value);
        if (array && !field.seen && array->fill)
            array->fill(array->per.count ? array->per.count() : 0);
        else if (array)
            check_length(field, *array, name, at);
    }
}

} // namespace bough
