// layout.h: how a forest's bodies are laid out in rows of lanes (coupled_sweeps.h).
//
// A row is 64 bytes of one quantity: 16 bodies in float, 8 in double (its lanes), whatever the machine's registers.
//   chain   bodies one upon the other, all branches, or one leaf, petal or fruit. At a fork the chain goes on into the child that carries the longest
//           way out. A part of more than 8 bodies on which nothing begins is a chain of its own; then chains are cut into equal ones of at most 8
//           bodies, or 16 on which nothing begins
//   group   as many chains side by side as a row has lanes, of one kind of body: first those that carry others, those with the longest way out first;
//           then those on which nothing begins (terminal), longest first. Terminal chains also fill lanes that the first leave empty. Row k holds
//           their k-th bodies. Where a chain has ended, or is missing, stand bodies of no mass that nothing moves (pads). After Hu (1961): of trees
//           of equal tasks, no order takes fewer rows
//   block   subtrees together of some thousand bodies, whose step's own arrays stay in a core's cache; threads share blocks out. Where the longest
//           ways out of a stand's blocks would take half of the rows, and longer blocks save some, blocks are up to four times as large, but at most
//           a tenth of the stand; they leave the nearest cache. The first block, the top, is what is above: bodies that carry more than a block.
//           Trees share blocks, and the top's groups, only within a stand
//   joint   a record for what passes between chains: one for every body on which another chain begins (fork), one for each chain that begins on
//           another block's body (port), and one for each ground
// Within a block groups are in the order of a sweep outward, with the terminal ones last. None of it depends on threads or registers. Nor does a
// tree's part depend on trees beyond its stand (trees one after another until they have 256 bodies). So no sum's order depends on these.
// Cost O(n log n). Reads parent and kind; parent[i] < i.
#pragma once
#include "block.h"
#include <cstdint>
#include <vector>

namespace bough::fast {

struct Port {
    std::uint32_t joint, fork; // add joint's inward record to fork's
};

struct Layout {
    int lanes = 0;
    std::uint32_t rows = 0, grounds = 0, joints = 0; // joints: grounds, then forks, then ports
    std::vector<Group> groups;
    std::vector<Block> blocks;       // the top first; it may be empty
    std::vector<Port> ports;         // in the order of their sum
    std::vector<std::int32_t> body;  // of slot row * lanes + lane; -1: pad
    std::vector<std::uint32_t> slot; // of body
    std::vector<std::uint32_t> base; // a group's lanes: the joint that the chain begins on, outward (ground 0: a pad's)
    std::vector<std::uint32_t> landing;    // ... and the joint that takes what it hands inward, or nothing
    std::vector<std::uint32_t> ground;     // of each root: the joint that it stands on
    std::vector<std::uint32_t> tree;       // ... and the tree that it belongs to, counted by roots, or nothing
    std::vector<std::int32_t> fork_of_row; // index into fork times lanes, -1: no lane of the row is a fork
    std::vector<std::uint32_t> fork;       // joint of each lane's body; ground 0 where it is none
};

// ground: of each root, in the order of roots, the record that it stands on, 0 ... grounds - 1. Ground 0 is at rest.
Layout make_layout(const std::vector<std::int32_t>& parent, const std::vector<Kind>& kind,
                   const std::vector<std::uint32_t>& ground, std::uint32_t grounds, int lanes);

// True if some block's accelerations have to wait for others: then what is solved is kept for all rows.
inline bool waits(const Layout& layout) {
    for (const Block& block : layout.blocks)
        if (!block.whole && block.first_row < block.end_row) return true;
    return false;
}

} // namespace bough::fast
