// wind_trial.h: treeconvert --wind-groups: a run in the wind, to which the groups' influences are fitted (formats/exports/dynamic_wind.h).
#pragma once
#include "formats/exports/dynamic_wind.h"
#include "merge_trial.h"

namespace bough {

// The wind and the seconds of --merge-below's options. Throws InputError where the tree cannot run, Interrupted.
WindFit wind_by_trial(const Tree&, const JointGroups&, const MergeChoice&, const CommonOptions&,
                      const std::string& input);

// What was fitted, and how well, as a note.
std::string wind_note(const WindFit&, const MergeChoice&);

} // namespace bough
