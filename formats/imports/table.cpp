#include "table.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include <algorithm>
#include <cmath>

namespace bough {
namespace {

constexpr std::size_t longest_names = 65536;

bool is_comment(std::string_view line) {
    return line.front() == '#' || line.front() == '%' || line.substr(0, 2) == "//";
}

std::string_view without_quotes(std::string_view cell) {
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') return cell.substr(1, cell.size() - 2);
    return cell;
}

// "radius (m)" -> "radius", "start.X [m]" -> "startx".
std::string compared(std::string_view name) {
    std::string out;
    int depth = 0;
    for (const char c : name) {
        depth += c == '(' || c == '[';
        const char small = lower_case(c);
        if (depth == 0 && ((small >= 'a' && small <= 'z') || (c >= '0' && c <= '9'))) out += small;
        depth -= depth > 0 && (c == ')' || c == ']');
    }
    return out;
}

char delimiter_of(std::string_view line) {
    for (const char c : {'\t', ';', ','})
        if (line.find(c) != std::string_view::npos) return c;
    return ' ';
}

// Calls cell(view) for each cell of a line. A tab, semicolon or comma within quotes does not end a cell.
template <class Cell> void each_cell(std::string_view line, char delimiter, Cell&& cell) {
    if (delimiter == ' ') {
        std::size_t at = 0;
        for (std::string_view t = next_token(line, at); !t.empty(); t = next_token(line, at)) cell(without_quotes(t));
        return;
    }
    const bool has_quotes = line.find('"') != std::string_view::npos;
    for (std::size_t at = 0; at <= line.size();) {
        std::size_t end = at;
        bool quoted = false;
        if (has_quotes)
            for (; end < line.size() && (quoted || line[end] != delimiter); ++end) quoted ^= line[end] == '"';
        else
            end = std::min(line.find(delimiter, at), line.size());
        cell(without_quotes(trimmed(line.substr(at, end - at))));
        at = end + 1;
    }
}

} // namespace

std::vector<std::string> Table::names_of(std::string_view content) {
    return Table(content.substr(0, longest_names), "").names_;
}

Table::Table(std::string_view content, const std::string& name, std::span<const std::string_view> triples)
    : content_(content), name_(name), at_(bom_size(content)) {
    std::string_view line;
    if (!next_line(line)) return;
    line_of_names_ = trimmed(line);
    delimiter_ = delimiter_of(line);
    each_cell(line, delimiter_, [&](std::string_view cell) { names_.push_back(compared(cell)); });
    while (names_.size() > 1 && names_.back().empty()) names_.pop_back(); // a delimiter at the end of the line

    const std::size_t after_names = at_, line_of_names = line_;
    if (next_line(line)) split(line, delimiter_);
    at_ = after_names;
    line_ = line_of_names;
    std::size_t width = cells_.size();
    while (width > names_.size() && cells_[width - 1].empty()) --width;
    std::vector<std::string> wide;
    for (const std::string& n : names_) {
        if (std::find(triples.begin(), triples.end(), n) == triples.end()) {
            wide.push_back(n);
            continue;
        }
        for (const char axis : {'x', 'y', 'z'}) wide.push_back(n + axis);
    }
    if (width == wide.size())
        names_ = std::move(wide);
    else if (width == names_.size() + 1)
        names_.insert(names_.begin(), "");
}

bool Table::next_line(std::string_view& line) {
    while (at_ < content_.size()) {
        const std::size_t end = std::min(content_.find('\n', at_), content_.size());
        line = content_.substr(at_, end - at_);
        at_ = end + 1;
        ++line_;
        const std::string_view text = trimmed(line);
        if (text.empty() || is_comment(text)) continue;
        if (line.back() == '\r') line.remove_suffix(1);
        return true;
    }
    return false;
}

void Table::split(std::string_view line, char delimiter) {
    cells_.clear();
    each_cell(line, delimiter, [this](std::string_view cell) { cells_.push_back(cell); });
}

bool Table::next() {
    std::string_view line;
    if (!next_line(line)) return false;
    if (trimmed(line) == line_of_names_)
        throw InputError(file_line(name_, line_), "is a second line of names, of another table in the same file; "
                                                  "expected one table in a file");
    split(line, delimiter_);
    if (cells_.size() < names_.size())
        throw InputError(file_line(name_, line_), counted(cells_.size(), "column", "columns") + ", expected " +
                                                      std::to_string(names_.size()) + " as the line of names says");
    return true;
}

std::size_t Table::column(std::initializer_list<std::string_view> names) const {
    for (const std::string_view name : names)
        for (std::size_t k = 0; k < names_.size(); ++k)
            if (names_[k] == name) return k;
    return none;
}

void Table::refuse(std::size_t column, const char* expected) const {
    throw InputError(file_line(name_, line_), "column " + in_ascii_quotes(names_[column]) + " holds " +
                                                  in_ascii_quotes(cells_[column]) + ", expected " + expected);
}

double Table::number(std::size_t column) const {
    const auto value = parse_number(cells_[column], delimiter_ != ',');
    if (!value) refuse(column, "a finite number");
    return *value;
}

std::int64_t Table::integer(std::size_t column) const {
    if (const auto value = parse_integer(cells_[column])) return *value;
    // "1e+06" and "12.0", as programs print numbers of any kind.
    constexpr double most = 9007199254740992.0;
    const auto real = parse_number(cells_[column], delimiter_ != ',');
    if (!real || *real != std::floor(*real) || std::abs(*real) > most) refuse(column, "a whole number");
    return std::int64_t(*real);
}

} // namespace bough
