#include "layout.h"
#include "stands.h"
#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <utility>

namespace bough::fast {
namespace {

// Tried on one core with AVX-512, in gusts, float, ns a body. A maple of 1 000 000 bodies: chains not cut, blocks of 4096 139; cut to 8 104; blocks
// of 8192 91, of 16384 91; these figures 93. One of 100 000: 104, 99, 94, 91, 86. A stand of small trees is indifferent.
constexpr std::size_t largest_block = 4096, largest_deep_block = 16384, smallest_block = 1024;
constexpr std::uint32_t longest_carrying = 8, longest_bare = 16; // chains [bodies]
constexpr std::size_t kinds = std::size_t(Kind::tuft) + 1;

struct Chain {
    std::int32_t first;
    std::uint32_t block, stand, height, length; // stand: of the top's chains alone
    Kind kind;
    bool terminal; // nothing begins on it
};

Kind family(Kind kind) {
    return is_flat(kind) ? Kind::leaf : kind;
}

class Builder {
public:
    Builder(const std::vector<std::int32_t>& p, const std::vector<Kind>& k, const std::vector<std::uint32_t>& g,
            std::uint32_t grounds, int lanes)
        : parent(p), kind(k), ground(g), n(p.size()) {
        out.lanes = lanes;
        out.grounds = out.joints = grounds;
    }

    Layout build() {
        find_stands();
        cut_blocks();
        find_chains();
        place_groups();
        number_joints();
        out.ground = ground;
        return std::move(out);
    }

private:
    const std::vector<std::int32_t>& parent;
    const std::vector<Kind>& kind;
    const std::vector<std::uint32_t>& ground;
    std::size_t n;
    Layout out;
    std::vector<std::uint32_t> stand; // first body of each, and n
    std::vector<std::uint32_t> block_of;
    std::uint32_t blocks = 1;
    std::vector<std::int32_t> next;           // body on which the chain goes on, -1: tip
    std::vector<Chain> chains;                // block by block, in the order that groups take them
    std::vector<std::uint32_t> begins_on;     // of each chain: a chain that begins on it, or nothing
    std::vector<std::uint32_t> begins_beside; // and another that begins on the same, or nothing

    bool starts_block(std::size_t i) const { return parent[i] < 0 || block_of[std::size_t(parent[i])] != block_of[i]; }

    // Trees in document order, until they have enough bodies: what stands together. A tree is a root's.
    void find_stands() {
        for (std::size_t i = 0; i < n; ++i)
            if (parent[i] < 0 && (stand.empty() || i - stand.back() >= smallest_stand))
                stand.push_back(std::uint32_t(i));
        stand.push_back(std::uint32_t(n));
    }

    void cut_blocks() {
        std::vector<std::uint32_t> size(n, 1);
        for (std::size_t i = n; i-- > 0;)
            if (parent[i] >= 0) size[std::size_t(parent[i])] += size[i];
        block_of.assign(n, 0);
        for (std::size_t s = 0; s + 1 < stand.size(); ++s) cut_stand(stand[s], stand[s + 1], size);
    }

    // Where the longest ways out of blocks would take half the rows, blocks are doubled as long as that saves rows.
    void cut_stand(std::size_t first, std::size_t end, const std::vector<std::uint32_t>& size) {
        const std::size_t bodies = end - first, most = std::min(bodies / 10, largest_deep_block);
        const std::uint32_t before = blocks;
        std::size_t full = std::clamp(bodies / 6, smallest_block, largest_block);
        fill_blocks(first, end, size, full);
        if (2 * full > most) return;
        Need need = need_of(first, end, before);
        while (2 * full <= most && 2 * need.ways * std::size_t(out.lanes) >= bodies) {
            blocks = before;
            fill_blocks(first, end, size, 2 * full);
            const Need larger = need_of(first, end, before);
            if (larger.rows >= need.rows) {
                blocks = before;
                return fill_blocks(first, end, size, full);
            }
            full *= 2;
            need = larger;
        }
    }

    // What no order of chains can do without: rows for the longest way out of each block, and for each block these or its bodies.
    struct Need {
        std::size_t ways = 0, rows = 0;
    };
    // Of a stand's part of the top, and its blocks, which are those from `before` on.
    Need need_of(std::size_t first, std::size_t end, std::uint32_t before) const {
        std::vector<std::size_t> height(end - first, 1), longest(blocks - before + 1, 0), bodies(longest.size(), 0);
        for (std::size_t i = end; i-- > first;) {
            const std::size_t block = block_of[i] == 0 ? 0 : block_of[i] - before + 1;
            ++bodies[block];
            longest[block] = std::max(longest[block], height[i - first]);
            if (starts_block(i)) continue;
            std::size_t& below = height[std::size_t(parent[i]) - first];
            below = std::max(below, height[i - first] + 1);
        }
        Need need;
        for (std::size_t b = 0; b < longest.size(); ++b) {
            need.ways += longest[b];
            need.rows += std::max(longest[b], bodies[b] / std::size_t(out.lanes));
        }
        return need;
    }

    // Whole subtrees, in document order, until a block is full.
    void fill_blocks(std::size_t first, std::size_t end, const std::vector<std::uint32_t>& size, std::size_t full) {
        std::size_t filled = full; // of the present block
        for (std::size_t i = first; i < end; ++i) {
            const bool root = parent[i] < 0;
            block_of[i] = 0;
            if (!root && block_of[std::size_t(parent[i])] != 0) {
                block_of[i] = block_of[std::size_t(parent[i])];
            } else if (size[i] <= full) {
                if (filled + size[i] > full) {
                    ++blocks;
                    filled = 0;
                }
                filled += size[i];
                block_of[i] = blocks - 1;
            }
        }
    }

    // On each body the chain goes on into the child that carries the longest way out. Where nothing more begins on it for long, the rest is cut off.
    // Both parts are cut into equal ones where they are long.
    void find_chains() {
        next.assign(n, -1);
        // Rows from each body to the farthest tip in the block, to the chain's end, and to the chain's last body that carries another chain.
        std::vector<std::uint32_t> height(n, 1), length(n, 1), carrying(n, 0);
        std::vector<bool> carries(n, false);
        for (std::size_t i = n; i-- > 0;) {
            if (next[i] >= 0) length[i] = length[std::size_t(next[i])] + 1;
            if (next[i] >= 0 && carrying[std::size_t(next[i])] > 0)
                carrying[i] = carrying[std::size_t(next[i])] + 1;
            else if (carries[i])
                carrying[i] = 1;
            if (parent[i] < 0) continue;
            const auto p = std::size_t(parent[i]);
            if (block_of[p] != block_of[i]) {
                carries[p] = true;
                continue;
            }
            height[p] = std::max(height[p], height[i] + 1);
            const std::int32_t before = next[p];
            const bool goes_on = kind[i] == Kind::branch && kind[p] == Kind::branch;
            if (goes_on && (before < 0 || height[i] > height[std::size_t(before)])) next[p] = std::int32_t(i);
            carries[p] = carries[p] || !goes_on || before >= 0;
        }
        std::vector<std::uint32_t> left(n, 0); // bodies of the part that follow
        std::vector<std::size_t> part(n);
        std::uint32_t present = 0;
        for (std::size_t i = 0; i < n; ++i) {
            while (i >= stand[present + 1]) ++present;
            const std::size_t p = starts_block(i) ? i : std::size_t(parent[i]);
            const bool goes_on = p != i && next[p] == std::int32_t(i);
            if (goes_on && left[p] > 0) {
                part[i] = part[p];
                left[i] = left[p] - 1;
            } else {
                if (goes_on) {
                    next[p] = -1;
                    chains[part[p]].terminal = false;
                }
                const bool bare = carrying[i] == 0, bare_later = length[i] - carrying[i] > longest_carrying;
                const std::uint32_t cut = !bare && bare_later ? carrying[i] : length[i];
                const std::uint32_t most = bare ? longest_bare : longest_carrying, parts = (cut + most - 1) / most;
                part[i] = chains.size();
                left[i] = (cut + parts - 1) / parts - 1;
                chains.push_back({std::int32_t(i), block_of[i], block_of[i] == 0 ? present : 0, height[i], left[i] + 1,
                                  family(kind[i]), true});
            }
            if (carries[i]) chains[part[i]].terminal = false;
        }
        const auto key = [](const Chain& c) {
            return std::tuple(c.block, c.stand, c.terminal, c.terminal ? 0 : -std::int64_t(c.height), c.kind,
                              -std::int64_t(c.length));
        };
        std::stable_sort(chains.begin(), chains.end(), [&](const Chain& a, const Chain& b) { return key(a) < key(b); });
        link_chains();
    }

    // Lists the chains that begin on each chain within its block.
    void link_chains() {
        std::vector<std::uint32_t> chain_of(n);
        for (std::uint32_t c = 0; c < chains.size(); ++c)
            for (std::int32_t i = chains[c].first; i >= 0; i = next[std::size_t(i)]) chain_of[std::size_t(i)] = c;
        begins_on.assign(chains.size(), nothing);
        begins_beside.assign(chains.size(), nothing);
        for (std::uint32_t c = 0; c < chains.size(); ++c) {
            const auto i = std::size_t(chains[c].first);
            if (starts_block(i)) continue;
            const std::uint32_t below = chain_of[std::size_t(parent[i])];
            begins_beside[c] = begins_on[below];
            begins_on[below] = c;
        }
    }

    // The bodies of a chain into lane `lane` of a group.
    void put_chain(const Chain& chain, const Group& group, std::size_t lane) {
        std::uint32_t row = group.first_row;
        for (std::int32_t i = chain.first; i >= 0; i = next[std::size_t(i)], ++row) {
            const std::size_t slot = row * std::size_t(out.lanes) + lane;
            out.slot[std::size_t(i)] = std::uint32_t(slot);
            out.body[slot] = i;
        }
    }

    void place_block(Block& block, std::uint32_t first, std::uint32_t end) {
        block.first_row = out.rows;
        block.first_group = std::uint32_t(out.groups.size());
        block.terminal_group = nothing;
        while (first < end) { // of the top stand by stand, of others at once
            std::uint32_t last = first;
            while (last < end && chains[last].stand == chains[first].stand) ++last;
            place_stand(block, first, last);
            first = last;
        }
        block.end_group = std::uint32_t(out.groups.size());
        block.end_row = out.rows;
    }

    // First what carries other chains, the highest first; then the rest, the longest first. The order is after Hu (1961): of trees of equal tasks,
    // none takes fewer rows. Lanes that are left empty take what fits of the rest; where most are left, the rest says how long the group is.
    void place_stand(Block& block, std::uint32_t first, std::uint32_t end) {
        const auto lanes = std::size_t(out.lanes);
        std::array<std::set<std::uint32_t>, kinds> carrying, bare; // chains that may be placed: what they begin on is
        const auto enter = [&](std::uint32_t c) {
            (chains[c].terminal ? bare : carrying)[std::size_t(chains[c].kind)].insert(c);
        };
        const auto next_of = [](const std::array<std::set<std::uint32_t>, kinds>& of) {
            std::uint32_t c = nothing;
            for (const std::set<std::uint32_t>& all : of)
                if (!all.empty()) c = std::min(c, *all.begin());
            return c;
        };
        for (std::uint32_t c = first; c < end; ++c)
            if (starts_block(std::size_t(chains[c].first))) enter(c);
        std::vector<std::uint32_t> together;
        for (std::uint32_t c = next_of(carrying); true; c = next_of(carrying)) {
            const bool terminal = c == nothing;
            if (terminal) c = next_of(bare);
            if (c == nothing) return;
            if (terminal && block.terminal_group == nothing) block.terminal_group = std::uint32_t(out.groups.size());
            const Kind kind_here = chains[c].kind;
            std::uint32_t length = chains[c].length;
            together.clear();
            const auto take = [&](std::set<std::uint32_t>& from, std::set<std::uint32_t>::iterator at) {
                while (together.size() < lanes && at != from.end()) {
                    length = std::max(length, chains[*at].length);
                    together.push_back(*at);
                    at = from.erase(at);
                }
            };
            std::set<std::uint32_t>&on = carrying[std::size_t(kind_here)], &rest = bare[std::size_t(kind_here)];
            take(on, on.begin());
            const auto fits = [&](const Chain& d) {
                return d.terminal && (d.kind > kind_here || (d.kind == kind_here && d.length <= length));
            };
            const auto at = chains.begin();
            const auto fitting = std::partition_point(at + first, at + end, [&](const Chain& d) { return !fits(d); });
            take(rest, 2 * together.size() < lanes ? rest.begin() : rest.lower_bound(std::uint32_t(fitting - at)));
            const Group group{out.rows, length, std::uint32_t(out.base.size()), kind_here};
            out.base.resize(out.base.size() + lanes, 0);
            out.body.resize((out.rows + length) * lanes, -1);
            for (std::size_t lane = 0; lane < together.size(); ++lane) put_chain(chains[together[lane]], group, lane);
            out.groups.push_back(group);
            out.rows += length;
            for (const std::uint32_t placed : together)
                for (std::uint32_t d = begins_on[placed]; d != nothing; d = begins_beside[d]) enter(d);
        }
    }

    void place_groups() {
        out.slot.assign(n, nothing);
        out.blocks.resize(blocks);
        std::uint32_t chain = 0;
        for (std::uint32_t b = 0; b < blocks; ++b) {
            const std::uint32_t first = chain;
            while (chain < chains.size() && chains[chain].block == b) ++chain;
            place_block(out.blocks[b], first, chain);
            // The top goes inward only when all that it carries has come.
            if (out.blocks[b].terminal_group == nothing || b == 0)
                out.blocks[b].terminal_group = out.blocks[b].end_group;
        }
    }

    void number_joints() {
        for (std::size_t b = 1; b < out.blocks.size(); ++b) out.blocks[b].whole = true;
        const auto lanes = std::size_t(out.lanes);
        std::vector<bool> is_fork(n, false);
        for (const Chain& c : chains)
            if (parent[std::size_t(c.first)] >= 0) is_fork[std::size_t(parent[std::size_t(c.first)])] = true;
        std::vector<std::uint32_t> joint(n, 0);
        out.fork_of_row.assign(out.rows, -1);
        for (Block& block : out.blocks) {
            block.first_fork = out.joints;
            for (std::uint32_t row = block.first_row; row < block.end_row; ++row)
                for (std::size_t l = 0; l < lanes; ++l) {
                    const std::int32_t i = out.body[row * lanes + l];
                    if (i < 0 || !is_fork[std::size_t(i)]) continue;
                    if (out.fork_of_row[row] < 0) {
                        out.fork_of_row[row] = std::int32_t(out.fork.size() / lanes);
                        out.fork.resize(out.fork.size() + lanes, 0);
                    }
                    joint[std::size_t(i)] = out.joints;
                    out.fork[std::size_t(out.fork_of_row[row]) * lanes + l] = out.joints++;
                }
            block.end_fork = out.joints;
        }
        std::vector<std::uint32_t> tree(n);
        std::uint32_t roots = 0;
        for (std::size_t i = 0; i < n; ++i) tree[i] = parent[i] < 0 ? roots++ : tree[std::size_t(parent[i])];
        out.landing.assign(out.base.size(), nothing);
        out.tree.assign(out.base.size(), nothing);
        for (const Group& g : out.groups)
            for (std::size_t l = 0; l < lanes; ++l) {
                const std::int32_t i = out.body[g.first_row * lanes + l];
                if (i < 0) continue;
                const std::int32_t p = parent[std::size_t(i)];
                out.tree[g.first_base + l] = tree[std::size_t(i)];
                out.base[g.first_base + l] = p < 0 ? ground[tree[std::size_t(i)]] : joint[std::size_t(p)];
                if (p < 0) continue;
                if (block_of[std::size_t(i)] == block_of[std::size_t(p)]) {
                    out.landing[g.first_base + l] = joint[std::size_t(p)];
                } else {
                    out.blocks[block_of[std::size_t(i)]].whole = false;
                    out.ports.push_back({out.joints, joint[std::size_t(p)]});
                    out.landing[g.first_base + l] = out.joints++;
                }
            }
    }
};

} // namespace

Layout make_layout(const std::vector<std::int32_t>& parent, const std::vector<Kind>& kind,
                   const std::vector<std::uint32_t>& ground, std::uint32_t grounds, int lanes) {
    return Builder(parent, kind, ground, grounds, lanes).build();
}

} // namespace bough::fast
