// tree_arrays.h: a tree's arrays over bodies one after another, for what does the same with each. An array that is added to Tree is added
// here: tests/lib/model/tree_arrays.cpp fails where it is not.
#pragma once
#include "tree.h"
#include <type_traits>

namespace bough {

// What stands, in the call, for the value of an array that has none by itself: it is never empty.
struct AlwaysThere {};
template <class Absent> constexpr bool always_there = std::is_same_v<Absent, AlwaysThere>;
// The same for two arrays of which a body has 0 where they are empty: leaf_width, which is as long as leaf_length, and load, which no document has.
struct AsLeafLength {
    constexpr operator double() const { return 0; }
};
struct InNoDocument {
    constexpr operator double() const { return 0; }
};

// Calls visit(name, absent, the array of each tree). absent: what a body has of an array that may be empty and is; else AlwaysThere.
template <class Visit, class... Trees> void each_array(Visit&& visit, Trees&... tree) {
    constexpr AlwaysThere there;
    visit("parent", there, tree.parent...);
    visit("kind", there, tree.kind...);
    visit("mass", there, tree.mass...);
    visit("com", there, tree.com...);
    visit("inertia", there, tree.inertia...);
    visit("joint_position", there, tree.joint_position...);
    visit("joint_rotation", there, tree.joint_rotation...);
    visit("stiffness", there, tree.stiffness...);
    visit("damping", there, tree.damping...);
    visit("size", there, tree.size...);
    visit("branch", there, tree.branch...);
    visit("level", there, tree.level...);
    visit("s", there, tree.s...);
    visit("rigid", std::uint8_t(0), tree.rigid...);
    visit("load", InNoDocument(), tree.load...);
    visit("leaf_count", 1, tree.leaf_count...);
    visit("leaf_length", 0.0, tree.leaf_length...);
    visit("leaf_width", AsLeafLength(), tree.leaf_width...);
    visit("leaf_facing", 0.0, tree.leaf_facing...);
    visit("drag", 1.0, tree.drag...);
}

// Name, material, source and colours: what a tree says of itself as a whole.
void copy_labels(Tree& to, const Tree& from);

// Returns these bodies, with the tree's labels; parents are those of the tree.
Tree bodies_of(const Tree&, const std::vector<std::int32_t>& bodies);

} // namespace bough
