#include "formats/documents/document_parts.h"
#include "gltf_parts.h"
#include "lib/model/drawn_pose.h"

namespace bough {
namespace {

// Bodies of one branch that follow one another in a group.
struct Run {
    std::int32_t branch = -1, carrier = -1;
    std::size_t points = 0;
    std::string text; // of the points
};

void append(const Run& run, std::string& list) {
    if (run.points == 0) return;
    for (const std::int64_t number : {std::int64_t(run.branch), std::int64_t(run.carrier), std::int64_t(run.points)})
        list += (list.empty() ? "" : ",") + std::to_string(number);
    list += run.text;
}

} // namespace

std::vector<std::string> gltf_rods(const Tree& tree, const JointGroups& groups, const GroupFrames& drawn) {
    const DrawnPose pose = drawn_pose(tree);
    std::vector<std::string> wood(groups.size()), text(groups.size());
    std::vector<std::size_t> others(groups.size(), 0);
    std::vector<Run> run(groups.size()); // the last one of each group
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const std::size_t g = std::size_t(groups.group[i]);
        if (tree.kind[i] != Kind::branch) {
            ++others[g];
            continue;
        }
        const auto add_point = [&](bool tip) {
            const Vec3 place = pose.x_w[i] + (tip ? tree.size[i].x() : 0) * pose.R_wb[i].col(2);
            const Vec3 own = drawn.R_wg[g].transpose() * (place - drawn.x_w[g]);
            for (const double number : {own.x(), own.y(), own.z(), tree.size[i][tip ? 2 : 1]}) {
                run[g].text += ',';
                append_number(run[g].text, float(number));
            }
            ++run[g].points;
        };
        const std::int32_t p = tree.parent[i], carrier = p < 0 ? -1 : tree.branch[std::size_t(p)];
        if (run[g].points == 0 || run[g].branch != tree.branch[i] || !continues_parent(tree, i)) {
            append(run[g], wood[g]);
            run[g] = {tree.branch[i], carrier, 0, ""};
            add_point(false);
        }
        add_point(true);
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
        append(run[g], wood[g]);
        text[g] = ",\"extras\":{\"bough_wood\":[" + wood[g] + "]";
        if (others[g] > 0) text[g] += ",\"bough_others\":" + std::to_string(others[g]);
        text[g] += '}';
    }
    return text;
}

} // namespace bough
