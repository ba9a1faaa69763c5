// parameter_table.h: names and values of a foreign program's parameter file, and who asked for them: a name that no
// reader asks for is a mistake in the file.
//
// Values are numbers, flags, text, or flat lists of numbers. Every error is an InputError "FILE:LINE: NAME: is ...,
// expected ...".
#pragma once
#include "formats/error.h"
#include <array>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace bough {

struct ParameterValue {
    enum class Kind { number, flag, text, list } kind = Kind::number;
    std::vector<double> numbers; // one but for a list; 0 or 1 for a flag
    std::string text;            // as written
    std::size_t line = 0;
};

class ParameterTable {
public:
    explicit ParameterTable(std::string file) : file_(std::move(file)) {}
    void add(const std::string& name, ParameterValue); // throws for a name that was there before

    bool has(const std::string& name) const { return values_.count(name) > 0; }
    bool is_list(const std::string& name) const;

    // The value, within least..most, or `fallback` where the file has none. Text that is a number is one.
    double number(const std::string& name, double fallback, double least, double most);
    int whole(const std::string& name, int fallback, int least, int most);
    bool flag(const std::string& name, bool fallback);
    std::string text(const std::string& name, const std::string& fallback);
    // Four numbers, those of levels that grow (the first `grown`) within least..most.
    std::array<double, 4> four(const std::string& name, const std::array<double, 4>& fallback, double least,
                               double most, int grown, bool whole = false);

    std::vector<double> three(const std::string& name, const std::array<double, 3>& fallback, double least,
                              double most);

    // Names that are known, and those of them that the file has, for a note.
    std::string known(std::initializer_list<const char*> names);
    // As known(); what is there and not 0, off or empty is put into `notes` as "NAMES (reason)".
    void not_honoured(std::initializer_list<const char*> names, const std::string& reason,
                      std::vector<std::string>& notes);

    [[noreturn]] void refuse(const std::string& name, const std::string& expected) const;
    void finish() const; // throws for a name that nobody asked for, with the nearest that was

private:
    const ParameterValue* find(const std::string& name);

    std::string file_;
    std::map<std::string, ParameterValue> values_;
    std::set<std::string> asked_;
};

// A JSON object, or a Python dict of the same kind (single quotes, True, tuples, # comments, a docstring and "NAME ="
// before it), of numbers, flags, text and flat lists. Nothing is evaluated. Throws InputError.
ParameterTable parse_parameters(std::string_view content, const std::string& file);

} // namespace bough
