// influence.h: which joints move a skin's vertex, and how much each.
#pragma once
#include "lib/growth/merge_joints.h"
#include "lib/growth/skin.h"
#include <algorithm>

namespace bough {

// Bodies of one group become one entry; entries without weight are 0, 0.
struct Influence {
    std::array<std::int32_t, 4> joint{};
    std::array<float, 4> weight{};
};

inline Influence influence_of(const Skin& skin, const JointGroups& groups, std::size_t v) {
    Influence made;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        if (!(skin.weight[v][k] > 0)) continue;
        const std::int32_t group = groups.group[std::size_t(skin.joint[v][k])];
        std::size_t at = 0;
        while (at < count && made.joint[at] != group) ++at;
        count = std::max(count, at + 1);
        made.joint[at] = group;
        made.weight[at] += skin.weight[v][k];
    }
    if (count == 1) made.weight[0] = 1;
    return made;
}

} // namespace bough
