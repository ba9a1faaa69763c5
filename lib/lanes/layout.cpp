#include "layout.h"
#include "stands.h"
#include <algorithm>
#include <tuple>
#include <utility>

namespace bough::fast {
namespace {

constexpr std::size_t largest_block = 4096, smallest_block = 1024;

struct Chain {
    std::int32_t first;
    std::uint32_t block, stand, level, length; // stand: of the top's chains alone
    Kind kind;
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
    std::vector<std::int32_t> next; // body on which the chain goes on, -1: tip
    std::vector<Chain> chains;      // block by block, highest level first
    std::uint32_t block_slots = 0;  // slots below are of groups before the present one

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

    // Whole subtrees, in document order, until a block is full.
    void cut_stand(std::size_t first, std::size_t end, const std::vector<std::uint32_t>& size) {
        const std::size_t full = std::clamp((end - first) / 6, smallest_block, largest_block);
        std::size_t filled = full; // of the present block
        for (std::size_t i = first; i < end; ++i) {
            const bool root = parent[i] < 0;
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

    void find_chains() {
        next.assign(n, -1);
        std::vector<std::uint32_t> level(n, 0), length(n, 1);
        std::vector<std::uint32_t> aside(n, 0); // lowest level that the chains beginning on the body allow
        for (std::size_t i = n; i-- > 0;) {
            if (next[i] >= 0) {
                level[i] = std::max(aside[i], level[std::size_t(next[i])]);
                length[i] = length[std::size_t(next[i])] + 1;
            } else {
                level[i] = aside[i];
            }
            if (starts_block(i)) continue;
            const auto p = std::size_t(parent[i]);
            const std::int32_t before = next[p];
            const bool goes_on = kind[i] == Kind::branch && kind[p] == Kind::branch;
            if (goes_on && (before < 0 || std::pair(level[i], length[i]) >
                                              std::pair(level[std::size_t(before)], length[std::size_t(before)]))) {
                next[p] = std::int32_t(i);
                if (before >= 0) aside[p] = std::max(aside[p], level[std::size_t(before)] + 1);
            } else {
                aside[p] = std::max(aside[p], level[i] + 1);
            }
        }
        std::uint32_t present = 0;
        for (std::size_t i = 0; i < n; ++i) {
            while (i >= stand[present + 1]) ++present;
            if (starts_block(i) || next[std::size_t(parent[i])] != std::int32_t(i))
                chains.push_back({std::int32_t(i), block_of[i], block_of[i] == 0 ? present : 0, level[i], length[i],
                                  family(kind[i])});
        }
        const auto key = [](const Chain& c) {
            return std::tuple(c.block, c.stand, -std::int64_t(c.level), c.kind, -std::int64_t(c.length));
        };
        std::stable_sort(chains.begin(), chains.end(), [&](const Chain& a, const Chain& b) { return key(a) < key(b); });
    }

    // The bodies of a chain into lane `lane` of a group.
    void place(const Chain& chain, const Group& group, std::size_t lane) {
        std::uint32_t row = group.first_row;
        for (std::int32_t i = chain.first; i >= 0; i = next[std::size_t(i)], ++row) {
            const std::size_t slot = row * std::size_t(out.lanes) + lane;
            out.slot[std::size_t(i)] = std::uint32_t(slot);
            out.body[slot] = i;
        }
    }

    // One block: level by level from the highest, each level's longest chains first; lanes that a level leaves empty take chains of
    // lower levels that fit and whose base is already placed.
    void place_block(Block& block, const Chain* first, const Chain* end) {
        block.first_row = out.rows;
        block.first_group = std::uint32_t(out.groups.size());
        block.terminal_group = nothing;
        while (first < end) { // of the top stand by stand, of others at once
            const Chain* last = first;
            while (last < end && last->stand == first->stand) ++last;
            place_stand(block, first, last);
            first = last;
        }
        block.end_group = std::uint32_t(out.groups.size());
        block.end_row = out.rows;
    }

    void place_stand(Block& block, const Chain* first, const Chain* end) {
        const auto lanes = std::size_t(out.lanes);
        std::vector<bool> done(std::size_t(end - first), false);
        const auto ready = [&](const Chain& c) {
            return starts_block(std::size_t(c.first)) ||
                   out.slot[std::size_t(parent[std::size_t(c.first)])] < block_slots;
        };
        for (const Chain* c = first; c < end; ++c) {
            if (done[std::size_t(c - first)]) continue;
            if (c->level == 0 && block.terminal_group == nothing)
                block.terminal_group = std::uint32_t(out.groups.size());
            const Group group{out.rows, c->length, std::uint32_t(out.base.size()), c->kind};
            out.base.resize(out.base.size() + lanes, 0);
            out.body.resize((out.rows + c->length) * lanes, -1);
            block_slots = std::uint32_t(out.rows * lanes);
            std::size_t lane = 0;
            for (const Chain* d = c; d < end && lane < lanes; ++d) {
                if (done[std::size_t(d - first)] || d->kind != c->kind || d->length > c->length || !ready(*d)) continue;
                done[std::size_t(d - first)] = true;
                place(*d, group, lane++);
            }
            out.groups.push_back(group);
            out.rows += c->length;
        }
    }

    void place_groups() {
        out.slot.assign(n, nothing);
        out.blocks.resize(blocks);
        const Chain* chain = chains.data();
        const Chain* const all = chain + chains.size();
        for (std::uint32_t b = 0; b < blocks; ++b) {
            const Chain* const first = chain;
            while (chain < all && chain->block == b) ++chain;
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
