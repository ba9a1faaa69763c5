// error_motion_panel.h: the panel of error_plot.h that shows the runs' statistics beside the truth's.
#pragma once
#include "lib/study/work_precision.h"

namespace bough {

// One run, as its line is drawn above.
struct MotionMarks {
    const ErrorRun* run;
    const char* colour;
    int mark;
};

// Pixels that the panel takes; 0: the report has nothing to show in it.
int motion_panel_height(const ErrorReport&);

// gnuplot's commands, in a multiplot `height` pixels high, from `top` pixels on: a row a statistic, the runs' shares of the
// truth's on a logarithmic axis, 1 marked.
std::string motion_panel(const ErrorReport&, const std::vector<MotionMarks>&, int height, int top);

} // namespace bough
