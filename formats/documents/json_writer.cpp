#include "document_parts.h"
#include <array>

namespace bough {
namespace {

constexpr const char* minus_zero = "-0.0"; // "-0" would be read as an integer, which has no such zero
constexpr std::size_t numbers_a_line = 12; // whole entries a line of a document: 12 numbers, 4 vectors, 3 quaternions

template <class T> void append_digits(std::string& to, T value) {
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    to.append(digits.data(), end);
}

// The array as flat numbers, a line end before each `numbers_a_line` of them where `lines` is set.
void write_array(Output& output, const std::string& field, const Array& array, bool lines, const Digits& digits) {
    Text text(output);
    Numbers numbers;
    std::size_t index = 0, in_line = 0;
    const auto add_all = [&](const auto& values) {
        for (const auto value : values) {
            if (index++ > 0) text.put(',');
            if (lines && in_line-- == 0) {
                text.put('\n');
                in_line = numbers_a_line - 1;
            }
            text.add_json(value, digits);
            text.room();
        }
    };
    text.put('[');
    const std::size_t entries = array.entries();
    for (std::size_t first = 0; first < entries; first += block_entries) {
        array.get(first, std::min(block_entries, entries - first), numbers);
        require_finite(output, field, numbers.reals, first * array.components);
        add_all(numbers.reals);
        add_all(numbers.integers);
    }
    text.put(']');
    text.hand_on();
}

std::string checked_text(const Output& output, const Field& field) {
    if (auto* number = std::get_if<double*>(&field.value); number && !std::isfinite(**number))
        throw OutputError(output.name(), "/" + field.name + " is not finite, and documents hold finite numbers only");
    return value_text(field);
}

void write_objects(Output& output, const Objects& objects) {
    const std::size_t count = objects.count();
    output.write("[");
    for (std::size_t i = 0; i < count; ++i) {
        output.write(i == 0 ? "\n" : ",\n");
        write_json_line(output, nullptr, objects.at(i));
    }
    output.write(count == 0 ? "]" : "\n]");
}

// "a": ..., "b": ... with `separator` between them.
void write_fields(Output& output, const DocumentType* type, const std::vector<Field>& fields, const char* separator,
                  bool lines, const Digits& digits) {
    const char* before = "";
    if (type) {
        output.write("\"format\": \"" + std::string(type->format) + "\"" + separator);
        output.write("\"version\": " + std::to_string(type->version));
        before = separator;
    }
    for (const Field& field : fields) {
        if (is_left_out(field)) continue;
        output.write(std::exchange(before, separator));
        output.write("\"" + field.name + "\": ");
        if (const Array* array = std::get_if<Array>(&field.value))
            write_array(output, field.name, *array, lines, digits);
        else if (const Objects* objects = std::get_if<Objects>(&field.value))
            write_objects(output, *objects);
        else
            output.write(checked_text(output, field));
    }
}

} // namespace

void append_number(std::string& to, double value) {
    if (value == 0 && std::signbit(value))
        to += minus_zero;
    else
        append_digits(to, value);
}

void append_number(std::string& to, float value) {
    if (value == 0 && std::signbit(value))
        to += minus_zero;
    else
        append_digits(to, value);
}

void append_string(std::string& to, std::string_view text) {
    to += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

bool is_left_out(const Field& field) {
    if (field.required) return false;
    if (const Array* array = std::get_if<Array>(&field.value)) return array->entries() == 0;
    if (auto* text = std::get_if<std::string*>(&field.value)) return (*text)->empty();
    if (auto* words = std::get_if<std::vector<std::string>*>(&field.value)) return (*words)->empty();
    return false;
}

std::string value_text(const Field& field) {
    std::string text;
    if (auto* real = std::get_if<double*>(&field.value)) append_number(text, **real);
    if (auto* narrow = std::get_if<std::int32_t*>(&field.value)) append_digits(text, **narrow);
    if (auto* wide = std::get_if<std::int64_t*>(&field.value)) append_digits(text, **wide);
    if (auto* string = std::get_if<std::string*>(&field.value)) append_string(text, **string);
    if (auto* strings = std::get_if<std::vector<std::string>*>(&field.value)) {
        text = "[";
        for (const std::string& entry : **strings) {
            if (text.size() > 1) text += ',';
            append_string(text, entry);
        }
        text += "]";
    }
    return text;
}

void write_json(Output& output, const DocumentType& type, const std::vector<Field>& fields) {
    output.write("{\n");
    write_fields(output, &type, fields, ",\n", true, {});
    output.write("\n}\n");
}

void write_json_line(Output& output, const DocumentType* type, const std::vector<Field>& fields, const Digits& digits) {
    output.write("{");
    write_fields(output, type, fields, ", ", false, digits);
    output.write("}");
}

} // namespace bough
