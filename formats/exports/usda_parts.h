// usda_parts.h: what the writers of USD text share (private to usda*.cpp).
#pragma once
#include "formats/text.h"
#include "usda.h"
#include <map>
#include <set>

namespace bough {

std::string prim_name(const std::string&); // letters, digits and _

// Names that are each taken once: a second one gets "_2", and so on.
class FreeNames {
public:
    std::string add(const std::string& name);

private:
    std::set<std::string> taken_;
    std::map<std::string, int> next_; // of each that was asked for: the number to try next
};

std::string usda_string(const std::string&); // quoted and escaped

// A line, indented by so many levels.
inline void usda_line(Text& text, int level, const std::string& line) {
    text.add(std::string(std::size_t(4 * level), ' '));
    text.add(line);
    text.end_line();
}

// "(x, y, z)" of float or double numbers.
template <class Vector> void usda_tuple(Text& text, const Vector& numbers) {
    text.put('(');
    bool first = true;
    for (const auto number : numbers) {
        if (!first) text.add(", ");
        text.add_number(number + 0); // no -0
        first = false;
    }
    text.put(')');
    text.room();
}

// `head` = [item, item ...], and what stands behind; add(text, i) writes an item.
template <class Add>
void usda_array(Text& text, int level, const std::string& head, std::size_t count, Add add,
                const std::string& behind = "") {
    text.add(std::string(std::size_t(4 * level), ' '));
    text.add(head);
    text.put('[');
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) text.add(", ");
        add(text, i);
        text.room();
    }
    text.put(']');
    text.add(behind);
    text.end_line();
}

// ---- usda_mesh.cpp ---- the parts of a mesh; positions less `origin`. root: the path of the SkelRoot. name: of each part.
void usda_meshes(Text&, const std::string& root, const std::vector<std::string>& name, const RigMesh&,
                 const std::vector<OwnLook>&, const Vec3& origin);

// ---- usda_material.cpp ---- the scope "materials" under the root.
void usda_materials(Text&, const std::string& root, const std::vector<std::string>& name, const std::vector<OwnLook>&);

} // namespace bough
