#include "formats/documents/document_parts.h"
#include "gltf_parts.h"
#include "lib/model/drawn_pose.h"

namespace bough {

std::vector<std::string> gltf_rods(const Tree& tree, const JointGroups& groups, const GroupFrames& drawn) {
    const auto [R_wb, x_w] = drawn_pose(tree);
    std::vector<std::string> rods(groups.size()), text(groups.size());
    std::vector<std::size_t> others(groups.size(), 0);
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const std::size_t g = std::size_t(groups.group[i]);
        if (tree.kind[i] != Kind::branch) {
            ++others[g];
            continue;
        }
        const std::int32_t p = tree.parent[i];
        std::string& list = rods[g];
        list += (list.empty() ? "" : ",") + std::to_string(tree.branch[i]) + "," +
                std::to_string(p < 0 ? -1 : tree.branch[std::size_t(p)]);
        const auto add = [&](double number) {
            list += ',';
            append_number(list, double(float(number)));
        };
        for (const bool tip : {false, true}) {
            const Vec3 place = x_w[i] + (tip ? tree.size[i].x() : 0) * R_wb[i].col(2);
            const Vec3 own = drawn.R_wg[g].transpose() * (place - drawn.x_w[g]);
            for (int k = 0; k < 3; ++k) add(own[k]);
            add(tree.size[i][tip ? 2 : 1]);
        }
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
        text[g] = ",\"extras\":{\"bough_rods\":[" + rods[g] + "]";
        if (others[g] > 0) text[g] += ",\"bough_others\":" + std::to_string(others[g]);
        text[g] += '}';
    }
    return text;
}

} // namespace bough
