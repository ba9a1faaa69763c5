// merge_trial.h: treeconvert's trial runs, and what --merge-below makes of one: joints that a trial run finds to hardly move are made rigid
// (lib/study/merge_below.h).
#pragma once
#include "common.h"
#include "lib/model/tree.h"
#include "option_list.h"

namespace bough {

struct MergeChoice {
    std::optional<double> below; // [m]
    std::string wind;            // as --wind; empty: gusty
    std::optional<double> seconds;
};

void add_merge_options(OptionList&, MergeChoice&);

// A trial's, as asked for or by default.
std::string trial_wind_of(const MergeChoice&);
double trial_seconds_of(const MergeChoice&);

// Throws UsageError for options that go only with a trial (`wind_groups`: there is one for --wind-groups), and for a trial of no frame.
void refuse_merge_contradictions(const MergeChoice&, bool wind_groups);

// Sets Tree::rigid; returns a line for --stats. Throws InputError where the tree cannot run.
std::string merge_by_trial(Tree&, const MergeChoice&, const CommonOptions&, const std::string& input);

} // namespace bough
