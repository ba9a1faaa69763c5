// swc.cpp: SWC skeletons: '#' comments, then one node a line: id type x y z radius parent; ids in any order, parent -1
// at a root. A root of type 1 in a file that has other types is a soma: its radius is not a branch's, and soma nodes
// that carry nothing but mark its outline are left out. The format states neither unit nor axis; files of our own do, in
// a comment before the first node.
#include "formats/exports/skeleton_writer.h"
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include "pipe_rule.h"
#include "skeleton.h"
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace bough {
namespace {

constexpr std::size_t swc_columns = 7;
constexpr std::int64_t soma = 1;

struct SwcNode {
    std::int64_t id, type, parent;
    Vec3 point;
    double radius;
    std::size_t line;
};

struct SampleTable {
    std::vector<SwcNode> nodes;
    bool more_columns = false;
};

// Calls row(line, number) for each line that is neither blank nor a comment, until it returns false.
template <class Row> void each_row(std::string_view content, Row&& row) {
    std::size_t number = 0;
    for (std::size_t at = bom_size(content); at < content.size();) {
        const std::size_t end = std::min(content.find('\n', at), content.size());
        const std::string_view line = trimmed(content.substr(at, end - at));
        at = end + 1;
        ++number;
        if (line.empty() || line.front() == '#') continue;
        if (!row(line, number)) return;
    }
}

[[noreturn]] void refuse(const std::string& name, std::size_t line, const std::string& message) {
    throw InputError(file_line(name, line), message);
}

// "12.0" is one, too: some programs print all columns as reals.
std::optional<std::int64_t> whole_number(std::string_view text) {
    if (const auto integer = parse_integer(text)) return integer;
    constexpr double most = 9007199254740992.0;
    const auto real = parse_number(text);
    if (!real || *real != std::floor(*real) || std::abs(*real) > most) return {};
    return std::int64_t(*real);
}

SwcNode parse_node(std::string_view line, std::size_t number, const std::string& name, bool& more_columns) {
    std::array<std::string_view, swc_columns> field;
    std::size_t at = 0, n = 0;
    while (n < swc_columns && !(field[n] = next_token(line, at)).empty()) ++n;
    if (n < swc_columns)
        refuse(name, number, counted(n, "column", "columns") + ", expected 7: id type x y z radius parent");
    more_columns = more_columns || !next_token(line, at).empty();
    const auto integer = [&](std::size_t k, const char* what) {
        const auto value = whole_number(field[k]);
        if (!value)
            refuse(name, number, in_ascii_quotes(field[k]) + " is not a node's " + what + ", expected an integer");
        return *value;
    };
    const auto real = [&](std::size_t k, const char* what) {
        const auto value = parse_number(field[k]);
        if (!value)
            refuse(name, number, in_ascii_quotes(field[k]) + " is not a node's " + what + ", expected a finite number");
        return *value;
    };
    SwcNode node;
    node.id = integer(0, "id");
    node.type = integer(1, "type");
    node.point = {real(2, "x"), real(3, "y"), real(4, "z")};
    node.radius = real(5, "radius");
    node.parent = integer(6, "parent");
    node.line = number;
    if (node.radius < 0) refuse(name, number, "radius is " + shown(node.radius) + ", expected 0 or more");
    return node;
}

SampleTable parse_table(std::string_view content, const std::string& name) {
    SampleTable table;
    each_row(content, [&](std::string_view line, std::size_t number) {
        table.nodes.push_back(parse_node(line, number, name, table.more_columns));
        return true;
    });
    return table;
}

Skeleton link(const std::vector<SwcNode>& nodes, const std::string& name) {
    std::unordered_map<std::int64_t, std::int32_t> index;
    index.reserve(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!index.emplace(nodes[i].id, std::int32_t(i)).second)
            refuse(name, nodes[i].line, "id " + std::to_string(nodes[i].id) + " is used twice, expected each id once");
    Skeleton s;
    for (const SwcNode& node : nodes) {
        std::int32_t parent = -1;
        if (node.parent != -1) {
            const auto found = index.find(node.parent);
            if (found == index.end())
                refuse(name, node.line,
                       "parent " + std::to_string(node.parent) + " does not exist, expected the id of a node or -1");
            parent = found->second;
        }
        s.parent.push_back(parent);
        s.point.push_back(node.point);
        s.radius.push_back(node.radius);
        s.line.push_back(node.line);
    }
    return s;
}

// Takes the soma out of what is grouped into branches: outline nodes join their root, whose radius is of no use.
void leave_out_soma(Skeleton& s, const std::vector<SwcNode>& nodes, ImportNotes& notes) {
    bool other_types = false;
    for (const SwcNode& node : nodes) other_types = other_types || node.type != soma;
    if (!other_types) return;
    std::vector<char> carries(nodes.size(), false);
    for (const std::int32_t p : s.parent)
        if (p >= 0) carries[p] = true;
    std::size_t outline = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].type != soma) continue;
        const std::int32_t p = s.parent[i];
        if (p < 0) s.radius[i] = -1;
        if (p < 0 || s.parent[p] >= 0 || nodes[p].type != soma || carries[i]) continue;
        s.point[i] = s.point[p];
        ++outline;
    }
    if (outline > 0) notes.lines.push_back(counted(outline, "outline node", "outline nodes") + " of the soma left out");
}

bool recognizes_swc(std::string_view content) {
    bool looks_like = false;
    each_row(content, [&](std::string_view line, std::size_t) {
        std::size_t at = 0, n = 0;
        looks_like = true;
        for (std::string_view field = next_token(line, at); !field.empty(); field = next_token(line, at), ++n) {
            const bool whole = n == 0 || n == 1 || n == 6;
            looks_like = looks_like && (n >= swc_columns ||
                                        (whole ? whole_number(field).has_value() : parse_number(field).has_value()));
        }
        looks_like = looks_like && n >= swc_columns;
        return false;
    });
    return looks_like;
}

// Whether the comments before the first node are those of our own writer.
bool is_our_own(std::string_view content) {
    for (std::size_t at = 0; at < content.size();) {
        const std::size_t end = std::min(content.find('\n', at), content.size());
        const std::string_view line = trimmed(content.substr(at, end - at));
        at = end + 1;
        if (line.empty()) continue;
        if (line.front() != '#') return false;
        if (trimmed(line.substr(1)) == swc_frame) return true;
    }
    return false;
}

// Where no node has one, the column was filled with zeros for want of any.
bool has_radius(const std::vector<ImportedBranch>& branches) {
    for (const ImportedBranch& branch : branches)
        for (const double radius : branch.radius)
            if (radius > 0) return true;
    return false;
}

Splines read_swc(std::string_view content, const ImportOptions& options, ImportNotes& notes) {
    const SampleTable table = parse_table(content, options.name);
    if (table.nodes.empty())
        throw InputError(options.name, "holds no node, expected lines of id type x y z radius parent");
    if (table.more_columns) notes.lines.push_back("columns after the seventh are not read");
    Skeleton skeleton = link(table.nodes, options.name);
    leave_out_soma(skeleton, table.nodes, notes);
    ImportedTree tree;
    tree.branches = branches_of(std::move(skeleton), options.name, notes);
    if (!has_radius(tree.branches)) fill_radii(tree.branches, notes);
    tree.source = "SWC " + options.name;
    if (is_our_own(content)) tree.unit = 1, tree.up = 'z';
    return finish_import(std::move(tree), options, notes);
}

} // namespace

const SplineFormat swc_format{"SWC skeleton", recognizes_swc, read_swc};

} // namespace bough
