// reduced.h: a tree whose rigid bodies are joined with what they hang on, and where each body is on it (reduce.h makes it).
#pragma once
#include "../model/scene.h"
#include "../model/tree.h"
#include <vector>

namespace bough {

// The value in a reduced tree's Tree::rigid, which is 0 elsewhere.
constexpr std::uint8_t round_to_air = 2;

// Returns what the air takes the body for, that is, by whose law (air.h).
inline Kind kind_in_air(const Tree& tree, std::size_t i) {
    if (!tree.rigid.empty() && tree.rigid[i] == round_to_air) return Kind::fruit;
    return is_clump(tree, i) ? kind_of_many(leaf_proportion(tree, i)) : tree.kind[i];
}

// Returns how much a clump's leaves face one way, and 0 for other bodies.
inline double facing_in_air(const Tree& tree, std::size_t i) {
    return tree.leaf_facing.empty() || !stands_for_many(kind_in_air(tree, i)) ? 0 : tree.leaf_facing[i];
}

struct Reduced {
    Tree tree;                     // no body at all where nothing moves
    std::vector<TreeRange> ranges; // of the scene's trees in it
    // Of each body of the whole tree.
    std::vector<std::int32_t> body; // that of the reduced one whose group it is in, -1: it stands still
    std::vector<Vec3> offset;   // [m] its joint in the group's frame (in the world, as drawn, where it stands still)
    std::vector<Quat> rotation; // the group's frame (world) from its own

    std::vector<std::int32_t> leader; // of each body of the reduced tree
    std::vector<TreeRange> whole;     // ranges of the whole tree
};

inline bool has_rigid(const Tree& tree) {
    for (const std::uint8_t rigid : tree.rigid)
        if (rigid) return true;
    return false;
}

} // namespace bough
