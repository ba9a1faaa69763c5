#include "merge_joints.h"
#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

namespace bough {
namespace {

// Groups that a trunk gets before deeper levels get any. Its curve carries all else, and four rigid pieces follow it to a
// sixteenth of one's error.
constexpr std::size_t trunk_groups = 4, any = std::numeric_limits<std::size_t>::max();
constexpr std::int32_t beyond_levels = std::numeric_limits<std::int32_t>::max(); // of leaves, petals and fruit

// The pieces of a branch in order, or a leaf, petal or fruit alone.
struct Chain {
    std::int32_t level;
    bool root;
    std::vector<std::int32_t> piece;
    std::size_t joints = 0; // that it keeps
    bool joins = false;     // never gets one of its own
    double reach = 0, mass = 0;
};

std::vector<Chain> find_chains(const Tree& tree) {
    std::vector<Chain> chains;
    std::vector<std::int32_t> chain_of(tree.size_bodies());
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        const std::int32_t p = tree.parent[i];
        if (continues_parent(tree, i) && chains[std::size_t(chain_of[std::size_t(p)])].piece.back() == p) {
            chain_of[i] = chain_of[std::size_t(p)];
        } else {
            chain_of[i] = std::int32_t(chains.size());
            chains.push_back({tree.kind[i] == Kind::branch ? tree.level[i] : beyond_levels, p < 0, {}, 0, false, 0, 0});
        }
        chains[std::size_t(chain_of[i])].piece.push_back(std::int32_t(i));
    }
    return chains;
}

void weigh(std::vector<Chain>& chains, const Tree& tree) {
    const std::size_t n = tree.size_bodies();
    std::vector<double> reach(n), mass = tree.mass;
    for (std::size_t i = 0; i < n; ++i) reach[i] = tree.size[i].x();
    for (std::size_t i = n; i-- > 0;) {
        if (tree.parent[i] < 0) continue;
        const std::size_t p = std::size_t(tree.parent[i]);
        reach[p] = std::max(reach[p], tree.joint_position[i].norm() + reach[i]);
        mass[p] += mass[i];
    }
    for (Chain& chain : chains) {
        chain.reach = reach[std::size_t(chain.piece.front())];
        chain.mass = mass[std::size_t(chain.piece.front())];
    }
}

std::size_t pieces_over(const Chain& chain, std::size_t pieces_a_group) {
    return (chain.piece.size() + pieces_a_group - 1) / pieces_a_group;
}

// Chains of one level, those that matter most first. What shares out joints returns those left.
using Level = std::vector<Chain*>;

// One joint for each branch, those that matter more first where not all fit.
std::size_t give_first(const Level& level, std::size_t joints) {
    for (Chain* chain : level) {
        if (chain->joints > 0 || chain->joins || joints == 0) continue;
        chain->joints = 1;
        --joints;
    }
    return joints;
}

// More joints for pieces of branches that have one, evenly, as many as fit but at most `most` a branch.
std::size_t give_more(const Level& level, std::size_t joints, std::size_t most) {
    std::size_t longest = 1;
    for (const Chain* chain : level) longest = std::max(longest, chain->piece.size());
    const auto wanted = [&](const Chain& chain, std::size_t pieces_a_group) {
        return std::max(chain.joints, std::min(most, pieces_over(chain, pieces_a_group)));
    };
    const auto needed = [&](std::size_t pieces_a_group) {
        std::size_t sum = 0;
        for (const Chain* chain : level)
            if (chain->joints > 0) sum += wanted(*chain, pieces_a_group) - chain->joints;
        return sum;
    };
    std::size_t fits = longest, too_few = 0; // `longest` asks for no more
    while (fits - too_few > 1) {
        const std::size_t middle = (fits + too_few) / 2;
        (needed(middle) <= joints ? fits : too_few) = middle;
    }
    joints -= needed(fits);
    for (Chain* chain : level) {
        if (chain->joints == 0) continue;
        chain->joints = wanted(*chain, fits);
        const std::size_t more = fits == 1 ? 0 : wanted(*chain, fits - 1) - chain->joints;
        if (more > joints) continue;
        chain->joints += more;
        joints -= more;
    }
    return joints;
}

std::vector<Level> by_level(std::vector<Chain>& chains) {
    std::vector<Chain*> order(chains.size());
    for (std::size_t c = 0; c < chains.size(); ++c) order[c] = &chains[c];
    std::stable_sort(order.begin(), order.end(), [](const Chain* a, const Chain* b) {
        if (a->level != b->level) return a->level < b->level;
        if (a->reach != b->reach) return a->reach > b->reach;
        return a->mass > b->mass;
    });
    std::vector<Level> levels;
    for (Chain* chain : order) {
        if (levels.empty() || levels.back().front()->level != chain->level) levels.emplace_back();
        levels.back().push_back(chain);
    }
    return levels;
}

void share_out(std::vector<Chain>& chains, std::size_t joints) {
    const std::vector<Level> levels = by_level(chains);
    const std::size_t wood = levels.size() - (levels.back().front()->level == beyond_levels);
    for (std::size_t l = 0; l < wood && joints > 0; ++l) {
        joints = give_first(levels[l], joints);
        if (l == 0) joints = give_more(levels[l], joints, trunk_groups);
    }
    for (std::size_t l = 0; l < wood && joints > 0; ++l) joints = give_more(levels[l], joints, any);
    if (wood < levels.size()) give_first(levels.back(), joints);
}

// The piece at half the length of the group that begins with piece `from` and ends before `to`.
std::int32_t leading(const Tree& tree, const Chain& chain, std::size_t from, std::size_t to) {
    double length = 0;
    for (std::size_t k = from; k < to; ++k) length += tree.size[std::size_t(chain.piece[k])].x();
    double passed = 0;
    for (std::size_t k = from; k < to; ++k) {
        passed += tree.size[std::size_t(chain.piece[k])].x();
        if (passed >= length / 2) return chain.piece[k];
    }
    return chain.piece[from];
}

} // namespace

JointGroups merge_joints(const Tree& tree, std::size_t most, bool leaves) {
    const std::size_t n = tree.size_bodies();
    std::vector<Chain> chains = find_chains(tree);
    const std::size_t roots = std::size_t(std::count(tree.parent.begin(), tree.parent.end(), -1));
    if (roots > most)
        throw std::invalid_argument("is " + std::to_string(most) + ", expected a joint for each of the " +
                                    std::to_string(roots) + " roots at least");
    weigh(chains, tree);
    for (Chain& chain : chains) {
        chain.joints = chain.root;
        chain.joins = !leaves && is_flat(tree.kind[std::size_t(chain.piece.front())]);
    }
    share_out(chains, most - roots);

    std::vector<std::int32_t> lead(n, -1); // of bodies that begin a group
    for (const Chain& chain : chains)
        for (std::size_t k = 0; k < chain.joints; ++k) {
            const std::size_t from = k * chain.piece.size() / chain.joints;
            const std::size_t to = (k + 1) * chain.piece.size() / chain.joints;
            lead[std::size_t(chain.piece[from])] = leading(tree, chain, from, to);
        }
    JointGroups groups;
    groups.group.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const std::int32_t above = tree.parent[i] < 0 ? -1 : groups.group[std::size_t(tree.parent[i])];
        groups.group[i] = lead[i] < 0 ? above : std::int32_t(groups.size());
        if (lead[i] < 0) continue;
        groups.parent.push_back(above);
        groups.first.push_back(std::int32_t(i));
        groups.lead.push_back(lead[i]);
    }
    return groups;
}

} // namespace bough
