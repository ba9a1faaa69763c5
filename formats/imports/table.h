// table.h: delimited text with a line of column names (CSV and its cousins), for the readers of foreign tables. Nothing
// is copied: cells are views into the content. Columns are found by name, in any order; names are compared by letters
// and digits alone, in lower case and without units: "radius (m)", " Radius" and "RADIUS" are "radius", "parent_ID" is
// "parentid". The delimiter is the first of tab, semicolon and comma that the names have, else blanks. A byte order
// mark, CRLF, quotes around cells, blank lines and lines that begin with '#', '%' or "//" are passed over; numbers may
// have a decimal comma where the comma does not delimit. O(size) over all rows.
#pragma once
#include "lib/base/math.h"
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bough {

class Table {
public:
    static constexpr std::size_t none = std::size_t(-1);

    // Reads the names and looks at the first row. Rows may be wider than the names: a row that R wrote begins with its
    // own name, which the header lacks; and a name of `triples` (as compared) stands for three columns, x, y and z,
    // where that makes rows as wide as the names. Throws nothing: a table without rows is empty.
    Table(std::string_view content, const std::string& name, std::span<const std::string_view> triples = {});

    // The column that has one of these names (as compared), the first name first; none where there is none.
    std::size_t column(std::initializer_list<std::string_view> names) const;
    const std::vector<std::string>& names() const { return names_; } // as compared

    // The next row that holds anything; false at the end. Throws InputError for one with fewer cells than names, and for the line of names again.
    bool next();
    std::size_t line() const { return line_; } // 1-based, of the row
    std::string_view cell(std::size_t column) const { return cells_[column]; }
    // Throw InputError FILE:LINE unless the cell is a finite number, or a whole one.
    double number(std::size_t column) const;
    std::int64_t integer(std::size_t column) const;

    // Names as compared of the first line that is no comment, at most 64 KB; for recognizing a format.
    static std::vector<std::string> names_of(std::string_view content);

private:
    bool next_line(std::string_view& line);
    void split(std::string_view line, char delimiter);
    [[noreturn]] void refuse(std::size_t column, const char* expected) const;

    std::string_view content_, line_of_names_;
    std::string name_;
    std::vector<std::string> names_;
    std::vector<std::string_view> cells_;
    char delimiter_ = ',';
    std::size_t at_ = 0, line_ = 0;
};

} // namespace bough
