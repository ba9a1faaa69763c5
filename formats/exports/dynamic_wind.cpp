#include "dynamic_wind.h"
#include "formats/text.h"
#include <algorithm>

namespace bough {

std::vector<std::int32_t> wind_groups(const Tree& tree, const JointGroups& groups) {
    std::vector<std::int32_t> made(groups.size(), 0);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups.parent[g] < 0) continue;
        const std::size_t p = std::size_t(groups.parent[g]);
        const std::size_t own = std::size_t(groups.first[g]), above = std::size_t(groups.first[p]);
        const bool goes_on = tree.kind[own] == Kind::branch && tree.kind[above] == Kind::branch &&
                             tree.branch[own] == tree.branch[above];
        made[g] = made[p] + !goes_on;
    }
    return made;
}

void write_dynamic_wind(Output& output, const Tree& tree, const JointGroups& joints) {
    const std::vector<std::int32_t> group = wind_groups(tree, joints);
    const std::int32_t count = *std::max_element(group.begin(), group.end()) + 1;
    Text text(output);
    text.add("{\n\"Joints\": [\n");
    for (std::size_t j = 0; j < joints.size(); ++j) {
        text.add("{\"JointName\": \"body_");
        text.add_number(joints.first[j]);
        text.add("\", \"SimulationGroupIndex\": ");
        text.add_number(group[j]);
        text.add(j + 1 < joints.size() ? "},\n" : "}\n");
    }
    text.add("],\n\"SimulationGroups\": [\n");
    for (std::int32_t g = 0; g < count; ++g) {
        text.add("{\"bUseDualInfluence\": false, \"Influence\": 1, \"MinInfluence\": 0, \"MaxInfluence\": 0, ");
        text.add("\"ShiftTop\": 0, \"bIsTrunkGroup\": ");
        text.add(g == 0 ? "true" : "false");
        text.add(g + 1 < count ? "},\n" : "}\n");
    }
    text.add("],\n\"bIsGroundCover\": false,\n\"GustAttenuation\": 0\n}\n");
    text.hand_on();
}

} // namespace bough
