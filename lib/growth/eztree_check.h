// eztree_check.h: the ranges of eztree.h's parameters. Private to growth.
#pragma once
#include "eztree.h"

namespace bough {

// Throws std::invalid_argument for the first parameter out of its range; of levels that do not grow nothing is looked at.
void check_eztree(const EzTreeParameters&);

} // namespace bough
