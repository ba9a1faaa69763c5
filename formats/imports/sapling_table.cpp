// sapling_table.cpp: curves as a table, a row a knot, as dumps of Blender's tree curves have it: columns spline, point,
// x, y, z, radius in any order, parted by comma, semicolon (then with decimal commas, too) or tab. Rows of a curve may
// stand anywhere; without a column point they are in order. No parents: loose_curves.h. Knots are joined straight, as
// handles are lost. The format states neither unit nor axis.
#include "formats/plain_text.h"
#include "loose_curves.h"
#include "pipe_rule.h"
#include <algorithm>
#include <array>
#include <optional>

namespace bough {
namespace {

std::string column_name(std::string_view field) {
    field = trimmed(field);
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
    return lower_case(trimmed(field));
}

enum Column : std::size_t { spline, knot, x, y, z, radius, bevel, columns };

struct Header {
    char comma = ',';
    std::array<int, columns> at{-1, -1, -1, -1, -1, -1, -1};
    std::vector<Column> column;      // of each field of a row; `columns`: it is not read
    std::vector<std::string> others; // names of those
    bool good() const { return at[spline] >= 0 && at[x] >= 0 && at[y] >= 0 && at[z] >= 0; }
};

template <class Take> void each_field(std::string_view line, char comma, Take&& take) {
    for (std::size_t at = 0, k = 0;; ++k) {
        const std::size_t end = std::min(line.find(comma, at), line.size());
        take(k, line.substr(at, end - at));
        if (end == line.size()) return;
        at = end + 1;
    }
}

Header parse_header(std::string_view line) {
    Header h;
    h.comma = line.find(';') != std::string_view::npos ? ';' : line.find('\t') != std::string_view::npos ? '\t' : ',';
    each_field(line, h.comma, [&](std::size_t k, std::string_view field) {
        const std::string name = column_name(field);
        const auto is = [&](std::initializer_list<const char*> names) {
            return std::find(names.begin(), names.end(), name) != names.end();
        };
        const Column column = is({"spline", "spline_id", "spline_index", "curve", "curve_id"}) ? spline
                              : is({"point", "point_id", "point_index", "knot"})               ? knot
                              : is({"x", "co_x"})                                              ? x
                              : is({"y", "co_y"})                                              ? y
                              : is({"z", "co_z"})                                              ? z
                              : is({"radius", "r"})                                            ? radius
                              : is({"bevel_depth"})                                            ? bevel
                                                                                               : columns;
        const bool read = column < columns && h.at[column] < 0;
        h.column.push_back(read ? column : columns);
        if (read)
            h.at[column] = int(k);
        else if (!name.empty())
            h.others.push_back(name);
    });
    return h;
}

class Lines {
public:
    explicit Lines(std::string_view content) : content_(content), at_(bom_size(content)) {}
    bool next(std::string_view& line) { // neither blank nor a comment
        while (at_ < content_.size()) {
            const std::size_t end = std::min(content_.find('\n', at_), content_.size());
            line = content_.substr(at_, end - at_);
            while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
            at_ = end + 1;
            ++number;
            const std::string_view text = trimmed(line);
            if (!text.empty() && text.front() != '#') return true;
        }
        return false;
    }
    std::size_t number = 0;

private:
    std::string_view content_;
    std::size_t at_ = 0;
};

struct Row {
    std::int64_t spline, knot;
    Vec3 point;
    double radius;
};

// `place()` is asked for messages alone: a line's name is made of more than its numbers are.
template <class Place> Row parse_row(std::string_view line, const Header& h, Place&& place) {
    std::array<double, columns> value{0, 0, 0, 0, 0, 0, 1};
    std::array<bool, columns> seen{};
    each_field(line, h.comma, [&](std::size_t k, std::string_view field) {
        const Column c = k < h.column.size() ? h.column[k] : columns;
        if (c == columns) return;
        field = trimmed(field);
        if (field.size() >= 2 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
        if (field.empty() && (c == radius || c == bevel)) return;
        const auto number = parse_number(field, h.comma != ',');
        if (!number) throw InputError(place(), in_ascii_quotes(field) + " is no finite number");
        if (c <= knot && *number != std::floor(*number))
            throw InputError(place(),
                             in_ascii_quotes(field) + " is not a curve's or point's number, expected an integer");
        value[c] = *number;
        seen[c] = true;
    });
    for (const std::size_t c : {spline, x, y, z})
        if (!seen[c]) throw InputError(place(), "has too few columns, expected those that the first line names");
    return {std::int64_t(std::clamp(value[spline], -9e15, 9e15)),
            std::int64_t(std::clamp(value[knot], -9e15, 9e15)),
            {value[x], value[y], value[z]},
            value[radius] * value[bevel]};
}

bool stands_before(const Row& a, const Row& b) {
    return std::pair(a.spline, a.knot) < std::pair(b.spline, b.knot);
}

// Calls take(row) for each, until it returns false.
template <class Take> void each_row(Lines lines, const Header& h, const std::string& name, Take&& take) {
    std::string_view line;
    for (std::int64_t number = 0; lines.next(line); ++number) {
        Row row = parse_row(line, h, [&] { return file_line(name, lines.number); });
        if (h.at[knot] < 0) row.knot = number;
        if (!take(row)) return;
    }
}

// Rows that stand in order, as they usually do, are not kept.
LooseCurves curves_of(const Lines& lines, const Header& h, const std::string& name, std::size_t most_rows) {
    LooseCurves curves;
    curves.point.reserve(most_rows);
    curves.radius.reserve(most_rows);
    std::optional<Row> before;
    const auto add = [&](const Row& row) {
        if (before && row.spline != before->spline) curves.end_curve();
        curves.add(row.point, row.radius);
        before = row;
    };
    bool sorted = true;
    each_row(lines, h, name, [&](const Row& row) {
        sorted = !before || !stands_before(row, *before);
        if (sorted) add(row);
        return sorted;
    });
    if (!sorted) {
        curves = {};
        before.reset();
        std::vector<Row> rows;
        rows.reserve(most_rows);
        each_row(lines, h, name, [&](const Row& row) {
            rows.push_back(row);
            return true;
        });
        std::stable_sort(rows.begin(), rows.end(), stands_before);
        curves.point.reserve(rows.size());
        curves.radius.reserve(rows.size());
        for (const Row& row : rows) add(row);
    }
    if (before) curves.end_curve();
    return curves;
}

bool recognizes_table(std::string_view content) {
    std::string_view line;
    Lines lines(content.substr(0, 65536));
    return lines.next(line) && line.size() < 4096 && parse_header(line).good();
}

Splines read_table(std::string_view content, const ImportOptions& options, ImportNotes& notes) {
    Lines lines(content);
    std::string_view line;
    lines.next(line);
    const Header header = parse_header(line);
    for (const std::string& other : header.others)
        notes.lines.push_back("column " + in_ascii_quotes(other) + " not read");
    const auto most_rows = std::size_t(std::count(content.begin(), content.end(), '\n'));
    LooseCurves curves = curves_of(lines, header, options.name, most_rows);
    if (curves.size() == 0) throw InputError(options.name, "holds no point, expected a row for each after the first");
    options.let_go();
    ImportedTree tree;
    tree.source = "table of curves " + options.name;
    JoinedCurves joined = join_curves(std::move(curves), options.up, CurveBase::unknown, options.name, notes);
    tree.branches = std::move(joined.branches);
    tree.up = joined.up;
    fill_radii(tree.branches, notes);
    return finish_import(std::move(tree), options, notes);
}

} // namespace

const SplineFormat sapling_table_format{"table of curves (spline, point, x, y, z, radius)", recognizes_table,
                                        read_table};

} // namespace bough
