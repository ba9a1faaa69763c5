// leaf_hosts.h: leaves that do not say on which branch they grow.
#pragma once
#include "imported_parts.h"

namespace bough {

// Gives each leaf without a branch the nearest one (of equally near ones the first). Branches have two points or more.
// Nothing is made where no leaf lacks one. O(points log points), a leaf O(log points) in the usual case.
void find_hosts(const std::vector<ImportedBranch>&, std::vector<ImportedLeaf>&);

} // namespace bough
