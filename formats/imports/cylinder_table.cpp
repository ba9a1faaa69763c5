// cylinder_table.cpp: cylinders of reconstructed laser scans as delimited text, one a row: TreeQSM's cylinder_*.txt
// (save_model_text.m), SimpleForest's and aRchi's CSV, treegraph's, and tables of the same columns by other hands. Read by
// names, which differ from program to program in spelling alone (table.h compares them):
//
//   start      start_point (3 columns), startX.., start.x, sx          needed
//   end        endX.., end.x, ex; else start + length * axis           needed, or the two that give it
//   axis       axis_direction (3 columns), axisX.., axis.x, ax         of any length above 0
//   radius     radius, radius_cyl; else half of diameter               else by the pipe rule
//   parent     parent, parentID, parent_ID, p2                         needed
//   id         ID, cyl_ID, p1; else the row's number from 1            any whole numbers, each once
//   branch     branch, branchID, axis_ID, nbranch; else by geometry
//   extension  extension, extension_ID                                 which cylinder goes on: tells a file that was cut
//
// A parent below 0 is none; so is 0 where no cylinder has that id, and what R, Python and MATLAB write for a value that
// is not there: NA, NaN, None, null. Metres and Z up: all of these
// programs say so of their tables.
#include "cylinder_slips.h"
#include "cylinders.h"
#include "formats/error.h"
#include "formats/plain_text.h"
#include "loose_trunks.h"
#include "pipe_rule.h"
#include "table.h"
#include <algorithm>
#include <array>

namespace bough {
namespace {

constexpr auto none = Table::none;
constexpr std::array<std::string_view, 6> triples{"startpoint", "axisdirection", "endpoint", "start", "axis", "end"};

using Triple = std::array<std::size_t, 3>;

struct Columns {
    Triple start, end, axis;
    std::size_t length, radius, diameter, parent, id, branch, extension;
    static bool all(const Triple& t) { return t[0] != none && t[1] != none && t[2] != none; }
    bool complete() const { return all(start) && parent != none && (all(end) || (all(axis) && length != none)); }
};

Columns columns_of(const Table& t) {
    const auto column = [&](std::initializer_list<std::string_view> names) { return t.column(names); };
    Columns c;
    c.start = {column({"startpointx", "startx", "xstart", "start1", "sx"}),
               column({"startpointy", "starty", "ystart", "start2", "sy"}),
               column({"startpointz", "startz", "zstart", "start3", "sz"})};
    c.end = {column({"endpointx", "endx", "xend", "end1", "ex"}), column({"endpointy", "endy", "yend", "end2", "ey"}),
             column({"endpointz", "endz", "zend", "end3", "ez"})};
    c.axis = {column({"axisdirectionx", "axisx", "directionx", "axis1", "ax"}),
              column({"axisdirectiony", "axisy", "directiony", "axis2", "ay"}),
              column({"axisdirectionz", "axisz", "directionz", "axis3", "az"})};
    c.length = column({"length", "cyllength", "lengthcyl"});
    c.radius = column({"radius", "radiuscyl", "cylradius"});
    c.diameter = column({"diameter", "diametercyl", "cyldiameter"});
    c.parent = column({"parent", "parentid", "parentcyl", "parentcylinder", "p2"});
    c.id = column({"id", "cylid", "cylinderid", "cylinder", "p1"});
    c.branch = column({"branch", "branchid", "axisid", "nbranch"});
    c.extension = column({"extension", "extensionid"});
    return c;
}

const char* program_of(const Table& t) {
    if (t.column({"cylid"}) != none && t.column({"radiuscyl"}) != none) return "aRchi";
    if (t.column({"axisdirectionx"}) != none || t.column({"positioninbranch"}) != none) return "TreeQSM";
    if (t.column({"parentid"}) != none && t.column({"branchorder"}) != none) return "SimpleForest";
    return "";
}

// Without case. An empty cell is none of these: it may be a row that was cut off.
bool is_missing(std::string_view cell) {
    const std::string word = lower_case(cell);
    return word == "na" || word == "nan" || word == "none" || word == "null";
}

Vec3 point(const Table& t, const Triple& c) {
    return {t.number(c[0]), t.number(c[1]), t.number(c[2])};
}

Vec3 end_of(const Table& t, const Columns& c, const Vec3& start, const std::string& name) {
    if (Columns::all(c.end)) return point(t, c.end);
    const double length = t.number(c.length);
    const Vec3 axis = point(t, c.axis);
    if (length < 0 || !(axis.squaredNorm() > 0))
        throw InputError(file_line(name, t.line()), "length is " + shown(length) + " along an axis " +
                                                        shown(axis.norm()) +
                                                        " long, expected 0 or more along an axis of more than 0");
    return start + length * axis.normalized();
}

struct Rows {
    Cylinders cylinders;
    std::vector<std::int64_t> id, parent, extension; // as in the file
};

Rows read_rows(Table& t, const Columns& c, std::size_t most, const std::string& name) {
    Rows rows;
    Cylinders& out = rows.cylinders;
    // Grown by doubling, these would for a moment take twice what they hold.
    out.start.reserve(most), out.end.reserve(most), out.radius.reserve(most), out.line.reserve(most);
    if (c.branch != none) out.branch.reserve(most);
    rows.id.reserve(most), rows.parent.reserve(most);
    if (c.extension != none) rows.extension.reserve(most);
    while (t.next()) {
        const Vec3 start = point(t, c.start);
        const double radius = c.radius != none     ? t.number(c.radius)
                              : c.diameter != none ? 0.5 * t.number(c.diameter)
                                                   : 0;
        if (radius < 0)
            throw InputError(file_line(name, t.line()), "radius is " + shown(radius) + ", expected 0 or more");
        out.start.push_back(start);
        out.end.push_back(end_of(t, c, start, name));
        out.radius.push_back(radius);
        out.line.push_back(t.line());
        if (c.branch != none) out.branch.push_back(t.integer(c.branch));
        rows.id.push_back(c.id != none ? t.integer(c.id) : std::int64_t(rows.id.size()) + 1);
        rows.parent.push_back(is_missing(t.cell(c.parent)) ? -1 : t.integer(c.parent));
        if (c.extension != none) rows.extension.push_back(parse_integer(t.cell(c.extension)).value_or(0));
    }
    return rows;
}

// Rows in the order of their ids, most often that of the file.
class ById {
public:
    ById(const std::vector<std::int64_t>& id, const std::vector<std::size_t>& line, const std::string& name) : id_(id) {
        row_.resize(id.size());
        for (std::size_t i = 0; i < row_.size(); ++i) row_[i] = std::int32_t(i);
        const auto before = [&](std::int32_t a, std::int32_t b) { return id[a] < id[b]; };
        if (!std::is_sorted(row_.begin(), row_.end(), before)) std::stable_sort(row_.begin(), row_.end(), before);
        for (std::size_t k = 1; k < row_.size(); ++k)
            if (id[row_[k]] == id[row_[k - 1]])
                throw InputError(file_line(name, line[row_[k]]),
                                 "id " + std::to_string(id[row_[k]]) + " is used twice, expected each id once");
    }
    std::int32_t row(std::int64_t id) const {
        const auto found = std::lower_bound(row_.begin(), row_.end(), id,
                                            [this](std::int32_t r, std::int64_t wanted) { return id_[r] < wanted; });
        return found != row_.end() && id_[*found] == id ? *found : -1;
    }

private:
    const std::vector<std::int64_t>& id_;
    std::vector<std::int32_t> row_;
};

void link(Rows& rows, const std::string& name, ImportNotes& notes) {
    Cylinders& c = rows.cylinders;
    const ById by_id(rows.id, c.line, name);
    c.parent.reserve(rows.id.size());
    for (std::size_t i = 0; i < rows.id.size(); ++i) {
        const std::int64_t parent = rows.parent[i];
        const std::int32_t row = parent < 0 ? -1 : by_id.row(parent);
        if (row < 0 && parent > 0)
            throw InputError(file_line(name, c.line[i]), "parent " + std::to_string(parent) +
                                                             " does not exist, expected the id of a cylinder, or 0 or "
                                                             "-1 for none");
        c.parent.push_back(row);
    }
    std::vector<std::int32_t> extension;
    extension.reserve(rows.extension.size());
    for (const std::int64_t e : rows.extension) {
        const std::int32_t row = e <= 0 ? -1 : by_id.row(e);
        extension.push_back(row < 0 && e > 0 ? std::int32_t(c.size()) : row);
    }
    note_cut(c, extension, notes);
}

bool recognizes_cylinders(std::string_view content) {
    constexpr std::size_t head = 65536;
    const Table table(content.substr(0, head), "", triples);
    if (columns_of(table).complete()) return true;
    // TreeQSM's names without a whole row after them: the reader says what is wrong.
    const std::vector<std::string> names = table.names();
    const auto has = [&](const char* n) { return std::find(names.begin(), names.end(), n) != names.end(); };
    return has("startpoint") && has("axisdirection") && has("parent");
}

Splines read_cylinders(std::string_view content, const ImportOptions& options, ImportNotes& notes) {
    Table table(content, options.name, triples);
    const Columns columns = columns_of(table);
    if (!columns.complete())
        throw InputError(options.name, "has names of TreeQSM's cylinders but no row as wide as they are, expected "
                                       "start_point and axis_direction in three columns each");
    const char* program = program_of(table);
    const auto lines = std::size_t(std::count(content.begin(), content.end(), '\n'));
    Rows rows = read_rows(table, columns, lines, options.name);
    if (rows.id.empty()) throw InputError(options.name, "holds no cylinder, expected one a row after the names");
    link(rows, options.name, notes);
    rows.id = {}, rows.parent = {}, rows.extension = {};
    if (columns.id == none) refuse_second_scan(rows.cylinders, options.name);
    find_odd_radius(rows.cylinders, options.name, notes);
    ImportedTree tree;
    tree.branches = branches_of(std::move(rows.cylinders), options.name, notes);
    fill_radii(tree.branches, notes);
    join_loose_trunks(tree.branches, options.up != 0 ? options.up : 'z', notes);
    if (*program != 0) notes.format = std::string(program) + " cylinders";
    tree.source = notes.format + " " + options.name;
    tree.unit = 1;
    tree.up = 'z';
    return finish_import(std::move(tree), options, notes);
}

} // namespace

const SplineFormat cylinder_table_format{"cylinder table", recognizes_cylinders, read_cylinders};

} // namespace bough
