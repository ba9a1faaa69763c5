// treetools.cpp: tree files of raycloudtools and treetools (.txt): '#' comments, a line that names the fields, then one
// tree a line: a,b,..., x,y,z,radius,parent_id,..., x,y,z,radius,parent_id,... Fields named before the last
// "x,y,z,radius" come once, at the start of a tree's line: attributes of the tree, or, where they hold x,y,z,radius
// themselves, its root. x,y,z is the tip of a segment, parent_id counts the tree's segments from 0, -1 is the root,
// whose radius has no meaning. Metres and Z up by definition of the format.
#include "formats/plain_text.h"
#include "lib/base/counted.h"
#include "skeleton.h"

namespace bough {
namespace {

constexpr std::string_view mandatory = "x,y,z,radius";

struct Fields {
    std::size_t tree = 0;      // numbers before the segments
    bool tree_is_root = false; // their first four are the root's x,y,z,radius
    std::size_t segment = 0;   // numbers of a segment
    std::size_t parent = 0;    // which of them is parent_id
};

std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> parts;
    for (std::size_t at = 0; at <= line.size();) {
        const std::size_t comma = std::min(line.find(',', at), line.size());
        parts.push_back(trimmed(line.substr(at, comma - at)));
        at = comma + 1;
    }
    if (parts.size() > 1 && parts.back().empty()) parts.pop_back(); // a line may end with ", "
    return parts;
}

class PlainLines {
public:
    explicit PlainLines(std::string_view content) : content_(content) {}
    // The next line that is neither blank nor a comment; false at the end.
    bool next(std::string_view& line) {
        while (at_ < content_.size()) {
            const std::size_t end = std::min(content_.find('\n', at_), content_.size());
            line = trimmed(content_.substr(at_, end - at_));
            at_ = end + 1;
            ++number;
            if (!line.empty() && line.front() != '#') return true;
        }
        return false;
    }
    std::size_t number = 0;

private:
    std::string_view content_;
    std::size_t at_ = 0;
};

Fields parse_fields(std::string_view line, const std::string& place) {
    Fields f;
    const std::size_t last = line.rfind(mandatory);
    // The tree's own fields may be parted from the segments' by a blank alone.
    std::string_view before = trimmed(line.substr(0, last));
    if (!before.empty() && before.back() == ',') before.remove_suffix(1);
    f.tree = before.empty() ? 0 : split(before).size();
    f.tree_is_root = before.substr(0, mandatory.size()) == mandatory;
    const std::vector<std::string_view> segment = split(line.substr(last));
    f.segment = segment.size();
    for (std::size_t k = 4; k < segment.size() && f.parent == 0; ++k)
        if (segment[k] == "parent_id") f.parent = k;
    if (f.parent == 0)
        throw InputError(
            place, "has no parent_id, so it holds trunks only; expected a tree file as rayextract trees writes it");
    return f;
}

double number(std::string_view token, const std::string& place, const char* what) {
    const auto value = parse_number(token);
    if (!value)
        throw InputError(place, in_ascii_quotes(token) + " is not a segment's " + what + ", expected a finite number");
    return *value;
}

void add_node(Skeleton& s, const std::string_view* field, std::int32_t parent, std::size_t line,
              const std::string& place) {
    s.point.emplace_back(number(field[0], place, "x"), number(field[1], place, "y"), number(field[2], place, "z"));
    const double radius = number(field[3], place, "radius");
    if (radius < 0 && parent >= 0) throw InputError(place, "radius is " + shown(radius) + ", expected 0 or more");
    s.radius.push_back(parent < 0 ? -1 : radius);
    s.parent.push_back(parent);
    s.line.push_back(line);
}

void add_tree(Skeleton& s, std::string_view text, const Fields& f, std::size_t line, const std::string& place) {
    const std::vector<std::string_view> field = split(text);
    if (field.size() < f.tree + f.segment || (field.size() - f.tree) % f.segment != 0)
        throw InputError(place, counted(field.size(), "number", "numbers") + ", expected " +
                                    (f.tree > 0 ? std::to_string(f.tree) + " and " : std::string()) + "a multiple of " +
                                    std::to_string(f.segment) + " as the fields line says");
    const std::int64_t first = std::int64_t(s.parent.size());
    const std::int64_t count = std::int64_t((field.size() - f.tree) / f.segment) + (f.tree_is_root ? 1 : 0);
    if (f.tree_is_root) add_node(s, field.data(), -1, line, place);
    for (std::size_t at = f.tree; at < field.size(); at += f.segment) {
        const auto parent = parse_integer(field[at + f.parent]);
        if (!parent || *parent < -1 || *parent >= count)
            throw InputError(place, in_ascii_quotes(field[at + f.parent]) + " is not a parent_id, expected -1 to " +
                                        std::to_string(count - 1));
        add_node(s, field.data() + at, *parent < 0 ? -1 : std::int32_t(first + *parent), line, place);
    }
}

bool recognizes_treetools(std::string_view content) {
    PlainLines lines(without_bom(content));
    std::string_view line;
    if (!lines.next(line) || line.size() > 65536) return false;
    const std::size_t at = line.find(mandatory);
    return at == 0 || (at != std::string_view::npos && line.find("parent_id", at) != std::string_view::npos);
}

Splines read_treetools(std::string_view content, const ImportOptions& options, ImportNotes& notes) {
    PlainLines lines(without_bom(content));
    std::string_view line;
    if (!recognizes_treetools(content) || !lines.next(line))
        throw InputError(options.name, "has no line that names the fields, expected x,y,z,radius,parent_id");
    const Fields fields = parse_fields(line, file_line(options.name, lines.number));
    Skeleton skeleton;
    std::size_t trees = 0;
    for (; lines.next(line); ++trees)
        add_tree(skeleton, line, fields, lines.number, file_line(options.name, lines.number));
    if (trees == 0) throw InputError(options.name, "holds no tree, expected one a line after the fields");
    ImportedTree tree;
    tree.branches = branches_of(std::move(skeleton), options.name, notes);
    tree.source = "treetools tree file " + options.name;
    tree.unit = 1;
    tree.up = 'z';
    return finish_import(std::move(tree), options, notes);
}

} // namespace

const SplineFormat treetools_format{"treetools tree file", recognizes_treetools, read_treetools};

} // namespace bough
