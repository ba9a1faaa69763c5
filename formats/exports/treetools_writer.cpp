#include "lib/base/counted.h"
#include "skeleton_text.h"
#include "skeleton_writer.h"
#include <numeric>

namespace bough {

void write_treetools(Output& output, const Splines& splines, std::vector<std::string>& notes) {
    const SplineNodes nodes = nodes_of(splines);
    // Nodes tree by tree, in their order, and each one's number within its tree.
    std::vector<std::size_t> first(nodes.trees + 1, 0), place(nodes.parent.size()), node(nodes.parent.size());
    for (const std::int32_t t : nodes.tree) ++first[std::size_t(t) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < node.size(); ++i) {
        const auto t = std::size_t(nodes.tree[i]);
        place[i] = next[t] - first[t];
        node[next[t]++] = i;
    }
    Text text(output);
    add_comments(text, splines);
    text.add("x,y,z,radius,parent_id\n");
    for (std::size_t t = 0; t < nodes.trees; ++t) {
        for (std::size_t k = first[t]; k < first[t + 1]; ++k) {
            const std::size_t i = node[k];
            if (k > first[t]) text.put(',');
            add_node(text, nodes, i, k > first[t] ? ' ' : '\0', ',');
            text.put(',');
            if (nodes.parent[i] < 0)
                text.add("-1");
            else
                text.add_number(place[std::size_t(nodes.parent[i])]);
            text.room();
        }
        text.end_line();
    }
    text.hand_on();
    for (const std::string& line : losses(nodes, splines)) notes.push_back(line);
    if (nodes.trees > 0)
        notes.push_back("radius at the foot of " + counted(nodes.trees, "trunk", "trunks") +
                        " left out: readers take that of the first piece");
}

} // namespace bough
