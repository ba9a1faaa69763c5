// profile.h: the sub-commands of treeprofile. Each keeps its options itself, so that this header need not know them.
#pragma once
#include "tool.h"

namespace bough {

constexpr const char* profile_name = "treeprofile";

// Each may refer to the common options until the program ends.
Subcommand profile_stages(CommonOptions&);  // profile_stages.cpp: what each stage of a run costs
Subcommand profile_compare(CommonOptions&); // profile_compare.cpp: what became slower between two of its reports

Subcommand profile_error(CommonOptions&);     // profile_error.cpp: error against run time
Subcommand profile_stability(CommonOptions&); // profile_stability.cpp: the grid of extremes
Subcommand profile_modes(CommonOptions&);     // profile_modes.cpp: natural frequencies and shapes
Subcommand profile_scaling(CommonOptions&);   // profile_scaling.cpp: cost over size, held against the machine's limits

} // namespace bough
