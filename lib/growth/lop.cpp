#include "lop.h"
#include "random.h"
#include <queue>

namespace bough {
namespace {

enum class LopDraw : std::uint8_t { twig = 200 }; // apart from the draws of growth (stem.h)

struct Twig {
    std::int32_t level;
    RandomKey key;
    std::int32_t branch;
    bool operator<(const Twig& other) const {
        return level != other.level ? level < other.level : key != other.key ? key < other.key : branch < other.branch;
    }
};

std::vector<std::uint8_t> choose(const Splines& s, std::uint64_t seed, std::int64_t count) {
    std::vector<std::int32_t> children(s.branches(), 0);
    for (const std::int32_t p : s.parent)
        if (p >= 0) ++children[std::size_t(p)];
    std::priority_queue<Twig> free;
    const auto offer = [&](std::int32_t b) {
        if (s.parent[std::size_t(b)] >= 0 && children[std::size_t(b)] == 0)
            free.push({s.level[std::size_t(b)], random_key(seed, LopDraw::twig, std::uint64_t(b)), b});
    };
    for (std::size_t b = 0; b < s.branches(); ++b) offer(std::int32_t(b));
    std::vector<std::uint8_t> lopped(s.branches(), 0);
    for (; count > 0 && !free.empty(); --count) {
        const std::int32_t b = free.top().branch, p = s.parent[std::size_t(b)];
        free.pop();
        lopped[std::size_t(b)] = 1;
        --children[std::size_t(p)];
        offer(p);
    }
    return lopped;
}

} // namespace

Splines without_twigs(const Splines& s, std::uint64_t seed, std::int64_t count) {
    const std::vector<std::uint8_t> lopped = choose(s, seed, count);
    Splines result;
    result.color = s.color;
    result.material = s.material;
    result.name = s.name;
    result.source = s.source;
    result.first_point.push_back(0);
    std::vector<std::int32_t> place(s.branches(), -1);
    for (std::size_t b = 0; b < s.branches(); ++b) {
        if (lopped[b]) continue;
        place[b] = std::int32_t(result.branches());
        result.parent.push_back(s.parent[b] < 0 ? -1 : place[std::size_t(s.parent[b])]);
        result.parent_at.push_back(s.parent_at[b]);
        result.level.push_back(s.level[b]);
        const auto first = s.first_point[b], end = s.first_point[b + 1];
        result.point.insert(result.point.end(), s.point.begin() + first, s.point.begin() + end);
        result.radius.insert(result.radius.end(), s.radius.begin() + first, s.radius.begin() + end);
        result.first_point.push_back(std::int32_t(result.points()));
    }
    for (std::size_t i = 0; i < s.leaves(); ++i) {
        const std::int32_t branch = place[std::size_t(s.leaf_branch[i])];
        if (branch < 0) continue;
        result.leaf_branch.push_back(branch);
        result.leaf_at.push_back(s.leaf_at[i]);
        result.leaf_position.push_back(s.leaf_position[i]);
        result.leaf_rotation.push_back(s.leaf_rotation[i]);
        result.leaf_length.push_back(s.leaf_length[i]);
        result.leaf_width.push_back(s.leaf_width[i]);
        if (!s.leaf_kind.empty()) result.leaf_kind.push_back(s.leaf_kind[i]);
        if (!s.leaf_count.empty()) result.leaf_count.push_back(s.leaf_count[i]);
    }
    for (std::size_t i = 0; i < s.fruits(); ++i) {
        const std::int32_t branch = place[std::size_t(s.fruit_branch[i])];
        if (branch < 0) continue;
        result.fruit_branch.push_back(branch);
        result.fruit_at.push_back(s.fruit_at[i]);
        result.fruit_position.push_back(s.fruit_position[i]);
        result.fruit_center.push_back(s.fruit_center[i]);
        result.fruit_radius.push_back(s.fruit_radius[i]);
    }
    return result;
}

} // namespace bough
