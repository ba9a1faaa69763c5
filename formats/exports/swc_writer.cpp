#include "skeleton_text.h"
#include "skeleton_writer.h"

namespace bough {

void write_swc(Output& output, const Splines& splines, std::vector<std::string>& notes) {
    const SplineNodes nodes = nodes_of(splines);
    Text text(output);
    add_comment(text, swc_frame);
    add_comments(text, splines);
    add_comment(text, "id type x y z radius parent");
    for (std::size_t i = 0; i < nodes.parent.size(); ++i) {
        text.add_number(i + 1);
        text.put(' '), text.put('0');
        add_node(text, nodes, i, ' ', ' ');
        text.put(' ');
        text.add_number(nodes.parent[i] < 0 ? -1 : nodes.parent[i] + 1);
        text.end_line();
    }
    text.hand_on();
    for (const std::string& line : losses(nodes, splines)) notes.push_back(line);
}

} // namespace bough
