// document_parts.h: the pieces behind document.h: fields as JSON, the safetensors layout, and the errors they share.
#pragma once
#include "document.h"
#include "formats/text.h"
#include <map>
#include <nlohmann/json.hpp>

namespace bough {

// ---- head.cpp: what kind of file it is, from its head ----
bool looks_binary(std::string_view content); // begins with a header's length, as no text does

// ---- errors.cpp: places and advice ----
std::string pointer(const std::string& at, std::string_view key); // at + "/" + key, escaped, in one line
std::string in_quotes(std::string_view text);                     // in double quotes, in one line, cut when long
[[noreturn]] void unknown_field(const std::string& name, const std::string& at, std::string_view key,
                                const std::vector<std::string>& known);
[[noreturn]] void missing_field(const std::string& name, const std::string& at, const std::string& field);
// Throws where the content is no document of this type; true for the binary form, false for JSON.
bool is_binary(std::string_view content, const std::string& name, const DocumentType&);
void check_version(const std::string& name, std::int64_t version, const DocumentType&);
void check_format(const std::string& name, const std::string& format, const DocumentType&);
// Unread required fields, and array lengths against Per; fills absent arrays that have a default.
void check_complete(std::vector<Field>&, const std::string& name, const std::string& at);
std::vector<std::string> names(const std::vector<Field>&);

// ---- finite.cpp ----
bool all_finite(const double* values, std::size_t count);
// Throws OutputError naming the first number of a field that is not finite; `first`: the index of values[0] in it.
void require_finite(const Output&, const std::string& field, const std::vector<double>& values, std::size_t first);

// ---- json_reader.cpp ----
// Fields of one JSON object by SAX: of a document (type given) or of a part of one. `line` > 0: the text is this line
// of the file (JSON lines).
void read_json(std::string_view text, const std::string& name, const DocumentType*, std::vector<Field>&,
               std::size_t line = 0);
// Puts a value that is no array of numbers into its field; the reader's and the metadata's one place for types.
void assign(Field&, const nlohmann::json& value, const std::string& name, const std::string& at);

// ---- json_value.cpp ----
// A small document or part of one as a tree of values; duplicate names are errors. `at`: its JSON pointer.
nlohmann::json parse_json(std::string_view text, const std::string& name, const std::string& at = "");
// Where and why a text is no JSON. `position`: bytes read; `at`: JSON pointer of what was being read.
[[noreturn]] void syntax_error(std::string_view text, const std::string& name, std::size_t line, std::size_t position,
                               const std::string& why, const std::string& at);

// ---- json_writer.cpp ----
void write_json(Output&, const DocumentType&, const std::vector<Field>&);
bool is_left_out(const Field&);                             // optional and empty
void append_string(std::string& to, std::string_view text); // quoted and escaped
void append_number(std::string& to, double value);          // shortest text that reads back the same; finite
void append_number(std::string& to, float value);           // the same, where it is read into a float
// {"a": ..., ...} on one line, without a line end; of a document if a type is given.
void write_json_line(Output&, const DocumentType*, const std::vector<Field>&, const Digits& of_arrays = {});
std::string value_text(const Field&); // a field that is no array of numbers and no list of objects, as JSON text

// ---- safetensors.cpp ----
struct Tensor {
    std::string dtype; // "F64"
    std::vector<std::uint64_t> shape;
    std::uint64_t bytes = 0;
    std::string_view data{}; // in the content, when read from one
    std::uint64_t begin = 0; // in the file
};
struct Safetensors {
    std::map<std::string, std::string> metadata;
    std::map<std::string, Tensor> tensors;
};
// The layout, wholly checked: header within the file, shapes and offsets that fit each other, no overlap, no gap, no
// trailing bytes. Sizes are believed only after that.
Safetensors parse_safetensors(std::string_view content, const std::string& name);
// From the header alone, `size`: of the whole file. Leaves Tensor::data empty.
Safetensors parse_safetensors_header(std::string_view header, std::uint64_t size, const std::string& name);
// Length and header for these tensors, data to follow in their order.
std::string safetensors_header(const std::vector<std::pair<std::string, std::string>>& metadata,
                               const std::vector<std::pair<std::string, Tensor>>& tensors);
// The fields in __metadata__: strings as themselves, all else as JSON text.
std::vector<std::pair<std::string, std::string>> metadata_of(const DocumentType&, const std::vector<Field>&);
void read_metadata(const Safetensors&, const std::string& name, const DocumentType&, std::vector<Field>&);
// Throws unless the tensor has this dtype and shape; -1 stands for any length.
void check_tensor(const std::string& name, const std::string& field, const Tensor&, Dtype,
                  const std::vector<std::int64_t>& shape);
// `first`: the index of values[0] in the field, for the message.
void check_finite(const std::string& name, const std::string& field, const double* values, std::size_t count,
                  std::size_t first = 0);
// read(at, count, to): `count` bytes of the file from byte `at`; it may be any part of an array.
using ReadBytes = std::function<void(std::uint64_t at, std::size_t count, char* to)>;
void read_safetensors(const Safetensors&, const ReadBytes& read, const std::string& name, const DocumentType&,
                      std::vector<Field>&);
void write_safetensors(Output&, const DocumentType&, const std::vector<Field>&);
const char* dtype_name(Dtype);
std::size_t dtype_size(Dtype);

} // namespace bough
