// document.h: what all bough documents share. A document is a table of fields, each bound to a member of the struct it
// is read into or written from; the table drives both forms (formats/documents/README.md), so that a document's own file says
// what it holds and nothing about JSON or safetensors.
//
// Errors are InputErrors of one line: "FILE:LINE:COLUMN: ..." where the text is no JSON, "FILE: /json/pointer: ..."
// where a field is wrong (same pointer in the binary form, numbers counted through the flat array).
#pragma once
#include "formats/open.h"
#include "lib/base/math.h"
#include "lib/model/splines.h"
#include "lib/model/tree.h"
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace bough {

// Entries of an array on their way at a time.
constexpr std::size_t block_entries = 4096;

// What one number of an array is in the binary form: F64, I64, I32, U8 there.
enum class Dtype : std::uint8_t { f64, i64, i32, u8 };

// Numbers of an array on their way between a document and memory: reals for f64, integers for the rest.
struct Numbers {
    std::vector<double> reals;
    std::vector<std::int64_t> integers;
};

// How many entries an array must have and what each stands for: "body in /parent".
struct Per {
    std::string what;
    std::function<std::size_t()> count;
};

// A std::vector of numbers, vectors, quaternions (x y z w), matrices (xx yy zz xy xz yz) or kinds, as flat numbers. They
// pass through Numbers a block of entries at a time, which stays in cache and holds no field twice.
struct Array {
    Dtype dtype;
    std::size_t components;                                                  // numbers of one entry
    std::function<std::size_t()> entries;                                    // in memory
    std::function<void(std::size_t first, std::size_t count, Numbers&)> get; // entries from `first`, replacing Numbers
    std::function<void(std::size_t count)> start; // empty, with room for about `count` entries
    std::function<void(const Numbers&)> add;      // whole entries after those that are there
    std::function<void(std::size_t count)> fill;  // by its default when absent; empty: must be there if Per counts any
    Per per;                                      // count empty: any number of entries
};

struct Field;

// A list of objects, each with a table of its own (frames of a motion).
struct Objects {
    std::function<std::vector<Field>()> begin; // adds one more, to be read into
    std::function<std::size_t()> count;
    std::function<std::vector<Field>(std::size_t)> at;
};

struct Field {
    std::string name;
    std::variant<Array, Objects, double*, std::int32_t*, std::int64_t*, std::string*, std::vector<std::string>*> value;
    bool required = true;
    bool seen = false;       // the reader met it
    std::size_t numbers = 0; // that the reader met in it
};

// The fields of tables: array("mass", tree.mass, per_body) is required, array("damping", ..., 0.0) has a default.
Field array(const std::string& name, std::vector<double>&, const Per&);
Field array(const std::string& name, std::vector<double>&, const Per&, double fallback);
Field array(const std::string& name, std::vector<std::int32_t>&, const Per&);
Field array(const std::string& name, std::vector<Kind>&, const Per&, Kind fallback);
Field array(const std::string& name, std::vector<Vec3>&, const Per&);
Field array(const std::string& name, std::vector<Quat>&, const Per&);
Field array(const std::string& name, std::vector<Mat3>&, const Per&);
Field optional(Field); // may be absent: an array is then as empty as it is, a value keeps its default

// What a document is called and which version of it we write and read.
struct DocumentType {
    const char* format;
    std::int64_t version;
};

// Reads either form into the fields' targets: format, version, names, types, lengths, finite numbers; rules between
// fields are check()'s. Cost O(size).
void read_document(std::string_view content, const std::string& name, const DocumentType&, std::vector<Field>);
void read_document(const Input&, const DocumentType&, std::vector<Field>); // the binary form array by array
// Writes either form. A number that is not finite is an OutputError. (The fields are only looked at.)
void write_document(Output&, Form, const DocumentType&, const std::vector<Field>&);

// Throws `defect`, if there is one, as an InputError at its JSON pointer: entry 4 of "com" is /com/12.
void refuse(const std::optional<Defect>& defect, const std::string& name, const std::vector<Field>&);

// The "format" of a document of ours in either form, "" for anything else. Ends at the field, which stands first in what
// we write.
std::string document_format(std::string_view content);

} // namespace bough
