#include "tree.h"
#include "document.h"

namespace bough {
namespace {

constexpr DocumentType tree_document{"bough-tree", 1};

// 0 or 1 for each body; where all are 0 it is left out.
Field flags(const std::string& name, std::vector<std::uint8_t>& values, const Per& per) {
    Array array{Dtype::u8, 1, {}, {}, {}, {}, {}, per};
    array.entries = [&values] { return values.size(); };
    array.get = [&values](std::size_t first, std::size_t count, Numbers& numbers) {
        numbers.integers.assign(values.begin() + std::ptrdiff_t(first), values.begin() + std::ptrdiff_t(first + count));
    };
    array.start = [&values](std::size_t count) {
        values.clear();
        values.reserve(count);
    };
    array.add = [&values](const Numbers& numbers) {
        for (const std::int64_t value : numbers.integers) values.push_back(std::uint8_t(value));
    };
    array.fill = [](std::size_t) {}; // absent: empty
    return optional(Field{name, std::move(array)});
}

// A number for each body, or none at all.
template <class T> Field perhaps(const std::string& name, std::vector<T>& values, const Per& per) {
    Field field = array(name, values, per);
    std::get<Array>(field.value).fill = [](std::size_t) {}; // absent: empty
    return optional(std::move(field));
}

std::vector<Field> fields_of(Tree& t) {
    const Per body{"body in /parent", [&t] { return t.size_bodies(); }};
    return {optional({"name", &t.name}),
            optional({"material", &t.material}),
            optional({"source", &t.source}),
            optional(array("color", t.color, {})),
            array("parent", t.parent, {}),
            array("kind", t.kind, body, Kind::branch),
            array("mass", t.mass, body),
            array("com", t.com, body),
            array("inertia", t.inertia, body),
            array("joint_position", t.joint_position, body),
            array("joint_rotation", t.joint_rotation, body),
            array("stiffness", t.stiffness, body),
            array("damping", t.damping, body, 0.0),
            array("size", t.size, body),
            array("branch", t.branch, body),
            array("level", t.level, body),
            array("s", t.s, body),
            flags("rigid", t.rigid, body),
            perhaps("leaf_count", t.leaf_count, body),
            perhaps("leaf_length", t.leaf_length, body),
            perhaps("leaf_width", t.leaf_width, body),
            perhaps("leaf_facing", t.leaf_facing, body),
            perhaps("drag", t.drag, body)};
}

} // namespace

bool is_tree(std::string_view content) {
    return document_format(content) == tree_document.format;
}

Tree read_tree(std::string_view content, const std::string& name) {
    Tree tree;
    read_document(content, name, tree_document, fields_of(tree));
    refuse(check(tree), name, fields_of(tree));
    return tree;
}

Tree read_tree(const Input& input) {
    Tree tree;
    read_document(input, tree_document, fields_of(tree));
    refuse(check(tree), input.name(), fields_of(tree));
    return tree;
}

void write_tree(Output& output, const Tree& tree, Form form) {
    write_document(output, form, tree_document, fields_of(const_cast<Tree&>(tree))); // a writer only looks
}

} // namespace bough
