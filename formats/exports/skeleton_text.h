// skeleton_text.h: what the writers of skeleton formats share (private to swc_writer.cpp and treetools_writer.cpp).
#pragma once
#include "formats/imports/spline_nodes.h"
#include "formats/text.h"

namespace bough {

inline void add_comment(Text& text, std::string_view comment) {
    text.add("# ");
    text.add(comment);
    text.end_line();
}

// The tree's name and where it comes from, a comment a line.
inline void add_comments(Text& text, const Splines& splines) {
    for (const std::string* of : {&splines.name, &splines.source})
        for (std::size_t at = 0; at < of->size();) {
            const std::size_t end = std::min(of->find('\n', at), of->size());
            add_comment(text, std::string_view(*of).substr(at, end - at));
            at = end + 1;
        }
}

// x y z radius in metres, Z up: `before` the first (none for '\0'), `between` between them. At most 101 characters.
inline void add_node(Text& text, const SplineNodes& nodes, std::size_t i, char before, char between) {
    const Vec3& p = nodes.point[i];
    bool first = true;
    for (const double number : {p.x(), 0 - p.z(), p.y(), nodes.radius[i]}) {
        if (!first || before != '\0') text.put(first ? before : between);
        text.add_number(std::abs(number) < 1e-300 ? 0
                                                  : number); // std::stod, which others read with, refuses smaller ones
        first = false;
    }
}

} // namespace bough
