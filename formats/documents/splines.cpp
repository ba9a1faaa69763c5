#include "splines.h"
#include "document.h"

namespace bough {
namespace {

constexpr DocumentType splines_document{"bough-splines", 1};

std::vector<Field> fields_of(Splines& s) {
    const auto count = [](const auto& array) { return [&array] { return array.size(); }; };
    const Per branch{"branch in /parent", count(s.parent)};
    const Per branch_and_end{"branch in /parent, and the end", [&s] { return s.branches() + 1; }};
    const Per point{"point in /point", count(s.point)};
    const Per leaf{"leaf in /leaf_branch", count(s.leaf_branch)};
    const Per fruit{"fruit in /fruit_branch", count(s.fruit_branch)};
    return {optional({"name", &s.name}),
            optional({"source", &s.source}),
            optional({"material", &s.material}),
            optional({"bodies", &s.bodies}),
            optional(array("color", s.color, {})),
            array("parent", s.parent, {}),
            array("parent_at", s.parent_at, branch),
            array("level", s.level, branch),
            array("first_point", s.first_point, branch_and_end),
            array("point", s.point, {}),
            array("radius", s.radius, point),
            optional(array("leaf_branch", s.leaf_branch, {})),
            optional(array("leaf_at", s.leaf_at, leaf)),
            optional(array("leaf_position", s.leaf_position, leaf)),
            optional(array("leaf_rotation", s.leaf_rotation, leaf)),
            optional(array("leaf_length", s.leaf_length, leaf)),
            optional(array("leaf_width", s.leaf_width, leaf)),
            optional(array("leaf_kind", s.leaf_kind, {})),
            optional(array("leaf_count", s.leaf_count, {})),
            optional(array("fruit_branch", s.fruit_branch, {})),
            optional(array("fruit_at", s.fruit_at, fruit)),
            optional(array("fruit_position", s.fruit_position, fruit)),
            optional(array("fruit_center", s.fruit_center, fruit)),
            optional(array("fruit_radius", s.fruit_radius, fruit))};
}

} // namespace

bool is_splines(std::string_view content) {
    return document_format(content) == splines_document.format;
}

Splines read_splines(std::string_view content, const std::string& name) {
    Splines splines;
    read_document(content, name, splines_document, fields_of(splines));
    refuse(check(splines), name, fields_of(splines));
    return splines;
}

void write_splines(Output& output, const Splines& splines, Form form) {
    std::vector<Field> fields = fields_of(const_cast<Splines&>(splines)); // a writer only looks
    if (splines.bodies == 0) std::erase_if(fields, [](const Field& field) { return field.name == "bodies"; });
    write_document(output, form, splines_document, fields);
}

} // namespace bough
