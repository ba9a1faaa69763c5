// any_tree.h: what bytes that may hold any tree are, and bodies of what was imported, as treeconvert makes them where it is given no options.
#pragma once
#include "lib/growth/segment.h"
#include "lib/model/splines.h"
#include "lib/model/tree.h"
#include "lib/model/wood.h"
#include <string>
#include <string_view>
#include <vector>

namespace bough {

// Whether it is converted before it moves: neither a tree or scene of ours nor a broken document of ours. Looks at its head, and at the name.
bool must_be_converted(std::string_view content, const std::string& name);

// The wood that splines name, the first preset where they name none. Throws InputError for a name that is no preset's.
Material own_material(const Splines&, const std::string& name);
// What segment() put right, a line each.
std::vector<std::string> repairs(const SegmentReport&);
// What a number of bodies left of the fruit, where it did of some.
std::string joined_fruit(const SegmentReport&);
// Throws InputError for a tree without bodies.
void require_bodies(const Tree&, const std::string& name);

// All of it: the bodies of splines by the defaults, with notes of what was put right. Throws InputError, place `name`.
Tree tree_of_splines(const Splines&, const std::string& name, std::vector<std::string>& notes);

} // namespace bough
