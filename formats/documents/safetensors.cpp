#include "document_parts.h"
#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

namespace bough {
namespace {

using nlohmann::json;
static_assert(std::endian::native == std::endian::little, "arrays are written and read as they lie in memory");

constexpr std::size_t prefix = 8; // bytes of the header's length

std::string tensor_place(const std::string& name, const std::string& field, const char* part = "") {
    return name + ": " + pointer("", field) + part;
}

// Bytes of one element, 0 for a dtype that the layout does not know.
std::uint64_t element_size(const std::string& dtype) {
    if (dtype == "F64" || dtype == "I64" || dtype == "U64") return 8;
    if (dtype == "F32" || dtype == "I32" || dtype == "U32") return 4;
    if (dtype == "F16" || dtype == "BF16" || dtype == "I16" || dtype == "U16") return 2;
    if (dtype == "I8" || dtype == "U8" || dtype == "BOOL") return 1;
    return 0;
}

std::vector<std::uint64_t> sizes(const json& entry, const char* key, const std::string& place) {
    const auto found = entry.find(key);
    if (found == entry.end()) throw InputError(place + "/" + key, "is missing");
    const std::string expected = "expected an array of integers, 0 or more";
    if (!found->is_array()) throw InputError(place + "/" + key, "is not an array, " + expected);
    std::vector<std::uint64_t> result;
    for (const json& value : *found) {
        if (!value.is_number_unsigned())
            throw InputError(place + "/" + key + "/" + std::to_string(result.size()),
                             "is " + in_quotes(value.dump()) + ", " + expected);
        result.push_back(value.get<std::uint64_t>());
    }
    return result;
}

std::uint64_t byte_count(const Tensor& tensor, const std::string& place) {
    std::uint64_t bytes = element_size(tensor.dtype);
    if (bytes == 0)
        throw InputError(place + "/dtype", "is " + in_quotes(tensor.dtype) + ", expected F64, I64, I32 or U8");
    if (std::find(tensor.shape.begin(), tensor.shape.end(), 0u) != tensor.shape.end()) return 0;
    for (const std::uint64_t extent : tensor.shape)
        if (__builtin_mul_overflow(bytes, extent, &bytes))
            throw InputError(place + "/shape", "is larger than any file");
    return bytes;
}

// data_begin, data_size: [bytes] of what follows the header.
Tensor parse_tensor(const std::string& name, const std::string& key, const json& entry, std::uint64_t data_begin,
                    std::uint64_t data_size) {
    const std::string place = tensor_place(name, key);
    if (!entry.is_object()) throw InputError(place, "is not an object, expected dtype, shape and data_offsets");
    for (const auto& [part, value] : entry.items())
        if (part != "dtype" && part != "shape" && part != "data_offsets")
            unknown_field(name, pointer("", key), part, {"dtype", "shape", "data_offsets"});
    Tensor tensor;
    if (!entry.contains("dtype")) throw InputError(place + "/dtype", "is missing");
    if (!entry["dtype"].is_string()) throw InputError(place + "/dtype", "is not text, expected F64, I64, I32 or U8");
    tensor.dtype = entry["dtype"].get<std::string>();
    tensor.shape = sizes(entry, "shape", place);
    tensor.bytes = byte_count(tensor, place);
    const auto offsets = sizes(entry, "data_offsets", place);
    if (offsets.size() != 2 || offsets[0] > offsets[1])
        throw InputError(place + "/data_offsets", "is no range, expected [begin, end]");
    if (offsets[1] > data_size)
        throw InputError(place + "/data_offsets", "ends at byte " + std::to_string(offsets[1]) +
                                                      " of the data, which has " + std::to_string(data_size) +
                                                      ": is the file whole?");
    if (offsets[1] - offsets[0] != tensor.bytes)
        throw InputError(place + "/data_offsets", "hold " + std::to_string(offsets[1] - offsets[0]) +
                                                      " bytes, expected " + std::to_string(tensor.bytes) +
                                                      " for its shape");
    tensor.begin = data_begin + offsets[0];
    return tensor;
}

// The arrays must fill the data: each byte belongs to exactly one.
void check_layout(const std::string& name, const Safetensors& file, std::uint64_t data_begin, std::uint64_t data_size) {
    std::vector<std::pair<std::uint64_t, const std::string*>> begins;
    for (const auto& [key, tensor] : file.tensors) begins.emplace_back(tensor.begin - data_begin, &key);
    std::sort(begins.begin(), begins.end(), [&](const auto& a, const auto& b) {
        const std::uint64_t end_a = a.first + file.tensors.at(*a.second).bytes;
        return std::pair(a.first, end_a) < std::pair(b.first, b.first + file.tensors.at(*b.second).bytes);
    });
    std::uint64_t end = 0;
    for (const auto& [begin, key] : begins) {
        if (begin != end)
            throw InputError(tensor_place(name, *key, "/data_offsets"),
                             "begin at " + std::to_string(begin) +
                                 (begin < end ? ", inside another array" : ", after a gap") + ", expected " +
                                 std::to_string(end));
        end = begin + file.tensors.at(*key).bytes;
    }
    if (end != data_size)
        throw InputError(name, "has " + std::to_string(data_size - end) + " bytes after its last array, expected none");
}

// content: at least the header of a file of `size` bytes. data_begin: where it ends.
json parse_header(std::string_view content, std::uint64_t size, const std::string& name, std::uint64_t& data_begin) {
    if (size < prefix)
        throw InputError(name, "is " + std::to_string(size) + " bytes long, expected a safetensors header");
    if (std::size_t(size) != size)
        throw InputError(name,
                         "is " + std::to_string(size) + " bytes long, more than a program of 32 bits can address");
    std::uint64_t length = 0;
    std::memcpy(&length, content.data(), prefix);
    if (length > size - prefix)
        throw InputError(name, "has a header of " + std::to_string(length) +
                                   " bytes, longer than the file, which has " + std::to_string(size - prefix) +
                                   " after its length");
    data_begin = prefix + length;
    json header;
    try {
        header = parse_json(content.substr(prefix, std::size_t(length)), name);
    } catch (const InputError& e) {
        throw InputError(name, "in its safetensors header: " + std::string(e.what()).substr(name.size() + 1));
    }
    if (!header.is_object()) throw InputError(name, "has a safetensors header that is not an object");
    return header;
}

// `count` numbers from the tensor's number `first` on.
template <class T>
void take_numbers(const Tensor& tensor, const ReadBytes& read, std::size_t first, std::size_t count, Numbers& numbers) {
    const std::uint64_t at = tensor.begin + first * sizeof(T);
    if constexpr (std::is_same_v<T, double>) {
        numbers.reals.resize(count);
        read(at, count * sizeof(T), reinterpret_cast<char*>(numbers.reals.data()));
    } else {
        std::vector<T> values(count);
        read(at, count * sizeof(T), reinterpret_cast<char*>(values.data()));
        numbers.integers.assign(values.begin(), values.end());
    }
}

void read_array(Field& field, const Array& array, const Tensor& tensor, const ReadBytes& read,
                const std::string& name) {
    const bool flat = array.components == 1;
    check_tensor(name, field.name, tensor, array.dtype,
                 flat ? std::vector<std::int64_t>{-1} : std::vector<std::int64_t>{-1, std::int64_t(array.components)});
    field.numbers = std::size_t(tensor.bytes) / dtype_size(array.dtype);
    field.seen = true;
    array.start(field.numbers / array.components);
    Numbers numbers;
    const std::size_t block = block_entries * array.components;
    for (std::size_t first = 0; first < field.numbers; first += block) {
        const std::size_t count = std::min(block, field.numbers - first);
        if (array.dtype == Dtype::f64) {
            take_numbers<double>(tensor, read, first, count, numbers);
            check_finite(name, field.name, numbers.reals.data(), count, first);
        }
        if (array.dtype == Dtype::i64) take_numbers<std::int64_t>(tensor, read, first, count, numbers);
        if (array.dtype == Dtype::i32) take_numbers<std::int32_t>(tensor, read, first, count, numbers);
        if (array.dtype == Dtype::u8) take_numbers<std::uint8_t>(tensor, read, first, count, numbers);
        array.add(numbers);
    }
}

template <class T> void append_bytes(std::string& to, T value) {
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// The numbers as they lie in the file, replacing `bytes`.
template <class T, class From> void bytes_of(const std::vector<From>& numbers, std::string& bytes) {
    bytes.resize(numbers.size() * sizeof(T));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const T value = T(numbers[i]);
        std::memcpy(bytes.data() + i * sizeof(T), &value, sizeof(T));
    }
}

void write_array(Output& output, const Field& field, const Array& array) {
    Numbers numbers;
    std::string bytes;
    const std::size_t entries = array.entries();
    for (std::size_t first = 0; first < entries; first += block_entries) {
        array.get(first, std::min(block_entries, entries - first), numbers);
        if (array.dtype == Dtype::f64) {
            require_finite(output, field.name, numbers.reals, first * array.components);
            bytes_of<double>(numbers.reals, bytes);
        }
        if (array.dtype == Dtype::i64) bytes_of<std::int64_t>(numbers.integers, bytes);
        if (array.dtype == Dtype::i32) bytes_of<std::int32_t>(numbers.integers, bytes);
        if (array.dtype == Dtype::u8) bytes_of<std::uint8_t>(numbers.integers, bytes);
        output.write(bytes);
    }
}

} // namespace

const char* dtype_name(Dtype dtype) {
    switch (dtype) {
    case Dtype::f64:
        return "F64";
    case Dtype::i64:
        return "I64";
    case Dtype::i32:
        return "I32";
    case Dtype::u8:
        break;
    }
    return "U8";
}

std::size_t dtype_size(Dtype dtype) {
    return std::size_t(element_size(dtype_name(dtype)));
}

Safetensors parse_safetensors(std::string_view content, const std::string& name) {
    Safetensors file = parse_safetensors_header(content, content.size(), name);
    for (auto& [key, tensor] : file.tensors)
        tensor.data = content.substr(std::size_t(tensor.begin), std::size_t(tensor.bytes));
    return file;
}

Safetensors parse_safetensors_header(std::string_view content, std::uint64_t size, const std::string& name) {
    std::uint64_t data_begin = 0;
    const json header = parse_header(content, size, name, data_begin);
    const std::uint64_t data_size = size - data_begin;
    Safetensors file;
    for (const auto& [key, entry] : header.items()) {
        if (key != "__metadata__") {
            file.tensors[key] = parse_tensor(name, key, entry, data_begin, data_size);
            continue;
        }
        if (!entry.is_object()) throw InputError(name + ": /__metadata__", "is not an object, expected text by name");
        for (const auto& [field, value] : entry.items()) {
            if (!value.is_string()) throw InputError(name + ": " + pointer("/__metadata__", field), "is not text");
            file.metadata[field] = value.get<std::string>();
        }
    }
    check_layout(name, file, data_begin, data_size);
    return file;
}

void check_tensor(const std::string& name, const std::string& field, const Tensor& tensor, Dtype dtype,
                  const std::vector<std::int64_t>& shape) {
    if (tensor.dtype != dtype_name(dtype))
        throw InputError(tensor_place(name, field, "/dtype"), "is " + tensor.dtype + ", expected " + dtype_name(dtype));
    bool good = tensor.shape.size() == shape.size();
    for (std::size_t i = 0; good && i < shape.size(); ++i)
        good = shape[i] < 0 || tensor.shape[i] == std::uint64_t(shape[i]);
    if (good) return;
    std::string found, expected;
    for (const std::uint64_t extent : tensor.shape) found += (found.empty() ? "" : ", ") + std::to_string(extent);
    for (const std::int64_t extent : shape)
        expected += (expected.empty() ? "" : ", ") + (extent < 0 ? std::string("n") : std::to_string(extent));
    throw InputError(tensor_place(name, field, "/shape"),
                     "is [" + found.substr(0, 80) + "], expected [" + expected + "]");
}

void check_finite(const std::string& name, const std::string& field, const double* values, std::size_t count,
                  std::size_t first) {
    if (all_finite(values, count)) return;
    for (std::size_t i = 0; i < count; ++i)
        if (!std::isfinite(values[i]))
            throw InputError(name + ": " + pointer("", field) + "/" + std::to_string(first + i),
                             std::string("is ") + (std::isnan(values[i]) ? "NaN" : "infinite") +
                                 ", expected a finite number");
}

std::string safetensors_header(const std::vector<std::pair<std::string, std::string>>& metadata,
                               const std::vector<std::pair<std::string, Tensor>>& tensors) {
    std::string header = "{\"__metadata__\":{";
    for (const auto& [key, value] : metadata) {
        if (&key != &metadata.front().first) header += ',';
        append_string(header, key);
        header += ':';
        append_string(header, value);
    }
    header += '}';
    std::uint64_t offset = 0;
    for (const auto& [key, tensor] : tensors) {
        header += ",\"" + key + "\":{\"dtype\":\"" + tensor.dtype + "\",\"shape\":[";
        for (std::size_t i = 0; i < tensor.shape.size(); ++i)
            header += (i == 0 ? "" : ",") + std::to_string(tensor.shape[i]);
        header += "],\"data_offsets\":[" + std::to_string(offset) + "," + std::to_string(offset + tensor.bytes) + "]}";
        offset += tensor.bytes;
    }
    header += '}';
    header.append((8 - header.size() % 8) % 8, ' '); // so that the arrays after it are aligned
    std::string length;
    append_bytes(length, std::uint64_t(header.size()));
    return length + header;
}

std::vector<std::pair<std::string, std::string>> metadata_of(const DocumentType& type,
                                                             const std::vector<Field>& fields) {
    std::vector<std::pair<std::string, std::string>> metadata{{"format", type.format},
                                                              {"version", std::to_string(type.version)}};
    for (const Field& field : fields) {
        if (std::holds_alternative<Array>(field.value) || is_left_out(field)) continue;
        auto* text = std::get_if<std::string*>(&field.value);
        metadata.emplace_back(field.name, text ? **text : value_text(field));
    }
    return metadata;
}

void read_metadata(const Safetensors& file, const std::string& name, const DocumentType& type,
                   std::vector<Field>& fields) {
    const auto format = file.metadata.find("format");
    if (format == file.metadata.end()) missing_field(name, "/__metadata__", "format");
    check_format(name, format->second, type);
    std::int64_t version = 0;
    Field version_field{"version", &version};
    const auto read = [&](Field& field, const std::string& text) {
        const std::string at = pointer("/__metadata__", field.name);
        const bool plain = std::holds_alternative<std::string*>(field.value);
        assign(field, plain ? json(text) : parse_json(text, name + ": " + at), name, "/__metadata__");
        field.seen = true;
    };
    if (file.metadata.count("version") == 0) missing_field(name, "/__metadata__", "version");
    read(version_field, file.metadata.at("version"));
    check_version(name, version, type);

    for (const auto& [key, text] : file.metadata) {
        if (key == "format" || key == "version") continue;
        Field* found = nullptr;
        for (Field& field : fields)
            if (field.name == key && !std::holds_alternative<Array>(field.value)) found = &field;
        if (!found) unknown_field(name, "/__metadata__", key, names(fields));
        read(*found, text);
    }
}

void read_safetensors(const Safetensors& file, const ReadBytes& read, const std::string& name, const DocumentType& type,
                      std::vector<Field>& fields) {
    read_metadata(file, name, type, fields);
    for (const auto& [key, tensor] : file.tensors) {
        Field* found = nullptr;
        for (Field& field : fields)
            if (field.name == key && std::holds_alternative<Array>(field.value)) found = &field;
        if (!found) unknown_field(name, "", key, names(fields));
        read_array(*found, std::get<Array>(found->value), tensor, read, name);
    }
}

void write_safetensors(Output& output, const DocumentType& type, const std::vector<Field>& fields) {
    std::vector<const Field*> arrays;
    for (const Field& field : fields)
        if (std::holds_alternative<Array>(field.value) && !is_left_out(field)) arrays.push_back(&field);
    // Wide numbers first, so that each array is aligned to its own.
    std::stable_sort(arrays.begin(), arrays.end(), [](const Field* a, const Field* b) {
        return dtype_size(std::get<Array>(a->value).dtype) > dtype_size(std::get<Array>(b->value).dtype);
    });
    std::vector<std::pair<std::string, Tensor>> tensors;
    for (const Field* field : arrays) {
        const Array& array = std::get<Array>(field->value);
        Tensor tensor{dtype_name(array.dtype), {array.entries()}, 0, {}};
        if (array.components > 1) tensor.shape.push_back(array.components);
        tensor.bytes = array.entries() * array.components * dtype_size(array.dtype);
        tensors.emplace_back(field->name, tensor);
    }
    output.write(safetensors_header(metadata_of(type, fields), tensors));
    for (const Field* field : arrays) write_array(output, *field, std::get<Array>(field->value));
}

} // namespace bough
